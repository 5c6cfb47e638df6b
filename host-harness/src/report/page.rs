//! A page of tables and plots that needs no other file, in the reader's choice of light or dark.

use std::fmt::Write;

use super::plot::{self, Plot, escape};
use crate::measure::provenance::Provenance;

/// Everything but the plots' own style.
const STYLE: &str = "\
:root{--ink:#1c1e21;--soft:#5d636b;--rule:#d9dce1;--paper:#fff}\
@media(prefers-color-scheme:dark){:root{--ink:#e8eaed;--soft:#a4abb5;--rule:#3a3f47;--paper:#16181c}}\
body{margin:2rem auto;max-width:66rem;padding:0 1rem;font:15px/1.55 system-ui,sans-serif}\
body{color:var(--ink);background:var(--paper)}h1{font-size:1.6rem;margin:0 0 .3rem}\
h2{font-size:1.2rem;margin:2.2rem 0 .3rem}p{max-width:46rem;margin:.4rem 0 .8rem}p.soft{color:var(--soft)}\
table{border-collapse:collapse;margin:.6rem 0 1.2rem;font-variant-numeric:tabular-nums}\
th,td{padding:.22rem .8rem;border-bottom:1px solid var(--rule);text-align:right;white-space:nowrap}\
th:first-child,td:first-child,.text{text-align:left}td.text{white-space:normal;min-width:16rem}thead th{border-bottom:2px solid var(--ink);vertical-align:bottom}\
tr.best td{font-weight:600}.wide{overflow-x:auto}svg{max-width:100%;height:auto;display:block;margin:.6rem 0}\
strong.answer{font-size:1.1rem}summary{cursor:pointer;color:var(--soft)}";

/// A column with a cell of more letters than this holds words, not figures: they run from the left and may break.
const WORDS: usize = 24;

/// A page under construction.
#[derive(Debug)]
pub struct Page {
    body: String,
    title: String,
}

impl Page {
    /// A page with a title and, in a sentence or two, what it answers.
    pub fn new(title: &str, answers: &str) -> Self {
        let body = format!("<h1>{}</h1>\n<p>{}</p>\n", escape(title), escape(answers));
        Self { body, title: title.to_owned() }
    }

    /// Starts a section.
    pub fn section(&mut self, heading: &str, explanation: &str) {
        let _ = writeln!(self.body, "<h2>{}</h2>", escape(heading));
        self.paragraph(explanation);
    }

    /// Adds a paragraph, unless it is empty.
    pub fn paragraph(&mut self, text: &str) {
        if !text.is_empty() {
            let _ = writeln!(self.body, "<p>{}</p>", escape(text));
        }
    }

    /// Adds what a reader came for.
    pub fn answer(&mut self, text: &str) {
        let _ = writeln!(self.body, "<p><strong class=\"answer\">{}</strong></p>", escape(text));
    }

    /// Adds a table; the first column holds names. Rows are marked where `best` says so.
    pub fn table(&mut self, header: &[String], rows: &[Vec<String>], best: impl Fn(usize) -> bool) {
        self.body.push_str("<div class=\"wide\"><table><thead>");
        let widest = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(String::len).max();
        let words: Vec<bool> =
            (0..header.len()).map(|column| widest(column).is_some_and(|most| most > WORDS)).collect();
        self.row("th", header, &words, "");
        self.body.push_str("</thead><tbody>\n");
        for (index, row) in rows.iter().enumerate() {
            self.row("td", row, &words, if best(index) { " class=\"best\"" } else { "" });
        }
        self.body.push_str("</tbody></table></div>\n");
    }

    /// Adds a table that a reader unfolds.
    pub fn folded_table(
        &mut self,
        summary: &str,
        header: &[String],
        rows: &[Vec<String>],
        best: impl Fn(usize) -> bool,
    ) {
        let _ = writeln!(self.body, "<details><summary>{}</summary>", escape(summary));
        self.table(header, rows, best);
        self.body.push_str("</details>\n");
    }

    fn row(&mut self, element: &str, cells: &[String], words: &[bool], class: &str) {
        let _ = write!(self.body, "<tr{class}>");
        for (cell, words) in cells.iter().zip(words) {
            let text = if *words { " class=\"text\"" } else { "" };
            let _ = write!(self.body, "<{element}{text}>{}</{element}>", escape(cell));
        }
        self.body.push_str("</tr>\n");
    }

    /// Adds a plot.
    pub fn plot(&mut self, plot: &Plot) {
        self.body.push_str(&plot.svg());
    }

    /// The whole page.
    pub fn finish(self, provenance: &Provenance, command: &str) -> String {
        format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
             <meta name=\"color-scheme\" content=\"light dark\"><title>{}</title><style>{}{STYLE}</style></head>\n\
             <body>\n{}<p class=\"soft\">Measured {}. Made by <code>{}</code>.</p>\n</body></html>\n",
            escape(&self.title),
            plot::STYLE,
            self.body,
            escape(&provenance.to_string()),
            escape(command),
        )
    }
}
