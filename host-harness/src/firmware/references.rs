//! Every reference from code in the ESP32-C3's RAM into its flash.
//!
//! Flash is read through a cache: what lies there may take 2 us to arrive, at a time that hangs on what ran before. Code is
//! put into RAM so that it doesn't wait; whatever it still wants from flash must be of a kind that may.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;

use super::elf::Image;
use super::flow::{self, Question, Reference, Use};
use super::instructions::Instruction;
use crate::error::Error;

// "Internal Memory" and "External Memory" in the *ESP32-C3 Technical Reference Manual*.

/// Instruction RAM behind the cache's own 16 kB.
pub const IRAM: Range<u32> = 0x4038_0000..0x403e_0000;
/// Mask ROM, as fast as RAM: esp-hal lets the linker find `memcpy` and soft floats there.
const ROM: Range<u32> = 0x4000_0000..0x4006_0000;
/// Code in flash.
pub const FLASH_CODE: Range<u32> = 0x4200_0000..0x4280_0000;
/// Constants in flash.
pub const FLASH_DATA: Range<u32> = 0x3c00_0000..0x3c80_0000;

/// Calls that end the program: what they cost is nobody's jitter, nor is what only they are given.
const DIVERGING: [&str; 8] = [
    "core::panicking::",
    "core::slice::index::slice_index_fail",
    "core::option::expect_failed",
    "core::option::unwrap_failed",
    "core::result::unwrap_failed",
    "core::cell::panic_already",
    "esp_hal::fmt::__unwrap_failed",
    "esp_rtos::fmt::__unwrap_failed",
];

/// What code in RAM may want from flash, and why.
struct Permit {
    /// Beginning of the name of the code in RAM.
    from: &'static str,
    /// Beginning of the name of what lies in flash.
    to: &'static str,
    why: &'static str,
}

/// What constants without a name are called: jump tables, texts, numbers.
const UNNAMED: &str = "unnamed constants";

/// What is called through pointers shows in no instruction.
const POINTERS: &str = "pointers";

/// Names begin as they do in reports: demangled, with angle brackets.
const PERMITS: [Permit; 25] = [
    // Interrupts.
    Permit { from: "_continue_interrupt_trap", to: POINTERS, why: VECTORS },
    Permit { from: "handle_interrupts", to: POINTERS, why: VECTORS },
    Permit { from: "_start_DefaultHandler_trap", to: "EspDefaultHandler", why: FATAL },
    Permit { from: "_start_trap_rust", to: "EspDefaultHandler", why: FATAL },
    Permit { from: "<esp_hal::peripherals::UART", to: "<esp_hal::peripherals::UART", why: LINK },
    Permit { from: "esp_hal::gpio::interrupt::", to: UNNAMED, why: "an interrupt of pins, which nobody asks for" },
    Permit {
        from: "esp_rtos::task::arch_specific::swint_handler",
        to: "<esp_rtos::scheduler::SchedulerState>::delete_marked_tasks",
        why: "threads that end, of which there are none",
    },
    // Wakers.
    Permit { from: "<esp_hal::asynch::AtomicWaker>::wake", to: POINTERS, why: LINK },
    Permit { from: "esp_rtos::timer::timer_tick_handler", to: POINTERS, why: WAKERS },
    Permit { from: "esp_rtos::embassy::handle_interrupt", to: POINTERS, why: WAKERS },
    Permit { from: "_embassy_time_schedule_wake", to: POINTERS, why: WAKERS },
    Permit { from: "_embassy_time_schedule_wake", to: "embassy_executor::raw::waker::VTABLE", why: WAKERS },
    Permit { from: "embassy_executor::raw::waker::", to: "embassy_executor::raw::waker::VTABLE", why: WAKERS },
    // The physics task.
    Permit { from: PHYSICS_TASK, to: "embassy_executor::raw::waker::VTABLE", why: WAKERS },
    Permit { from: PHYSICS_TASK, to: "flat_firmware::tasks::answer::answer", why: COMMANDS },
    Permit { from: PHYSICS_TASK, to: "flat_firmware::tasks::show::show", why: COMMANDS },
    Permit { from: PHYSICS_TASK, to: POINTERS, why: TABLES },
    // A tick.
    Permit { from: TICK, to: POINTERS, why: TABLES },
    Permit { from: TICK, to: UNNAMED, why: TABLES },
    Permit { from: TICK, to: "<flat_physics::world::World", why: TABLES },
    Permit { from: "flat_session::sink::encode", to: POINTERS, why: TABLES },
    Permit { from: "<flat_physics::step::Stage>::run", to: POINTERS, why: TABLES },
    Permit { from: "<flat_physics::tiles::map::TileMap>::contacts_a", to: POINTERS, why: TABLES },
    Permit { from: "flat_physics::tiles::around::visit_corner", to: POINTERS, why: TABLES },
    Permit {
        from: "<&flat_firmware::tasks::outbox::Outbox as flat_session::sink::Sink>::push",
        to: POINTERS,
        why: TABLES,
    },
];

