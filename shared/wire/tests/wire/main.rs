//! What the crate promises: the table stays the table, and frames survive the line.

mod framing;
mod samples;
mod table;
