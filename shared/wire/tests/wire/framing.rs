//! Frames on a good line, on a bad line, and from strangers.

use flat_wire::message::{Command, Event};
use flat_wire::{Counters, Decoder, FrameError, MAX_FRAME, MAX_MESSAGE, Packet, encode};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use serde::de::DeserializeOwned;
use serde::ser::{Serialize, SerializeTuple, Serializer};

use crate::samples::Source;

type Received<T> = Result<Packet<T>, FrameError>;

fn packet<T>(sequence: u16, message: T) -> Packet<T> {
    Packet { sequence, message }
}

fn frame(sequence: u16, message: &impl Serialize) -> Vec<u8> {
    encode(sequence, message, &mut [0; MAX_FRAME]).expect("the message fits").to_vec()
}

/// Everything that the decoder says to these bytes.
fn receive<T: DeserializeOwned>(decoder: &mut Decoder, bytes: &[u8]) -> Vec<Received<T>> {
    bytes.iter().filter_map(|&byte| decoder.push(byte)).collect()
}

/// A message that no table has: these very bytes.
struct Raw(Vec<u8>);

impl Serialize for Raw {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut tuple = serializer.serialize_tuple(self.0.len())?;
        self.0.iter().try_for_each(|byte| tuple.serialize_element(byte))?;
        tuple.end()
    }
}

proptest! {
    #[test]
    fn every_message_arrives_as_sent(mut source in Source::random(), sequence: u16) {
        let mut decoder = Decoder::new();
        for message in source.commands() {
            let received = receive(&mut decoder, &frame(sequence, &message));
            prop_assert_eq!(received, [Ok(packet(sequence, message))]);
        }
        for message in source.events() {
            let received = receive(&mut decoder, &frame(sequence, &message));
            prop_assert_eq!(received, [Ok(packet(sequence, message))]);
        }
    }
}

#[test]
fn every_length_up_to_the_limit_fits_a_frame_and_none_above_goes_out_unreadable() {
    // Without a zero COBS adds most; with nothing else it adds least.
    for fill in [0, 1, u8::MAX] {
        for length in 0..=MAX_FRAME {
            let mut buffer = [0; MAX_FRAME];
            let Ok(frame) = encode(0x0101, &Raw(vec![fill; length]), &mut buffer) else {
                assert!(length > MAX_MESSAGE, "{length} bytes of {fill} don't fit");
                continue;
            };
            assert_eq!(frame.iter().position(|&byte| byte == 0), Some(frame.len() - 1));
            let received = receive::<Event>(&mut Decoder::new(), frame);
            // No such event, but whole and undamaged.
            assert!(
                matches!(received[..], [Ok(_) | Err(FrameError::Malformed { sequence: 0x0101 })]),
                "{length} bytes of {fill}: {received:?}"
            );
        }
    }
}

#[test]
fn extra_delimiters_are_harmless() {
    let status = frame(0, &Command::Status);
    let line = [&[0, 0][..], &status, &[0, 0, 0], &status].concat();
    let received = receive(&mut Decoder::new(), &line);
    assert_eq!(received, [Ok(packet(0, Command::Status)), Ok(packet(0, Command::Status))]);
}

/// What a bad line does to its bytes.
#[derive(Clone, Debug)]
enum Damage {
    Invert { at: Index, bits: u8 },
    Lose { at: Index, length: usize },
    Insert { at: Index, byte: u8 },
    Repeat { at: Index },
}

impl Damage {
    fn any() -> impl Strategy<Value = Self> {
        // Zeros are as likely as all other bytes together: they are what frames end with.
        let byte = prop_oneof![Just(0), any::<u8>()];
        prop_oneof![
            (any::<Index>(), 1u8..).prop_map(|(at, bits)| Self::Invert { at, bits }),
            (any::<Index>(), 1usize..600).prop_map(|(at, length)| Self::Lose { at, length }),
            (any::<Index>(), byte).prop_map(|(at, byte)| Self::Insert { at, byte }),
            any::<Index>().prop_map(|at| Self::Repeat { at }),
        ]
    }

    fn apply(&self, line: &mut Vec<u8>) {
        if line.is_empty() {
            return;
        }
        match self {
            Self::Invert { at, bits } => {
                let at = at.index(line.len());
                line[at] ^= bits;
            }
            Self::Lose { at, length } => {
                let start = at.index(line.len());
                line.drain(start..line.len().min(start + length));
            }
            Self::Insert { at, byte } => line.insert(at.index(line.len()), *byte),
            Self::Repeat { at } => {
                let at = at.index(line.len());
                line.insert(at, line[at]);
            }
        }
    }
}

