//! Parts of a committed text that a command writes anew: what stands between two marks.

use crate::error::Error;

/// Replaces what stands between `<!-- NAME:begin -->` and `<!-- NAME:end -->`.
///
/// # Errors
/// If one of the two is missing, or they are the wrong way round.
pub fn replace(text: &str, name: &str, part: &str) -> Result<String, Error> {
    let (begin, end) = (format!("<!-- {name}:begin -->"), format!("<!-- {name}:end -->"));
    let found = text.split_once(&begin).and_then(|(head, rest)| Some((head, rest.split_once(&end)?.1)));
    let Some((head, tail)) = found else {
        let what = format!("there are no marks `{begin}` and `{end}` to write between");
        return Err(Error::usage(what, "put the two where the table belongs"));
    };
    Ok(format!("{head}{begin}\n{}\n{end}{tail}", part.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_stands_between_the_marks_changes() {
        let text = "before <!-- t:begin -->old\nold<!-- t:end --> after";
        let once = replace(text, "t", "new\n").unwrap();
        assert_eq!(once, "before <!-- t:begin -->\nnew\n<!-- t:end --> after");
        assert_eq!(replace(&once, "t", "new").unwrap(), once);
    }

    #[test]
    fn missing_marks_are_an_error() {
        for text in ["", "<!-- t:begin -->", "<!-- t:end --> <!-- t:begin -->"] {
            assert!(replace(text, "t", "new").is_err(), "{text}");
        }
    }
}