const TICK: &str = "<flat_session::session::Session>::tick";
/// The future of the task, by the name that two attributes give it.
const PHYSICS_TASK: &str = "<embassy_executor::raw::TaskStorage<flat_firmware::tasks::simulate::";

const VECTORS: &str = "the table of interrupts: those of the timer and of physics are proven to be in RAM by name";
const FATAL: &str = "an exception: it ends the program";
const LINK: &str = "the link's interrupt: below physics, which interrupts it";
const WAKERS: &str =
    "the table of a waker's methods, a line of the cache at a wake; the methods are proven to be in RAM by name";
const COMMANDS: &str = "commands, and the scene that runs while there is none: between runs";
const TABLES: &str = "a table of methods or of a `match`, and what names a stage: a line of the cache each; what they lead to is \
                      listed and proven like the rest";

/// What code in RAM was found to want from flash: one code's references to one thing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The code in RAM.
    pub from: String,
    /// The thing in flash.
    pub to: String,
    /// What is done with it.
    pub does: &'static str,
    /// Where, first of all.
    pub at: u32,
    /// Where it lies, first of all; 0 = who knows.
    pub target: u32,
    /// How many instructions do so.
    pub count: usize,
    /// Why it may; none if it mustn't.
    pub permit: Option<&'static str>,
}

/// All references, and what was looked through for them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// By code and thing.
    pub findings: Vec<Finding>,
    /// Functions and pieces of assembly that were read.
    pub functions: usize,
    /// Instructions that were read.
    pub instructions: usize,
    /// References that lead only to a panic.
    pub to_panics: usize,
}

impl Report {
    /// What mustn't be, a line each.
    pub fn problems(&self) -> Vec<String> {
        let mut problems: Vec<_> =
            self.findings.iter().filter(|found| found.permit.is_none()).map(ToString::to_string).collect();
        // A permit that nothing needs any more would let something else pass one day.
        let is_used = |permit: &Permit| {
            self.findings.iter().any(|found| found.from.starts_with(permit.from) && found.to.starts_with(permit.to))
        };
        if self.functions > 0 {
            let idle = PERMITS.iter().filter(|permit| !is_used(permit));
            problems
                .extend(idle.map(|permit| format!("{} no longer wants {}: tell {}", permit.from, permit.to, file!())));
        }
        problems
    }

    /// What may be, by the reason why.
    pub fn permitted(&self) -> BTreeMap<&'static str, Vec<String>> {
        let mut permitted: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for found in &self.findings {
            if let Some(why) = found.permit {
                permitted.entry(why).or_default().push(found.to_string());
            }
        }
        permitted
    }
}

