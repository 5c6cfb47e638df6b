//! The chip's own USB port as the link: no bridge, no baud rate, and the host can reset the chip through it.

use embassy_time::{Duration, Instant};
use esp_hal::Async;
use esp_hal::peripherals::USB_DEVICE;
use esp_hal::usb::usb_serial_jtag::{UsbSerialJtag, UsbSerialJtagRx, UsbSerialJtagTx};

/// Serial in.
pub(crate) type Receiver = UsbSerialJtagRx<'static, Async>;
/// Serial out. Without a host that reads, it waits for ever, and the outbox fills.
pub(crate) type Transmitter = UsbSerialJtagTx<'static, Async>;

/// Bytes in a packet.
const PACKET: usize = 64;
/// Longest wait for the host to fetch one: it asks every millisecond, if it is there.
const PATIENCE: Duration = Duration::from_millis(50);

/// Opens the port.
pub(crate) fn open(usb: USB_DEVICE<'static>) -> (Receiver, Transmitter) {
    UsbSerialJtag::new(usb).into_async().split()
}

/// Sends without interrupts, for a device that is about to restart. False if no host fetches it.
pub(crate) fn send_blocking(bytes: &[u8]) -> bool {
    let usb = USB_DEVICE::regs();
    let is_free = || usb.ep1_conf().read().serial_in_ep_data_free().bit_is_set();
    // Sends what a task had begun to write.
    usb.ep1_conf().modify(|_, conf| conf.wr_done().set_bit());
    bytes.chunks(PACKET).all(|packet| {
        let deadline = Instant::now() + PATIENCE;
        while !is_free() {
            if Instant::now() > deadline {
                return false;
            }
        }
        for &byte in packet {
            // SAFETY: every byte may be sent.
            usb.ep1().write(|fifo| unsafe { fifo.rdwr_byte().bits(byte) });
        }
        usb.ep1_conf().modify(|_, conf| conf.wr_done().set_bit());
        true
    }) && {
        // Until the host has fetched the last one.
        let deadline = Instant::now() + PATIENCE;
        while !is_free() && Instant::now() < deadline {}
        is_free()
    }
}
