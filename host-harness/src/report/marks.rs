//! Parts of a committed text that a command writes anew: what stands between two marks.

use std::fs;
use std::path::Path;

use crate::error::Error;
use crate::firmware::workspace;

/// Writes a part of a committed file anew, by its path from the root.
///
/// # Errors
/// If it cannot be read or written, or has no such marks.
pub fn publish(file: &str, name: &str, part: &str) -> Result<(), Error> {
    let path = workspace::root()?.join(file);
    let failed = |error: &std::io::Error| unwritable(&path, error);
    let text = fs::read_to_string(&path).map_err(|error| failed(&error))?;
    let text = replace(&text, name, part).map_err(|error| Error::usage(format!("{file}: {error}"), ""))?;
    fs::write(&path, text).map_err(|error| failed(&error))?;
    println!("{file}: the `{name}` part is written");
    Ok(())
}

/// Says which file of the tree is at fault.
pub fn unwritable(path: &Path, error: &std::io::Error) -> Error {
    Error::usage(format!("{}: {error}", path.display()), "run it from a source tree that you may write to")
}

/// Replaces what stands between `<!-- NAME:begin -->` and `<!-- NAME:end -->`.
///
/// # Errors
/// If one of the two is missing, or they are the wrong way round.
fn replace(text: &str, name: &str, part: &str) -> Result<String, Error> {
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
