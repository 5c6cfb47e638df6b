//! What a player does, written down: `right:60 jump+right:20 idle:30`.

use std::fmt;
use std::fs;
use std::str::FromStr;

use flat_scenes::{Buttons, Hold};

/// Buttons held one after the other, from the first step on; after the last, none.
///
/// ```
/// let inputs: flat_rig::input::Inputs = "right:60 jump+right:1 idle:30".parse().unwrap();
/// assert_eq!(inputs.steps(), 91);
/// assert_eq!(inputs.to_string(), "right:60 right+jump:1 idle:30");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Inputs(Vec<Hold>);

/// A part of a run in which the same buttons are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Which.
    pub buttons: Buttons,
    /// The last step.
    pub to: u32,
}

impl Inputs {
    /// These holds; a demo's, for instance.
    pub fn new(holds: &[Hold]) -> Self {
        Self(holds.to_vec())
    }

    /// Reads inputs, or with an `@` before it, the file that holds them. There, the rest of a line after `#` is a comment.
    ///
    /// # Errors
    /// In words: what is wrong with which part, or why the file can't be read.
    pub fn read(text: &str) -> Result<Self, String> {
        let Some(path) = text.strip_prefix('@') else {
            return text.parse();
        };
        let content = fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?;
        let lines = content.lines().map(|line| line.split('#').next().unwrap_or_default());
        lines.collect::<Vec<_>>().join(" ").parse().map_err(|error| format!("{path}: {error}"))
    }

    /// Steps from the first to the last.
    pub fn steps(&self) -> u32 {
        self.0.iter().map(|hold| hold.steps).sum()
    }

    /// What is held from step `from + 1` to step `to`.
    pub fn spans(&self, from: u32, to: u32) -> Vec<Span> {
        let mut end = 0;
        let mut spans: Vec<Span> = Vec::new();
        for hold in &self.0 {
            end += hold.steps;
            if end > from && spans.last().is_none_or(|last| last.to < to) {
                spans.push(Span { buttons: hold.buttons, to: end.min(to) });
            }
        }
        if spans.last().map_or(from, |last| last.to) < to {
            spans.push(Span { buttons: Buttons::IDLE, to });
        }
        spans
    }
}

impl FromStr for Inputs {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let holds = text.split_whitespace().map(hold).collect::<Result<Vec<_>, _>>()?;
        let total = holds.iter().try_fold(0_u32, |sum, hold| sum.checked_add(hold.steps));
        match total {
            Some(0) => Err(format!("holds nothing; it goes like `{EXAMPLE}`")),
            Some(_) => Ok(Self(holds)),
            None => Err(format!("lasts longer than {} steps", u32::MAX)),
        }
    }
}

const EXAMPLE: &str = "right:60 jump+right:20 idle:30";

/// One part: buttons and steps.
fn hold(part: &str) -> Result<Hold, String> {
    let (buttons, steps) =
        part.split_once(':').ok_or_else(|| format!("`{part}` has no `:STEPS`; it goes like `{EXAMPLE}`"))?;
    let steps = steps.parse().ok().filter(|&steps| steps > 0);
    let steps = steps.ok_or_else(|| format!("`{part}`: the steps must be a number from 1 to {}", u32::MAX))?;
    if buttons == Buttons::IDLE.to_string() {
        return Ok(Hold { buttons: Buttons::IDLE, steps });
    }
    let held = buttons.split('+').try_fold(Buttons::IDLE, |held, name| {
        let known = Buttons::NAMES.iter().find(|(_, known)| *known == name);
        known.map(|(button, _)| held.and(*button)).ok_or_else(|| {
            let names = Buttons::NAMES.map(|(_, name)| name).join(", ");
            format!("`{part}`: `{name}` is no button; those are {names}, and idle is none of them")
        })
    })?;
    Ok(Hold { buttons: held, steps })
}

impl fmt::Display for Inputs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts: Vec<_> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&parts.join(" "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spans(from: u32, to: u32) -> Vec<(String, u32)> {
        let inputs: Inputs = "right:5 jump:1 idle:4".parse().unwrap();
        inputs.spans(from, to).into_iter().map(|span| (span.buttons.to_string(), span.to)).collect()
    }

    #[test]
    fn spans_cover_every_step_of_a_part_once() {
        let named = |spans: &[(&str, u32)]| spans.iter().map(|(name, to)| (name.to_string(), *to)).collect::<Vec<_>>();
        assert_eq!(spans(0, 10), named(&[("right", 5), ("jump", 6), ("idle", 10)]));
        assert_eq!(spans(0, 3), named(&[("right", 3)]));
        assert_eq!(spans(5, 6), named(&[("jump", 6)]));
        assert_eq!(spans(4, 12), named(&[("right", 5), ("jump", 6), ("idle", 10), ("idle", 12)]));
        assert_eq!(spans(20, 25), named(&[("idle", 25)]));
    }

    #[test]
    fn what_is_wrong_is_named() {
        let refused = |text: &str| text.parse::<Inputs>().unwrap_err();
        assert_eq!(refused(" "), "holds nothing; it goes like `right:60 jump+right:20 idle:30`");
        assert_eq!(refused("right:5 jump"), "`jump` has no `:STEPS`; it goes like `right:60 jump+right:20 idle:30`");
        assert_eq!(refused("right:-5"), "`right:-5`: the steps must be a number from 1 to 4294967295");
        assert_eq!(refused("right:0"), "`right:0`: the steps must be a number from 1 to 4294967295");
        assert_eq!(
            refused("idle:1 jump+rihgt:5"),
            "`jump+rihgt:5`: `rihgt` is no button; those are left, right, jump, down, and idle is none of them"
        );
        assert_eq!(refused("left:4294967295 left:1"), "lasts longer than 4294967295 steps");
        assert!(Inputs::read("@no/such/file").unwrap_err().starts_with("no/such/file: "));
    }

    #[test]
    fn a_file_may_have_comments() {
        let path = std::env::temp_dir().join(format!("flat-inputs-{}", std::process::id()));
        fs::write(&path, "# to the right\nright:60 # and up\n\njump:1\n").unwrap();
        let read = Inputs::read(&format!("@{}", path.display()));
        fs::remove_file(&path).unwrap();
        assert_eq!(read.unwrap().to_string(), "right:60 jump:1");
    }
}
