//! UART0 as the link, on the pins that boards wire to their USB bridge.

use embassy_time::{Duration, Instant};
use esp_hal::Async;
use esp_hal::gpio::interconnect::{PeripheralInput, PeripheralOutput};
use esp_hal::peripherals::UART0;
use esp_hal::uart::{Config, RxConfig, Uart, UartRx, UartTx};

/// Serial in.
pub(crate) type Receiver = UartRx<'static, Async>;
/// Serial out.
pub(crate) type Transmitter = UartTx<'static, Async>;

/// Baud: `FLAT_BAUD` where the build sets it, else what rig expects.
const BAUD: u32 = match option_env!("FLAT_BAUD") {
    None => flat_wire::BAUD,
    Some(text) => match u32::from_str_radix(text, 10) {
        Ok(baud) if baud >= 9_600 && baud <= 5_000_000 => baud,
        _ => panic!("FLAT_BAUD must be a number of baud, 9600 to 5000000"),
    },
};

/// Bytes in the 128-byte receive FIFO that wake the receiver, or the time of so many without another: the rest of the
/// FIFO, 0.7 ms at 921 600 baud, is what a step may take before a host that floods the link loses bytes.
const WAKE_AT: u16 = 64;
const WAKE_AFTER: u8 = 2;

/// Bytes in the transmit FIFO.
const FIFO: u32 = 128;
/// Longest wait for room in it, many times that of its slowest rate.
const PATIENCE: Duration = Duration::from_millis(500);

/// Opens the port.
pub(crate) fn open(
    uart: UART0<'static>,
    rx: impl PeripheralInput<'static>,
    tx: impl PeripheralOutput<'static>,
) -> (Receiver, Transmitter) {
    let rx_config = RxConfig::default().with_fifo_full_threshold(WAKE_AT).with_timeout(WAKE_AFTER);
    let config = Config::default().with_baudrate(BAUD).with_rx(rx_config);
    let uart = Uart::new(uart, config).expect("rate and thresholds within the chip's range");
    uart.with_rx(rx).with_tx(tx).into_async().split()
}

/// Sends without interrupts, for a device that is about to restart, and waits until the last bit has left. False if the port
/// doesn't take it.
pub(crate) fn send_blocking(bytes: &[u8]) -> bool {
    let status = || UART0::regs().status().read();
    let taken = bytes.iter().all(|&byte| {
        let has_room = wait_until(|| u32::from(status().txfifo_cnt().bits()) < FIFO);
        if has_room {
            // SAFETY: every byte may be sent.
            UART0::regs().fifo().write(|fifo| unsafe { fifo.rxfifo_rd_byte().bits(byte) });
        }
        has_room
    });
    // Nothing in the FIFO, and the transmitter at rest.
    taken && wait_until(|| status().txfifo_cnt().bits() == 0) && wait_until(is_idle)
}

/// Whether the transmitter's state machine is at rest.
fn is_idle() -> bool {
    cfg_select! {
        feature = "esp32" => UART0::regs().status().read().st_utx_out().bits() == 0,
        _ => UART0::regs().fsm_status().read().st_utx_out().bits() == 0,
    }
}

/// False if it takes too long.
fn wait_until(holds: impl Fn() -> bool) -> bool {
    let deadline = Instant::now() + PATIENCE;
    loop {
        if holds() {
            return true;
        }
        if Instant::now() > deadline {
            return false;
        }
    }
}