/// Reads all code in RAM.
///
/// # Errors
/// If the image's debug information is damaged.
pub fn list(image: &Image) -> Result<Report, Error> {
    let vtables = image.vtables()?;
    let constant = |address| match image.object_at(address) {
        Some(object) if !object.name.starts_with('.') => object.name.as_str(),
        _ => vtables.get(&address).map_or(UNNAMED, String::as_str),
    };
    let regions = [IRAM, ROM, used(image, FLASH_CODE), used(image, FLASH_DATA)];
    let matters = |address| regions.iter().any(|region| region.contains(&address));
    let diverges = |address| {
        FLASH_CODE.contains(&address)
            && image.function_at(address).is_some_and(|to| DIVERGING.iter().any(|start| to.name.starts_with(start)))
    };
    let question = Question { matters: &matters, diverges: &diverges };
    let mut report = Report::default();
    let mut grouped: BTreeMap<(String, String, &'static str), Finding> = BTreeMap::new();
    for (from, code) in functions(image) {
        report.functions += 1;
        report.instructions += code.len();
        let found = flow::follow(&code, &question);
        if let Some(&at) = found.through_pointers.first() {
            report.findings.push(Finding {
                permit: permit(&from, POINTERS),
                from: from.clone(),
                to: POINTERS.into(),
                does: "jumps through",
                at,
                target: 0,
                count: found.through_pointers.len(),
            });
        }
        for Reference { from: at, does, to: target, cold } in found.references {
            let (to, does) = match (FLASH_CODE.contains(&target), FLASH_DATA.contains(&target), does) {
                (true, _, Use::Jump) => (image.code_name(target), "calls"),
                (true, ..) => (image.code_name(target), "takes the address of"),
                (_, true, _) => (constant(target), "reads"),
                _ => continue,
            };
            if cold {
                report.to_panics += 1;
                continue;
            }
            let key = (from.clone(), to.to_owned(), does);
            let finding = grouped.entry(key).or_insert_with(|| Finding {
                permit: permit(&from, to),
                from: from.clone(),
                to: to.to_owned(),
                does,
                at,
                target,
                count: 0,
            });
            finding.count += 1;
        }
    }
    report.findings.extend(grouped.into_values());
    Ok(report)
}

/// What the image uses of a region: constants of arithmetic may look like addresses of the rest.
fn used(image: &Image, region: Range<u32>) -> Range<u32> {
    let inside = || image.sections.iter().filter(|section| region.contains(&section.address));
    let start = inside().map(|section| section.address).min();
    let end = inside().map(|section| section.address + section.size as u32).max();
    start.zip(end).map_or(region.clone(), |(start, end)| start..end)
}

fn permit(from: &str, to: &str) -> Option<&'static str> {
    PERMITS.iter().find(|permit| from.starts_with(permit.from) && to.starts_with(permit.to)).map(|permit| permit.why)
}

