//! What an image takes of the ESP32-C3's memories, and the budget that it must keep.

use std::fmt;
use std::ops::Range;

use super::elf::Section;
use super::references::{FLASH_CODE, FLASH_DATA, IRAM};

/// Data's view of the RAM that code runs from at other addresses: *ESP32-C3 Technical Reference Manual*, "Internal Memory".
const DRAM: Range<u32> = 0x3fc8_0000..0x3fce_0000;

/// Bytes by use. Code, variables and stack share one RAM.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Memory {
    /// Code that runs from RAM.
    pub ram_code: u64,
    /// Variables with an initial value, and constants that were moved to RAM.
    pub data: u64,
    /// Variables that start as zero, or in RAM that the boot loader leaves, as nothing.
    pub bss: u64,
    /// What is left of RAM: the stack of the link's tasks, and of the interrupts, physics included.
    pub stack: u64,
    /// Code in flash.
    pub flash_code: u64,
    /// Constants in flash.
    pub flash_data: u64,
}

/// The most that each use may take; of the stack the least that must be left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Code that runs from RAM.
    pub ram_code: u64,
    /// Stack, at least.
    pub stack: u64,
    /// Code and constants in flash.
    pub flash: u64,
}

/// For the ESP32-C3. RAM that code takes is RAM that bodies don't get; a stack that is short of its high-water mark, which the
/// device measures, by a third is no surprise in the field yet.
pub const BUDGET: Budget = Budget { ram_code: 112 * 1024, stack: 12 * 1024, flash: 384 * 1024 };

impl Memory {
    /// Adds up an image's sections.
    pub fn of(sections: &[Section]) -> Self {
        let mut memory = Self::default();
        for Section { name, address, size, is_stored } in sections {
            let use_of = if name == ".stack" {
                &mut memory.stack
            } else if IRAM.contains(address) {
                &mut memory.ram_code
            } else if FLASH_CODE.contains(address) {
                &mut memory.flash_code
            } else if FLASH_DATA.contains(address) {
                &mut memory.flash_data
            } else if !DRAM.contains(address) {
                continue;
            } else if *is_stored {
                &mut memory.data
            } else {
                &mut memory.bss
            };
            *use_of += size;
        }
        memory
    }

    /// Where it exceeds a budget, a line each.
    pub fn excesses(&self, budget: &Budget) -> Vec<String> {
        let flash = self.flash_code + self.flash_data;
        let mut lines = Vec::new();
        for (what, bytes, most) in
            [("code in RAM", self.ram_code, budget.ram_code), ("code and constants in flash", flash, budget.flash)]
        {
            if bytes > most {
                lines.push(format!("{what}: {bytes} bytes, {} over the budget of {most}", bytes - most));
            }
        }
        if self.stack < budget.stack {
            let short = budget.stack - self.stack;
            lines.push(format!("stack: {} bytes left, {short} short of the budget of {}", self.stack, budget.stack));
        }
        lines
    }
}

impl fmt::Display for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { ram_code, data, bss, stack, flash_code, flash_data } = self;
        write!(
            f,
            "RAM: code {ram_code}, data {data}, bss {bss}, stack {stack}; flash: code {flash_code}, constants {flash_data} bytes"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(name: &str, address: u32, size: u64, is_stored: bool) -> Section {
        Section { name: name.into(), address, size, is_stored }
    }

    #[test]
    fn every_section_is_counted_where_it_lies() {
        let memory = Memory::of(&[
            section(".trap", 0x4038_0000, 1, true),
            section(".rwtext", 0x4038_0100, 2, true),
            section(".data", 0x3fc8_1000, 4, true),
            section(".bss", 0x3fc8_2000, 8, false),
            section(".stack", 0x3fcc_0000, 16, false),
            section(".text", 0x4201_0020, 32, true),
            section(".rodata", 0x3c00_0120, 64, true),
            section(".rtc_fast.bss", 0x5000_0000, 128, false),
        ]);
        let expected = Memory { ram_code: 3, data: 4, bss: 8, stack: 16, flash_code: 32, flash_data: 64 };
        assert_eq!(memory, expected);
    }

    #[test]
    fn one_byte_over_any_budget_is_reported() {
        let budget = Budget { ram_code: 10, stack: 20, flash: 30 };
        let within = Memory { ram_code: 10, stack: 20, flash_code: 15, flash_data: 15, ..Memory::default() };
        assert_eq!(within.excesses(&budget), [""; 0]);
        for over in [
            Memory { ram_code: 11, ..within },
            Memory { stack: 19, ..within },
            Memory { flash_code: 16, ..within },
            Memory { flash_data: 16, ..within },
        ] {
            assert_eq!(over.excesses(&budget).len(), 1, "{over}");
        }
    }
}
