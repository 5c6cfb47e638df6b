//! What all Espressif boards share: UART0 as the link, an executor for physics above the link's, the way to fail.

use embassy_executor::SendSpawner;
use esp_hal::Async;
use esp_hal::gpio::interconnect::{PeripheralInput, PeripheralOutput};
use esp_hal::interrupt::Priority;
use esp_hal::peripherals::{FROM_CPU_INTR1, UART0};
use esp_hal::uart::{Config, RxConfig, Uart, UartRx, UartTx};
use esp_rtos::embassy::InterruptExecutor;
use static_cell::StaticCell;

// Pulls in the panic handler.
use esp_backtrace as _;

/// Serial in.
pub(crate) type Receiver = UartRx<'static, Async>;
/// Serial out.
pub(crate) type Transmitter = UartTx<'static, Async>;

// Tells the boot loader and espflash what this image is.
esp_bootloader_esp_idf::esp_app_desc!();

/// Bytes in the 128-byte receive FIFO that wake the receiver, or the time of so many without another: the rest of the
/// FIFO, 0.7 ms, is what a step may take before a host that floods the link loses bytes.
const WAKE_AT: u16 = 64;
const WAKE_AFTER: u8 = 2;

/// Opens UART0 on the pins that the board's USB bridge is wired to.
pub(super) fn open(
    uart: UART0<'static>,
    rx: impl PeripheralInput<'static>,
    tx: impl PeripheralOutput<'static>,
) -> (Receiver, Transmitter) {
    let config = Config::default()
        .with_baudrate(flat_wire::BAUD)
        .with_rx(RxConfig::default().with_fifo_full_threshold(WAKE_AT).with_timeout(WAKE_AFTER));
    let uart = Uart::new(uart, config).expect("rate and thresholds within the chip's range");
    uart.with_rx(rx).with_tx(tx).into_async().split()
}

/// Starts the executor for physics: it interrupts the one that serves the link.
pub(super) fn physics_executor(interrupt: FROM_CPU_INTR1<'static>) -> SendSpawner {
    static EXECUTOR: StaticCell<InterruptExecutor<1>> = StaticCell::new();
    EXECUTOR.init(InterruptExecutor::new(interrupt)).start(Priority::Priority3)
}

/// Frame delimiter: what a failing device prints goes between two of them, and spoils no frame.
const DELIMITER: [u8; 1] = [0];

/// Called by esp-backtrace before it prints the reason of a panic on UART0, in plain text.
#[unsafe(no_mangle)]
extern "Rust" fn custom_pre_backtrace() {
    esp_println::Printer::write_bytes(&DELIMITER);
}

/// Called by esp-backtrace after it has printed. The device stays as it is, for a debugger or a reset.
#[unsafe(no_mangle)]
extern "Rust" fn custom_halt() -> ! {
    esp_println::Printer::write_bytes(&DELIMITER);
    loop {
        core::hint::spin_loop();
    }
}
