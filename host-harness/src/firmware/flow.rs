//! The addresses that a function builds out of immediates, and what it does with them.
//!
//! An address takes two instructions, `lui` or `auipc` and then whatever adds the low bits, which may be far apart and meet
//! several of their kind. So the values that each register may hold are followed along all paths through the function (a
//! forward may-analysis to a fixed point: Kildall 1973). Whatever starts an address that nothing is seen to use is reported
//! all the same: no address escapes by being built in a way that this doesn't know.

use std::collections::{BTreeMap, BTreeSet};

use super::instructions::Instruction;
use super::operation::{Operation, RA, Register};

/// What is done with an address.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Use {
    /// Control goes there, and may come back.
    Jump,
    /// Read from or written to.
    Access,
    /// Built, for whoever gets to see it.
    Address,
}

/// An address in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Reference {
    /// The instruction.
    pub from: u32,
    /// What it does.
    pub does: Use,
    /// The address.
    pub to: u32,
    /// Whether all that can follow is a call that never returns.
    pub cold: bool,
}

/// What a function's code was found to do.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Found {
    /// References to addresses of interest.
    pub references: BTreeSet<Reference>,
    /// Instructions that jump to an address that was not built here, returns aside.
    pub through_pointers: BTreeSet<u32>,
}

/// What the reader of a function wants to know.
pub(crate) struct Question<'a> {
    /// Whether an address matters. Those near the edges of a region must, too: halves of addresses are asked for.
    pub matters: &'a dyn Fn(u32) -> bool,
    /// Whether a function never returns.
    pub diverges: &'a dyn Fn(u32) -> bool,
}

/// A value that a register may hold, and the instruction that began to build it.
type Value = (u32, u32);
type Registers = BTreeMap<Register, BTreeSet<Value>>;

/// Values kept for a register. More are met only where a loop counts an address up.
const MOST_VALUES: usize = 16;
/// What `lui` and `auipc` leave may be so far from the address.
const LOW_BITS: u32 = 0x800;

struct Walk<'a> {
    code: BTreeMap<u32, (Operation, u32)>,
    question: &'a Question<'a>,
    before: BTreeMap<u32, Registers>,
    found: Found,
    used: BTreeSet<u32>,
}

/// Reads one function's instructions with their addresses, in ascending order.
pub(crate) fn follow(code: &[(u32, Instruction)], question: &Question<'_>) -> Found {
    let code: BTreeMap<_, _> =
        code.iter().map(|&(at, found)| (at, (Operation::of(found), at + found.length as u32))).collect();
    let mut walk = Walk { code, question, before: BTreeMap::new(), found: Found::default(), used: BTreeSet::new() };
    walk.run();
    walk.found
}

