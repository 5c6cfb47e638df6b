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