proptest! {
    /// The line is also cut at its zeros here, by the book: each piece that was sent must be received, each other
    /// piece refused once, in this order. A frame sent whole behind damage is such a piece.
    #[test]
    fn damage_costs_only_the_frames_it_hits(
        mut source in Source::random(),
        first: u16,
        damages in vec(Damage::any(), 0..8),
    ) {
        let sent: Vec<(Vec<u8>, Packet<Event>)> = source.events().into_iter().cycle().take(40).zip(0..)
            .map(|(message, n)| {
                let sequence = first.wrapping_add(n);
                (frame(sequence, &message), Packet { sequence, message })
            })
            .collect();
        let mut line: Vec<u8> = sent.iter().flat_map(|(frame, _)| frame.clone()).collect();
        for damage in &damages {
            damage.apply(&mut line);
        }
        line.push(0);

        let pieces = line.split_inclusive(|&byte| byte == 0).filter(|piece| *piece != [0]);
        let expected: Vec<Option<Packet<Event>>> = pieces
            .map(|piece| sent.iter().find(|(frame, _)| frame == piece).map(|(_, packet)| packet.clone()))
            .collect();
        let mut decoder = Decoder::new();
        let received: Vec<_> = receive(&mut decoder, &line).into_iter().map(Received::ok).collect();
        prop_assert_eq!(&received, &expected);

        let sequences: Vec<u16> = expected.iter().flatten().map(|packet| packet.sequence).collect();
        let span = match sequences[..] {
            [] => 0,
            [first, .., last] => usize::from(last.wrapping_sub(first)) + 1,
            [_] => 1,
        };
        prop_assert_eq!(decoder.counters(), Counters {
            received: sequences.len() as u32,
            damaged: (received.len() - sequences.len()) as u32,
            missing: (span - sequences.len()) as u32,
        });
    }

    #[test]
    fn a_frame_behind_any_garbage_is_received(
        garbage in vec(prop_oneof![9 => any::<u8>(), 1 => Just(0)], 0..3000),
    ) {
        let mut decoder = Decoder::new();
        receive::<Command>(&mut decoder, &garbage);
        receive::<Command>(&mut decoder, &[0]);
        let received = receive(&mut decoder, &frame(3, &Command::Stop));
        prop_assert_eq!(received, [Ok(packet(3, Command::Stop))]);
    }

    /// The checksum of another protocol's frame is right, so its content reaches the parser.
    #[test]
    fn foreign_messages_are_refused_or_read_but_never_panic(content in vec(any::<u8>(), 0..MAX_MESSAGE), sequence: u16) {
        let line = frame(sequence, &Raw(content));
        for received in receive::<Event>(&mut Decoder::new(), &line) {
            match received {
                Ok(packet) => prop_assert_eq!(packet.sequence, sequence),
                Err(error) => prop_assert_eq!(error, FrameError::Malformed { sequence }),
            }
        }
        receive::<Command>(&mut Decoder::new(), &line);
    }
}

#[test]
fn messages_of_a_newer_table_are_named_as_such_and_not_counted_missing() {
    let newer_variant = Raw(vec![8, 1, 2]);
    let newer_field = Raw(vec![5, 1]); // Status, and something behind it
    let line = [frame(9, &newer_variant), frame(10, &newer_field), frame(11, &Command::Status)].concat();
    let mut decoder = Decoder::new();
    assert_eq!(
        receive(&mut decoder, &line),
        [
            Err(FrameError::Malformed { sequence: 9 }),
            Err(FrameError::Malformed { sequence: 10 }),
            Ok(packet(11, Command::Status)),
        ]
    );
    assert_eq!(decoder.counters(), Counters { received: 1, damaged: 2, missing: 0 });
    let text = FrameError::Malformed { sequence: 9 }.to_string();
    assert!(text.contains("frame 9") && text.contains("same sources"), "{text}");
}

#[test]
fn each_kind_of_damage_has_its_name() {
    let status = frame(0x0101, &Command::Status);
    let mut inverted = status.clone();
    inverted[1] ^= 0x80;
    let cut = [&status[..3], &[0]].concat();
    let too_few = vec![4, 1, 1, 1, 0]; // proper COBS of three bytes
    let endless = [&vec![1; 3 * MAX_FRAME][..], &[0]].concat();
    for (line, error) in [
        (inverted, FrameError::Damaged),
        (cut, FrameError::Truncated),
        (too_few, FrameError::Truncated),
        (endless, FrameError::Oversize),
    ] {
        let mut decoder = Decoder::new();
        assert_eq!(receive::<Command>(&mut decoder, &line), [Err(error)]);
        assert_eq!(receive(&mut decoder, &status), [Ok(packet(0x0101, Command::Status))]);
    }
}

#[test]
fn an_endless_frame_is_refused_before_it_ends() {
    let mut decoder = Decoder::new();
    assert_eq!(receive::<Command>(&mut decoder, &[1; MAX_FRAME]), [Err(FrameError::Oversize)]);
    assert_eq!(receive::<Command>(&mut decoder, &[1; MAX_FRAME]), []);
}

#[test]
fn gaps_in_the_sequence_are_missing_frames_and_steps_back_are_not() {
    // Sequence number; frames that are missing in front of it.
    let arrivals = [
        (65_530, 0), // the first may have any number
        (65_531, 0),
        (65_533, 1),
        (65_533, 0), // repeated
        (65_534, 0),
        (2, 3), // 65 535, 0, 1: across the wrap
        (3, 0),
        (0, 0), // the sender was restarted
        (1, 0),
        (0x8000, 0x7FFE), // all but half the range
    ];
    let mut decoder = Decoder::new();
    let mut missing = 0;
    for (sequence, gap) in arrivals {
        missing += gap;
        receive::<Command>(&mut decoder, &frame(sequence, &Command::Stop));
        assert_eq!(decoder.counters().missing, missing, "after frame {sequence}");
    }
    assert_eq!(decoder.counters().received, arrivals.len() as u32);
}
