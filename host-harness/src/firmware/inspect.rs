//! `rig inspect`: all that an ESP32-C3 image tells about itself: memories, what runs from RAM, what that wants from flash.

use std::path::PathBuf;

use clap::Args;

use super::elf::Image;
use super::hot_path;
use super::image::{self, Board};
use super::memory::{BUDGET, Memory};
use super::references;
use crate::error::Error;

/// Arguments of `rig inspect`.
#[derive(Debug, Args)]
pub struct InspectArgs {
    /// ESP32-C3 image to read instead of building one
    #[arg(long, value_name = "PATH")]
    elf: Option<PathBuf>,
}

/// What an image was found to hold.
#[derive(Clone, Debug)]
pub struct Inspection {
    /// What it takes of the chip's memories.
    pub memory: Memory,
    /// What runs from RAM by name.
    pub hot_path: hot_path::Report,
    /// What code in RAM wants from flash.
    pub references: references::Report,
}

impl Inspection {
    /// Reads an ESP32-C3 image.
    ///
    /// # Errors
    /// If its debug information is damaged.
    pub fn of(image: &Image) -> Result<Self, Error> {
        Ok(Self {
            memory: Memory::of(&image.sections),
            hot_path: hot_path::check(image)?,
            references: references::list(image)?,
        })
    }

    /// What mustn't be, a line each.
    pub fn problems(&self) -> Vec<String> {
        let mut problems = self.memory.excesses(&BUDGET);
        problems.extend(self.hot_path.problems.iter().cloned());
        problems.extend(self.references.problems());
        problems
    }

    /// What was found, in a line.
    pub fn summary(&self) -> String {
        format!("{}; {}; {}", self.hot_path, self.references, self.memory)
    }
}

/// Prints what an image holds; true if all of it may be.
///
/// # Errors
/// If there is no image, or it cannot be read.
pub fn run(arguments: &InspectArgs) -> Result<bool, Error> {
    let path = arguments.elf.clone().map_or_else(|| image::build(Board::Esp32c3), Ok)?;
    let inspection = Inspection::of(&Image::read(&path)?)?;
    println!("{}", path.display());
    println!("{}", inspection.memory);
    println!("{}", inspection.hot_path);
    println!("{}", inspection.references);
    for (why, lines) in inspection.references.permitted() {
        println!("may be: {why}");
        for line in lines {
            println!("  {line}");
        }
    }
    let problems = inspection.problems();
    for problem in &problems {
        println!("{} {problem}", console::style("must not be:").red().bold());
    }
    Ok(problems.is_empty())
}