impl Walk<'_> {
    fn run(&mut self) {
        let mut pending: BTreeSet<u32> = self.code.keys().next().copied().into_iter().collect();
        // What a computed jump may find in the registers: jump tables aren't read, so any of their places may be next.
        let mut at_jumps = Registers::new();
        let mut entries: BTreeSet<u32> = pending.clone();
        loop {
            while let Some(at) = pending.pop_first() {
                let (operation, next) = self.code[&at];
                let after = self.execute(at, operation);
                let mut goes_on = self.successors(at, operation, next);
                if is_computed_jump(operation) {
                    merge(&mut at_jumps, &after);
                    goes_on.extend(&entries);
                }
                for to in goes_on {
                    let is_first = !self.before.contains_key(&to);
                    if merge(self.before.entry(to).or_default(), &after) || is_first {
                        pending.insert(to);
                    }
                }
                self.before.entry(at).or_default();
            }
            // Nothing visible leads here: one of a table's places.
            let Some(hidden) = self.code.keys().copied().find(|at| !self.before.contains_key(at)) else { break };
            self.before.insert(hidden, at_jumps.clone());
            entries.insert(hidden);
            pending.insert(hidden);
        }
        self.report_halves();
        self.mark_cold();
    }

    /// Where control may go from here inside the function.
    fn successors(&self, at: u32, operation: Operation, next: u32) -> Vec<u32> {
        let (target, falls_through) = match operation {
            Operation::Branch { distance } => (Some(at.wrapping_add(distance)), true),
            Operation::Jump { link: 0, distance } => (Some(at.wrapping_add(distance)), false),
            Operation::Jump { distance, .. } => (None, !(self.question.diverges)(at.wrapping_add(distance))),
            Operation::JumpRegister { link: 0, .. } | Operation::Return => (None, false),
            Operation::JumpRegister { base, offset, .. } => {
                let diverges = |&(value, _): &Value| (self.question.diverges)(value.wrapping_add(offset));
                (None, !self.values(at, base).iter().any(diverges))
            }
            _ => (None, true),
        };
        let next = falls_through.then_some(next);
        target.into_iter().chain(next).filter(|to| self.code.contains_key(to)).collect()
    }

    fn values(&self, at: u32, register: Register) -> BTreeSet<Value> {
        self.before.get(&at).and_then(|registers| registers.get(&register)).cloned().unwrap_or_default()
    }

    /// Notes what the instruction does with addresses and returns what the registers may hold after it.
    fn execute(&mut self, at: u32, operation: Operation) -> Registers {
        let mut after = self.before.get(&at).cloned().unwrap_or_default();
        match operation {
            Operation::Constant { to, value } => self.write(&mut after, to, BTreeSet::from([(value, at)])),
            Operation::Relative { to, distance } => {
                self.write(&mut after, to, BTreeSet::from([(at.wrapping_add(distance), at)]));
            }
            Operation::Offset { to, from, by } => {
                let values: BTreeSet<_> =
                    self.values(at, from).into_iter().map(|(value, root)| (value.wrapping_add(by), root)).collect();
                self.write(&mut after, to, values.clone());
                // Moving an address from register to register doesn't use it yet.
                if by != 0 {
                    self.note(at, Use::Address, &values, 0);
                }
            }
            Operation::Sum { to, of: [first, second] } => {
                self.write(&mut after, to, self.values(at, first).union(&self.values(at, second)).copied().collect());
            }
            Operation::Load { to, base, offset } => {
                self.write(&mut after, to, BTreeSet::new());
                self.note(at, Use::Access, &self.values(at, base), offset);
            }
            Operation::Store { base, offset } => self.note(at, Use::Access, &self.values(at, base), offset),
            Operation::Jump { link, distance } => {
                after = if link == 0 { after } else { kept_by_callee(after) };
                let to = at.wrapping_add(distance);
                if !self.code.contains_key(&to) && (self.question.matters)(to) {
                    self.found.references.insert(Reference { from: at, does: Use::Jump, to, cold: false });
                }
            }
            Operation::JumpRegister { link, base, offset } => {
                let values = self.values(at, base);
                if values.is_empty() && !is_return(operation) {
                    self.found.through_pointers.insert(at);
                } else {
                    self.found.through_pointers.remove(&at);
                }
                self.note(at, Use::Jump, &values, offset);
                after = if link == 0 { after } else { kept_by_callee(after) };
            }
            Operation::Other { to } => self.write(&mut after, to, BTreeSet::new()),
            Operation::Branch { .. } | Operation::Return => {}
        }
        after
    }

    fn write(&self, registers: &mut Registers, to: Register, mut values: BTreeSet<Value>) {
        values.retain(|&(value, _)| self.is_near(value));
        if to == 0 || values.is_empty() {
            registers.remove(&to);
        } else {
            registers.insert(to, values);
        }
    }

    fn note(&mut self, at: u32, does: Use, values: &BTreeSet<Value>, offset: u32) {
        for &(value, root) in values {
            let to = value.wrapping_add(offset);
            self.used.insert(root);
            if (self.question.matters)(to) {
                self.found.references.insert(Reference { from: at, does, to, cold: false });
            }
        }
    }

    /// Whether a value may be, or become with its low bits, an address that matters.
    fn is_near(&self, value: u32) -> bool {
        [0, LOW_BITS, LOW_BITS.wrapping_neg()].iter().any(|by| (self.question.matters)(value.wrapping_add(*by)))
    }

    /// Addresses that were begun and, as far as was seen, not used.
    fn report_halves(&mut self) {
        for (&at, &(operation, _)) in &self.code {
            let value = match operation {
                Operation::Constant { value, .. } => value,
                Operation::Relative { distance, .. } => at.wrapping_add(distance),
                _ => continue,
            };
            if !self.used.contains(&at) && (self.question.matters)(value) {
                self.found.references.insert(Reference { from: at, does: Use::Address, to: value, cold: false });
            }
        }
    }

    /// Marks references after which only a call that never returns can follow.
    fn mark_cold(&mut self) {
        let mut cold: BTreeSet<u32> = BTreeSet::new();
        let diverging = self.found.references.iter().filter(|reference| reference.does == Use::Jump);
        cold.extend(diverging.filter(|jump| (self.question.diverges)(jump.to)).map(|jump| jump.from));
        loop {
            let count = cold.len();
            // Backwards: what a block ends in is known before what it begins with.
            for (&at, &(operation, next)) in self.code.iter().rev() {
                let successors = self.successors(at, operation, next);
                if !successors.is_empty() && successors.iter().all(|to| cold.contains(to)) {
                    cold.insert(at);
                }
            }
            if cold.len() == count {
                break;
            }
        }
        let references = std::mem::take(&mut self.found.references);
        self.found.references =
            references.into_iter().map(|found| Reference { cold: cold.contains(&found.from), ..found }).collect();
    }
}

/// Adds values to those that registers may hold; true if that told anything new.
fn merge(known: &mut Registers, values: &Registers) -> bool {
    let mut is_new = false;
    for (&register, values) in values {
        let known = known.entry(register).or_default();
        for &value in values {
            is_new |= known.len() < MOST_VALUES && known.insert(value);
        }
    }
    is_new
}

fn is_return(operation: Operation) -> bool {
    matches!(operation, Operation::JumpRegister { link: 0, base: RA, .. })
}

fn is_computed_jump(operation: Operation) -> bool {
    matches!(operation, Operation::JumpRegister { link: 0, .. }) && !is_return(operation)
}

/// What a call leaves alone: "Integer Register Convention" in the RISC-V psABI.
fn kept_by_callee(mut registers: Registers) -> Registers {
    registers.retain(|register, _| matches!(register, 2..=4 | 8..=9 | 18..=27));
    registers
}
