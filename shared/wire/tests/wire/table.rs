//! The message table: all of it is sampled, all of it fits a frame, none of it changes unnoticed.

use std::fmt::Debug;
use std::{env, fs, iter};

use flat_wire::message::{
    Cause, Command, Counter, Detail, Event, FaultKind, Flow, Frame, Level, Mishap, Mix, Order, Phase, Reply, ScalarKind,
};
use flat_wire::{MAX_FRAME, MAX_MESSAGE, PROTOCOL_VERSION, encode};
use postcard::experimental::serialized_size;
use proptest::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::samples::{
    CAUSES, COUNTERS, DETAILS, FAULTS, FLOWS, LEVELS, MISHAPS, MIXES, ORDERS, PHASES, SCALARS, Source,
};

fn bytes(message: &impl Serialize) -> Vec<u8> {
    let mut buffer = [0; 2 * MAX_FRAME];
    postcard::to_slice(message, &mut buffer).expect("twice a frame is enough").to_vec()
}

/// Fails if the samples aren't one of each variant, in order. A variant's number is its first byte.
fn assert_all_sampled<T: Serialize + DeserializeOwned>(name: &str, samples: &[T]) {
    let unknown = Err(postcard::Error::SerdeDeCustom);
    let variants = (0..128).take_while(|&n| postcard::from_bytes::<T>(&[n]).map(drop) != unknown);
    let sampled = samples.iter().map(|sample| bytes(sample)[0]);
    assert!(sampled.eq(variants), "{name}: samples.rs must list each variant once, in order");
}

#[test]
fn samples_cover_every_variant() {
    let mut source = Source::Counting(0);
    assert_all_sampled::<Command>("Command", &source.commands());
    assert_all_sampled::<Reply>("Reply", &source.replies());
    assert_all_sampled::<Frame>("Frame", &source.frames());
    let events = source.events();
    assert_all_sampled::<Event>("Event", &[events[0].clone(), events[events.len() - 1].clone()]);
    assert_all_sampled::<Order>("Order", ORDERS);
    assert_all_sampled::<Level>("Level", LEVELS);
    assert_all_sampled::<ScalarKind>("ScalarKind", SCALARS);
    assert_all_sampled::<Detail>("Detail", DETAILS);
    assert_all_sampled::<Flow>("Flow", FLOWS);
    assert_all_sampled::<Counter>("Counter", COUNTERS);
    assert_all_sampled::<Mix>("Mix", MIXES);
    assert_all_sampled::<Phase>("Phase", PHASES);
    assert_all_sampled::<Cause>("Cause", CAUSES);
    assert_all_sampled::<FaultKind>("FaultKind", FAULTS);
    assert_all_sampled::<Mishap>("Mishap", MISHAPS);
}

#[test]
fn the_longest_of_each_message_fits_a_frame() {
    fn assert_fits(message: &(impl Serialize + Debug)) {
        let length = serialized_size(message).expect("messages have a size");
        assert!(length <= MAX_MESSAGE, "{length} bytes, limit {MAX_MESSAGE}: {message:?}");
        encode(u16::MAX, message, &mut [0; MAX_FRAME]).expect("a message in the limit is encoded");
    }
    Source::Longest.commands().iter().for_each(assert_fits);
    Source::Longest.events().iter().for_each(assert_fits);
}

proptest! {
    /// Keeps the test above honest.
    #[test]
    fn no_message_is_longer_than_the_longest_of_its_kind(mut source in Source::random()) {
        fn assert_shorter<T: Serialize>(messages: &[T], longest: &[T]) {
            for (message, longest) in messages.iter().zip(longest) {
                assert!(bytes(message).len() <= bytes(longest).len());
            }
        }
        assert_shorter(&source.commands(), &Source::Longest.commands());
        assert_shorter(&source.events(), &Source::Longest.events());
    }
}

/// One message of each kind as text: its bytes, and the length of the longest of its kind.
fn rendered() -> String {
    fn messages<T: Debug + Serialize>(kind: &str, messages: &[T], longest: &[T]) -> String {
        let line = |(message, longest)| {
            let longest = bytes(longest).len();
            format!("\n{kind}::{message:?}\n  {} (at most {longest})\n", hex(message))
        };
        messages.iter().zip(longest).map(line).collect()
    }
    fn choices<T: Debug + Serialize>(kind: &str, all: &[T]) -> String {
        let choice = |value| format!("\n{kind}::{value:?}\n  {}\n", hex(value));
        all.iter().map(choice).collect()
    }
    fn hex(value: &impl Serialize) -> String {
        bytes(value).iter().map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().join(" ")
    }
    let mut source = Source::Counting(0);
    [
        format!("protocol {PROTOCOL_VERSION}\n"),
        messages("Command", &source.commands(), &Source::Longest.commands()),
        messages("Event", &source.events(), &Source::Longest.events()),
        choices("Order", ORDERS),
        choices("Level", LEVELS),
        choices("ScalarKind", SCALARS),
        choices("Detail", DETAILS),
        choices("Flow", FLOWS),
        choices("Counter", COUNTERS),
        choices("Mix", MIXES),
        choices("Phase", PHASES),
        choices("Cause", CAUSES),
        choices("FaultKind", FAULTS),
        choices("Mishap", MISHAPS),
    ]
    .concat()
}

/// Two builds of one protocol version must understand each other.
#[test]
fn bytes_change_only_with_the_protocol_version() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/wire/table.txt");
    let kept = fs::read_to_string(path).unwrap_or_default();
    let rendered = rendered();
    let version_is_kept = rendered.lines().next() == kept.lines().next();
    if env::var_os("FLAT_BLESS").is_some() && !version_is_kept {
        return fs::write(path, rendered).expect("the sources are writable");
    }
    let ended = iter::repeat("(end)");
    let mut lines = kept.lines().chain(ended.clone()).zip(rendered.lines().chain(ended));
    let longest = kept.lines().count().max(rendered.lines().count());
    if let Some((was, is)) = lines.by_ref().take(longest).find(|(was, is)| was != is) {
        panic!(
            "the bytes of the message table changed\n was: {was}\n  is: {is}\n\
             Raise PROTOCOL_VERSION, then accept them: FLAT_BLESS=1 cargo test -p flat-wire\n\
             If no release speaks this version yet, delete {path} instead of raising it."
        );
    }
}
