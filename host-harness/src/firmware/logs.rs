//! Log messages out of a stream in defmt's encoding, with the image that wrote it as the key.

use defmt_decoder::{DecodeError, Encoding, Locations, Table};

use super::symbols::shortened;

/// Ends a message: no other byte of rzCOBS is zero.
const END: u8 = 0;

/// Reads one image's logs.
pub struct Logs {
    table: Table,
    locations: Locations,
    /// The beginning of a message whose end hasn't come.
    begun: Vec<u8>,
}

/// A message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// By the device's clock, as the device formats it; empty if it doesn't say.
    pub time: String,
    /// `ERROR` to `TRACE`; empty for plain text.
    pub level: &'static str,
    /// The text.
    pub text: String,
    /// File and line, if the image knows them.
    pub place: Option<String>,
}

/// What a part of the stream held.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Read {
    /// Messages, in their order.
    pub messages: Vec<Message>,
    /// Messages that this image didn't write, or that lost bytes on the way.
    pub unreadable: u32,
}

impl Logs {
    /// Takes the key out of an image.
    ///
    /// # Errors
    /// If it has none; in words.
    pub fn new(elf: &[u8]) -> Result<Self, String> {
        let table =
            Table::parse(elf).map_err(|error| error.to_string())?.ok_or("it logs nothing: it has no .defmt section")?;
        if table.encoding() != Encoding::Rzcobs {
            return Err("its logs are not in the encoding rzcobs".into());
        }
        // Without places the messages are still worth reading.
        let locations = table.get_locations(elf).unwrap_or_default();
        Ok(Self { table, locations, begun: Vec::new() })
    }

    /// Reads on.
    pub fn read(&mut self, bytes: &[u8]) -> Read {
        self.begun.extend_from_slice(bytes);
        let Some(last) = self.begun.iter().rposition(|&byte| byte == END) else { return Read::default() };
        let rest = self.begun.split_off(last + 1);
        let mut read = Read::default();
        let mut decoder = self.table.new_stream_decoder();
        decoder.received(&self.begun);
        loop {
            match decoder.decode() {
                Ok(frame) => read.messages.push(Message {
                    time: frame.display_timestamp().map(|time| time.to_string()).unwrap_or_default(),
                    level: frame.level().map_or("", |level| match level.as_str() {
                        "error" => "ERROR",
                        "warn" => "WARN",
                        "info" => "INFO",
                        "debug" => "DEBUG",
                        _ => "TRACE",
                    }),
                    text: frame.display_message().to_string(),
                    place: self
                        .locations
                        .get(&frame.index())
                        .map(|place| format!("{}:{}", shortened(&place.file.to_string_lossy()), place.line)),
                }),
                Err(DecodeError::Malformed) => read.unreadable += 1,
                Err(DecodeError::UnexpectedEof) => break,
            }
        }
        drop(decoder);
        self.begun = rest;
        read
    }

    /// Forgets the message under way: bytes are missing, or the device has started anew.
    pub fn skip(&mut self) {
        self.begun.clear();
    }
}

#[cfg(test)]
mod tests {
    use object::write::{Object, Symbol, SymbolSection};
    use object::{Architecture, BinaryFormat, Endianness, SectionKind, SymbolFlags, SymbolKind, SymbolScope};

    use super::*;

    /// What a board sent when it started, byte by byte, 632 us after its reset.
    const RECORDED: &[u8] = b"\x00\x01x\x02r\x09wqemu_virt\x15\x83cf069\x0383f4202beb1-bare\x89\x00";

    /// The names in its image's section `.defmt`, at the addresses that the messages begin with.
    const SYMBOLS: [(u64, &str); 4] = [
        (
            1,
            r#"{"package":"flat-firmware","tag":"defmt_info","data":"{=str} of build {=str} starts","disambiguator":"7056717482068466670","crate_name":"flat_firmware"}"#,
        ),
        (
            8,
            r#"{"package":"flat-firmware","tag":"defmt_timestamp","data":"{=u64:us}","disambiguator":"17781554971448871577","crate_name":"flat_firmware"}"#,
        ),
        (9, "_defmt_encoding_ = rzcobs"),
        (10, "_defmt_version_ = 4"),
    ];

    fn image(symbols: &[(u64, &str)]) -> Vec<u8> {
        let mut image = Object::new(BinaryFormat::Elf, Architecture::Riscv32, Endianness::Little);
        for &(value, name) in symbols {
            let section = image.add_section(Vec::new(), b".defmt".to_vec(), SectionKind::Metadata);
            image.add_symbol(Symbol {
                name: name.into(),
                value,
                size: 1,
                kind: SymbolKind::Data,
                scope: SymbolScope::Dynamic,
                weak: false,
                section: SymbolSection::Section(section),
                flags: SymbolFlags::None,
            });
        }
        image.write().unwrap()
    }

    fn logs() -> Logs {
        Logs::new(&image(&SYMBOLS)).unwrap()
    }

    fn message() -> Message {
        Message {
            time: "0.000632".into(),
            level: "INFO",
            text: "qemu_virt of build cf06983f4202beb1-bare starts".into(),
            place: None,
        }
    }

    #[test]
    fn a_recorded_message_reads_as_it_was_written() {
        assert_eq!(logs().read(RECORDED), Read { messages: vec![message()], unreadable: 0 });
    }

    #[test]
    fn a_message_may_be_cut_anywhere() {
        for cut in 1..RECORDED.len() {
            let mut logs = logs();
            let (begin, end) = RECORDED.split_at(cut);
            let (first, second) = (logs.read(begin), logs.read(end));
            assert_eq!([first.messages, second.messages].concat(), [message()], "cut at {cut}");
            assert_eq!(first.unreadable + second.unreadable, 0, "cut at {cut}");
        }
    }

    #[test]
    fn a_message_that_lost_bytes_is_counted_and_the_next_one_read() {
        let (lost, whole) = (&RECORDED[20..], RECORDED);
        let read = logs().read(&[lost, whole].concat());
        assert_eq!((read.messages, read.unreadable), (vec![message()], 1));
    }

    #[test]
    fn after_a_restart_the_message_under_way_is_forgotten() {
        let mut logs = logs();
        logs.read(&RECORDED[..20]);
        logs.skip();
        assert_eq!(logs.read(RECORDED), Read { messages: vec![message()], unreadable: 0 });
    }

    #[test]
    fn an_image_without_a_key_is_told_from_one_with_another() {
        let why = |symbols: &[(u64, &str)]| Logs::new(&image(symbols)).err().unwrap();
        assert!(why(&[]).contains("logs nothing"), "{}", why(&[]));
        let raw = [(9, "_defmt_encoding_ = raw"), (10, "_defmt_version_ = 4")];
        assert!(why(&raw).contains("rzcobs"), "{}", why(&raw));
    }
}
