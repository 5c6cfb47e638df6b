//! Tables of figures on the terminal, and how numbers are written in them.

use comfy_table::{CellAlignment, LineStyle, Table, TableStyle, presets};

/// A line under the header, and no other.
const STYLE: TableStyle = presets::NOTHING.header_separator(LineStyle::new('─', '─', '─', '─'));

/// A table whose first column holds names, and the others numbers.
pub fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(STYLE).set_header(header);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

/// A number, rounded, with a space after each three digits.
pub fn grouped(number: f64) -> String {
    let digits = format!("{:.0}", number.abs());
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    if number <= -0.5 { format!("-{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_come_in_threes() {
        let cases = [(0.4, "0"), (999.4, "999"), (1000.0, "1 000"), (-1_234_567.0, "-1 234 567"), (-0.2, "0")];
        for (number, expected) in cases {
            assert_eq!(grouped(number), expected);
        }
    }
}
