//! A device without physics talks like any other.

use flat_session::{Identity, LinkCounters, Ring, bare};
use flat_wire::message::{Command, Counter, Event, Hello, Reply, SceneRequest, Stack};
use flat_wire::{Decoder, PROTOCOL_VERSION};

const ROOM: usize = 4096;

fn device() -> bare::Session {
    bare::Session::new(Identity { board: "test", build: "b", clock_hz: 1, counter: Counter::None })
}

/// The reply to a command, and to which one it is.
fn reply(device: &mut bare::Session, sequence: u16, command: &Command) -> (u16, Reply) {
    let mut ring = Ring::<ROOM>::new();
    device.handle(0, sequence, command, &mut ring);
    sent(&mut ring)
}

fn sent(ring: &mut Ring<ROOM>) -> (u16, Reply) {
    let mut bytes = [0; ROOM];
    let count = ring.read(&mut bytes);
    let mut decoder = Decoder::new();
    let packet = bytes[..count].iter().find_map(|&byte| decoder.push(byte)).expect("a frame").expect("an intact one");
    match packet.message {
        Event::Reply { to, reply } => (to, reply),
        Event::Frame(frame) => panic!("{frame:?} is no reply"),
    }
}

#[test]
fn it_says_who_it_is_and_that_it_has_no_room_for_bodies() {
    let (to, reply) = reply(&mut device(), 7, &Command::Hello { protocol: PROTOCOL_VERSION });
    let Reply::Hello(Hello { protocol, board, build, capacities, .. }) = reply else { panic!("{reply:?} is no hello") };
    assert_eq!((to, protocol, board.as_str(), build.as_str()), (7, PROTOCOL_VERSION, "test", "b"));
    assert!(capacities.is_empty());
}

#[test]
fn it_tells_how_its_link_and_its_stack_do() {
    let mut device = device();
    device.note_link(LinkCounters { received: 5, damaged: 2 });
    device.note_stack(Stack { size: 100, peak: 30 });
    let Reply::Status(status) = reply(&mut device, 0, &Command::Status).1 else { panic!("no status") };
    assert_eq!((status.received, status.damaged, status.stack.peak), (5, 2, 30));
}

#[test]
fn what_takes_a_world_is_refused_with_the_reason() {
    for command in [Command::Load(SceneRequest::default()), Command::Run { steps: 1 }, Command::Input { buttons: 0 }] {
        let Reply::Refused(why) = reply(&mut device(), 0, &command).1 else { panic!("{command:?} wasn't refused") };
        assert!(why.contains("no physics"), "{why}");
    }
}

#[test]
fn a_command_of_another_table_is_refused_with_the_version() {
    let mut ring = Ring::<ROOM>::new();
    device().refuse_unknown(3, &mut ring);
    let (to, Reply::Refused(why)) = sent(&mut ring) else { panic!("it wasn't refused") };
    assert!(to == 3 && why.contains(&format!("protocol {PROTOCOL_VERSION}")), "{why}");
}