/// The code in RAM, a function or a piece of assembly at a time.
fn functions(image: &Image) -> Vec<(String, Vec<(u32, Instruction)>)> {
    let mut functions: Vec<(String, Vec<_>)> = Vec::new();
    for (at, instruction) in image.instructions().filter(|(at, _)| IRAM.contains(at)) {
        let name = image.code_name(at);
        match functions.last_mut() {
            Some((last, code)) if last == name => code.push((at, instruction)),
            _ => functions.push((name.to_owned(), vec![(at, instruction)])),
        }
    }
    functions
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { findings, functions, to_panics, .. } = self;
        let permitted: usize = findings.iter().filter(|found| found.permit.is_some()).map(|found| found.count).sum();
        let others: usize = findings.iter().filter(|found| found.permit.is_none()).map(|found| found.count).sum();
        write!(
            f,
            "from {functions} functions in RAM, {permitted} permitted references to flash, {others} others, {to_panics} to panics"
        )
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { from, to, does, at, target, count, .. } = self;
        write!(f, "{at:#010x}: {from} {does} {to}")?;
        if *target != 0 {
            write!(f, " at {target:#010x}")?;
        }
        if *count > 1 { write!(f, " and so on, {count} times") } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::firmware::elf::{Function, Sizes};

    const RAM: u32 = 0x4038_0000;
    const FLASH: u32 = 0x4200_0000;

    /// Code in RAM at `RAM`, two functions in flash.
    fn image(code: &[u32]) -> Image {
        let function = |name: &str, address, size| Function { name: name.to_owned(), address, size };
        let functions = vec![
            function("engine::step", RAM, code.len() as u32 * 4),
            function("slow", FLASH, 16),
            function("core::panicking::panic_fmt", FLASH + 0x1000, 16),
        ];
        let bytes: Vec<_> = code.iter().flat_map(|word| word.to_le_bytes()).collect();
        Image::of(functions, &[(RAM, &bytes)], Sizes::default())
    }

    fn findings(code: &[u32]) -> Vec<String> {
        list(&image(code)).unwrap().findings.iter().map(ToString::to_string).collect()
    }

    /// `auipc ra; jalr ra` at `at` instructions from the start of RAM.
    fn far_call(at: u32, to: u32) -> [u32; 2] {
        let distance = to.wrapping_sub(RAM + at * 4);
        [(distance.wrapping_add(0x800) & 0xffff_f000) | 0x97, (distance & 0xfff) << 20 | 0x80e7]
    }

    const RET: u32 = 0x0000_8067;

    #[test]
    fn a_call_into_flash_is_found_near_and_far() {
        let [upper, jump] = far_call(0, FLASH);
        assert_eq!(findings(&[upper, jump, RET]), ["0x40380004: engine::step calls slow at 0x42000000"]);
    }

    #[test]
    fn an_address_whose_halves_lie_apart_is_found_on_all_paths() {
        // lui a0, 0x3c005; beqz a1, .+8; addi a0, a0, -8; lw a2, 4(a0); ret
        let found = findings(&[0x3c00_5537, 0x0005_8463, 0xff85_0513, 0x0045_2603, RET]);
        // -8 for whoever sees it, -4 and 4 read.
        assert_eq!(found, ["0x40380008: engine::step reads unnamed constants at 0x3c004ff8 and so on, 3 times"]);
    }

    #[test]
    fn an_address_that_is_only_begun_is_found() {
        // lui a0, 0x3c005; xor a0, a0, a1; ret
        let found = findings(&[0x3c00_5537, 0x00b5_4533, RET]);
        assert_eq!(found, ["0x40380000: engine::step reads unnamed constants at 0x3c005000"]);
    }

    #[test]
    fn a_function_pointer_into_flash_is_found() {
        // lui a0, 0x42000; addi a0, a0, 4; ret
        let found = findings(&[0x4200_0537, 0x0045_0513, RET]);
        assert_eq!(found, ["0x40380004: engine::step takes the address of slow at 0x42000004"]);
    }

    #[test]
    fn what_leads_only_to_a_panic_is_counted_and_passed_over() {
        // beqz a1, .+20; lui a0, 0x3c005; addi a0, a0, 8; call the panic; ret
        let [upper, jump] = far_call(3, FLASH + 0x1000);
        let report = list(&image(&[0x0005_8a63, 0x3c00_5537, 0x0085_0513, upper, jump, RET])).unwrap();
        assert_eq!((report.findings.len(), report.to_panics), (0, 2));
    }

    #[test]
    fn code_behind_a_computed_jump_is_read() {
        // lui a0, 0x3c005; lw a1, 8(a0); jr a1; (a table leads here) lw a2, 12(a0); ret
        let report = list(&image(&[0x3c00_5537, 0x0085_2583, 0x0005_8067, 0x00c5_2603, RET])).unwrap();
        let found: Vec<_> = report.findings.iter().map(ToString::to_string).collect();
        assert_eq!(
            found,
            [
                "0x40380008: engine::step jumps through pointers",
                "0x40380004: engine::step reads unnamed constants at 0x3c005008 and so on, 2 times"
            ]
        );
    }
}
