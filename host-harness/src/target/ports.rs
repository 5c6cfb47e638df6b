//! Serial ports, and which of them have a board behind them.

use serialport::{SerialPortInfo, SerialPortType, UsbPortInfo};

use crate::error::Error;

/// USB vendor and product numbers of the chips that boards put between USB and the serial line, by "USB ID Repository" and the
/// makers' data sheets; 0 = any product. The first is Espressif's chips themselves.
const BRIDGES: [(u16, u16, &str); 12] = [
    (0x303a, 0x1001, "Espressif USB-Serial-JTAG"),
    (0x303a, 0, "Espressif"),
    (0x10c4, 0xea60, "Silicon Labs CP210x"),
    (0x10c4, 0xea70, "Silicon Labs CP2105"),
    (0x1a86, 0x7523, "WCH CH340"),
    (0x1a86, 0x55d3, "WCH CH343"),
    (0x1a86, 0x55d4, "WCH CH9102"),
    (0x1a86, 0, "WCH"),
    (0x0403, 0x6001, "FTDI FT232R"),
    (0x0403, 0x6010, "FTDI FT2232"),
    (0x0403, 0x6015, "FTDI FT-X"),
    (0x067b, 0x2303, "Prolific PL2303"),
];

/// Prints the serial ports, boards first.
///
/// # Errors
/// If there is none, or the system doesn't tell.
pub fn print() -> Result<(), Error> {
    let mut ports = list()?;
    if ports.is_empty() {
        return Err(Error::target("no serial port is there", PLUG_IN));
    }
    ports.sort_by_key(|port| bridge(port).is_none());
    for port in &ports {
        println!("{}", describe(port));
    }
    Ok(())
}

/// The port of the one board that is plugged in, and what stands behind it in words.
///
/// # Errors
/// If there is none, or more than one; the error lists what is there.
pub fn find() -> Result<(String, String), Error> {
    choose(&list()?)
}

/// All ports, in a line, for advice.
pub fn names() -> String {
    list().unwrap_or_default().into_iter().map(|port| port.port_name).collect::<Vec<_>>().join(", ")
}

const PLUG_IN: &str =
    "plug the board in, with a cable that carries data; on Linux `dmesg | tail` says whether it was noticed";

fn choose(ports: &[SerialPortInfo]) -> Result<(String, String), Error> {
    let boards: Vec<_> = ports.iter().filter(|port| bridge(port).is_some()).collect();
    match boards[..] {
        [board] => Ok((board.port_name.clone(), describe(board))),
        [] if ports.is_empty() => Err(Error::target("no board is plugged in: there is no serial port", PLUG_IN)),
        [] => Err(Error::target(
            format!("no board is plugged in: none of these ports has a known USB bridge{}", listed(ports)),
            "name the port, as in serial:/dev/ttyUSB0",
        )),
        [first, ..] => Err(Error::target(
            format!("{} boards are plugged in{}", boards.len(), listed(boards.iter().copied())),
            format!("name one, as in serial:{}", first.port_name),
        )),
    }
}

fn listed<'a>(ports: impl IntoIterator<Item = &'a SerialPortInfo>) -> String {
    ports.into_iter().flat_map(|port| ["\n  ".to_owned(), describe(port)]).collect()
}

fn list() -> Result<Vec<SerialPortInfo>, Error> {
    let mut ports = serialport::available_ports()
        .map_err(|error| Error::target(format!("the system doesn't list its serial ports: {error}"), ""))?;
    // macOS shows each port twice; its /dev/tty half waits for a modem's carrier.
    ports.retain(|port| !port.port_name.starts_with("/dev/tty."));
    ports.sort_by(|a, b| a.port_name.cmp(&b.port_name));
    Ok(ports)
}

/// What stands between USB and the chip, if it is something that boards have.
fn bridge(port: &SerialPortInfo) -> Option<&'static str> {
    let SerialPortType::UsbPort(UsbPortInfo { vid, pid, .. }) = &port.port_type else { return None };
    BRIDGES.iter().find(|(vendor, product, _)| vendor == vid && (product == pid || *product == 0)).map(|known| known.2)
}

fn describe(port: &SerialPortInfo) -> String {
    let kind = match &port.port_type {
        SerialPortType::UsbPort(UsbPortInfo { vid, pid, serial_number, product, .. }) => {
            let name = bridge(port).or(product.as_deref()).unwrap_or("USB device");
            let number = serial_number.as_ref().map(|number| format!(", serial number {number}")).unwrap_or_default();
            format!("{name} ({vid:04x}:{pid:04x}{number})")
        }
        SerialPortType::PciPort => "built in".into(),
        SerialPortType::BluetoothPort => "Bluetooth".into(),
        SerialPortType::Unknown => "unknown".into(),
    };
    format!("{:<16} {kind}", port.port_name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn usb(name: &str, vid: u16, pid: u16) -> SerialPortInfo {
        let usb = UsbPortInfo { vid, pid, serial_number: Some("A1".into()), manufacturer: None, product: None };
        SerialPortInfo { port_name: name.into(), port_type: SerialPortType::UsbPort(usb) }
    }

    fn built_in() -> SerialPortInfo {
        SerialPortInfo { port_name: "/dev/ttyS0".into(), port_type: SerialPortType::PciPort }
    }

    #[test]
    fn the_one_board_is_found_among_other_ports() {
        let (port, text) =
            choose(&[built_in(), usb("/dev/ttyUSB0", 0x10c4, 0xea60), usb("/dev/ttyACM3", 0x046d, 0xc52b)]).unwrap();
        assert_eq!(port, "/dev/ttyUSB0");
        assert_eq!(text, "/dev/ttyUSB0     Silicon Labs CP210x (10c4:ea60, serial number A1)");
    }

    #[test]
    fn a_chip_with_usb_of_its_own_is_a_board() {
        assert_eq!(choose(&[usb("COM7", 0x303a, 0x1001)]).unwrap().0, "COM7");
    }

    #[test]
    fn no_board_and_two_boards_are_refused_with_what_is_there() {
        let error = choose(&[built_in()]).unwrap_err();
        assert!(error.what().contains("/dev/ttyS0"), "{error}");
        let error = choose(&[usb("COM3", 0x1a86, 0x55d3), usb("COM4", 0x0403, 0x6001)]).unwrap_err();
        for word in ["2 boards", "COM3", "WCH CH343", "COM4", "serial:COM3"] {
            assert!(error.to_string().contains(word), "{error}");
        }
        assert!(choose(&[]).is_err());
    }
}
