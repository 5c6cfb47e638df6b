//! Where source-level functions went: their own bodies, and every copy that was inlined into another function.
//!
//! After link-time optimisation few functions keep a symbol; the debug information still knows all of them.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use gimli::{
    AttributeValue, DebugInfoOffset, DebuggingInformationEntry, DwTag, Dwarf, EndianSlice, LittleEndian, Operation,
    UnitRef,
};
use object::{Object, ObjectSection};

pub type Slice<'data> = EndianSlice<'data, LittleEndian>;
type Entry<'data> = DebuggingInformationEntry<Slice<'data>>;

/// Some code of a source-level function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Demangled as a path, `crate::module::Type::function`, and behind it what it is generic over.
    pub function: String,
    /// Addresses.
    pub code: Range<u32>,
}

/// Lists the places of all functions that `wanted` picks by name.
///
/// # Errors
/// If the debug information is damaged.
pub fn places<'data>(file: &impl Object<'data>, wanted: impl Fn(&str) -> bool) -> Result<Vec<Place>, gimli::Error> {
    let dwarf = load(file)?;
    let mut names = Names::default();
    each_entry(&dwarf, &FUNCTIONS, |unit, entry| names.note(unit, entry))?;

    let mut places = Vec::new();
    each_entry(&dwarf, &FUNCTIONS, |unit, entry| {
        let Some(name) = names.of(unit, entry).filter(|name| wanted(name)) else { return Ok(()) };
        let mut ranges = unit.die_ranges(entry)?;
        while let Some(range) = ranges.next()? {
            // Code that was thrown away at link time is left at address 0.
            if range.begin != 0 && range.begin < range.end {
                places.push(Place { function: name.to_owned(), code: range.begin as u32..range.end as u32 });
            }
        }
        Ok(())
    })?;
    Ok(places)
}

/// Lists the tables behind trait objects, by address: `<Type as Trait>::{vtable}`.
///
/// # Errors
/// If the debug information is damaged.
pub fn vtables<'data>(file: &impl Object<'data>) -> Result<BTreeMap<u32, String>, gimli::Error> {
    let dwarf = load(file)?;
    let mut tables = BTreeMap::new();
    each_entry(&dwarf, &[gimli::DW_TAG_variable], |unit, entry| {
        let (Some(name), Some(AttributeValue::Exprloc(place))) =
            (entry.attr_value(gimli::DW_AT_name), entry.attr_value(gimli::DW_AT_location))
        else {
            return Ok(());
        };
        let name = unit.attr_string(name)?.to_string_lossy();
        if let Some(Operation::Address { address }) = place.operations(unit.encoding()).next()?
            && name.ends_with("::{vtable}")
        {
            tables.insert(address as u32, name.into_owned());
        }
        Ok(())
    })?;
    Ok(tables)
}

pub fn load<'data>(file: &impl Object<'data>) -> Result<Dwarf<Slice<'data>>, gimli::Error> {
    Dwarf::load(|id| {
        let section = file.section_by_name(id.name());
        let data = section.and_then(|section| section.data().ok()).unwrap_or_default();
        Ok::<_, gimli::Error>(EndianSlice::new(data, LittleEndian))
    })
}

/// Functions and their inlined copies.
const FUNCTIONS: [DwTag; 2] = [gimli::DW_TAG_subprogram, gimli::DW_TAG_inlined_subroutine];

/// Visits all entries of some kinds.
fn each_entry<'data>(
    dwarf: &Dwarf<Slice<'data>>,
    tags: &[DwTag],
    mut visit: impl FnMut(UnitRef<'_, Slice<'data>>, &Entry<'data>) -> Result<(), gimli::Error>,
) -> Result<(), gimli::Error> {
    let mut headers = dwarf.units();
    while let Some(header) = headers.next()? {
        let unit = dwarf.unit(header)?;
        let mut entries = unit.entries();
        while let Some(entry) = entries.next_dfs()? {
            if tags.contains(&entry.tag) {
                visit(unit.unit_ref(dwarf), entry)?;
            }
        }
    }
    Ok(())
}

/// Names by the offsets of the entries that carry them. A body or a copy refers to such an entry, at times by way of
/// another one.
#[derive(Default)]
struct Names {
    names: HashMap<DebugInfoOffset, String>,
    referrals: HashMap<DebugInfoOffset, DebugInfoOffset>,
}

impl Names {
    fn note<'data>(&mut self, unit: UnitRef<'_, Slice<'data>>, entry: &Entry<'data>) -> Result<(), gimli::Error> {
        let Some(here) = entry.offset.to_debug_info_offset(&unit.header) else { return Ok(()) };
        if let Some(value) = entry.attr_value(gimli::DW_AT_linkage_name) {
            let mangled = unit.attr_string(value)?.to_string_lossy().into_owned();
            self.names.insert(here, path_of(&format!("{:#}", rustc_demangle::demangle(&mangled))));
        } else if let Some(there) = referral(unit, entry) {
            self.referrals.insert(here, there);
        }
        Ok(())
    }

    fn of<'data>(&self, unit: UnitRef<'_, Slice<'data>>, entry: &Entry<'data>) -> Option<&str> {
        let mut at = entry.offset.to_debug_info_offset(&unit.header)?;
        while let Some(&next) = self.referrals.get(&at) {
            at = next;
        }
        self.names.get(&at).map(String::as_str)
    }
}

fn referral<'data>(unit: UnitRef<'_, Slice<'data>>, entry: &Entry<'data>) -> Option<DebugInfoOffset> {
    let origin = entry.attr_value(gimli::DW_AT_abstract_origin);
    match origin.or_else(|| entry.attr_value(gimli::DW_AT_specification))? {
        AttributeValue::UnitRef(offset) => offset.to_debug_info_offset(&unit.header),
        AttributeValue::DebugInfoRef(offset) => Some(offset),
        _ => None,
    }
}

/// `<a::Type>::function` as `a::Type::function`, as older compilers mangle it.
fn path_of(name: &str) -> String {
    match name.strip_prefix('<').and_then(|rest| rest.split_once(">::")) {
        Some((owner, function)) if !owner.contains([' ', '<']) => format!("{owner}::{function}"),
        _ => name.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inherent_functions_read_as_paths() {
        assert_eq!(path_of("<a::b::Clock>::take"), "a::b::Clock::take");
        assert_eq!(path_of("a::b::solve::<a::Fixed>"), "a::b::solve::<a::Fixed>");
        assert_eq!(path_of("<a::Clock as b::Tick>::tick"), "<a::Clock as b::Tick>::tick");
    }
}
