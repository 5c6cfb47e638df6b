//! Tiles: data, the map as a collider, bodies in its place. Maps are drawn:
//!
//! `#` solid, `=` one-way, `$` a coin, `^` spikes, `*` a brick that breaks, `?` a trigger, `.` nothing.

mod bodies;
mod cast;
mod contacts;
mod data;
mod drawing;
mod map;
