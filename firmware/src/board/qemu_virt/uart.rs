//! The 16550 serial port, interrupt-driven through the PLIC.
//!
//! There is no buffer besides the port's own 16 bytes: QEMU holds further bytes back until there is room, and nothing is
//! lost however long a step takes.

use core::convert::Infallible;
use core::future::poll_fn;
use core::task::Poll;

use embassy_sync::waitqueue::AtomicWaker;
use embedded_io_async::{ErrorType, Read, Write};
use riscv::interrupt::Interrupt;
use riscv::register::mie;

use super::register::Register;

// SAFETY: the `virt` machine's 16550 at 0x1000_0000, byte registers. The first two hold the divisor while LCR says so.
const DATA: Register<u8> = unsafe { Register::at(0x1000_0000) };
// SAFETY: as above.
const INTERRUPT_ENABLE: Register<u8> = unsafe { Register::at(0x1000_0001) };
// SAFETY: as above.
const FIFO_CONTROL: Register<u8> = unsafe { Register::at(0x1000_0002) };
// SAFETY: as above.
const LINE_CONTROL: Register<u8> = unsafe { Register::at(0x1000_0003) };
// SAFETY: as above.
const LINE_STATUS: Register<u8> = unsafe { Register::at(0x1000_0005) };

/// The PLIC's line for the port.
const IRQ: usize = 10;
// SAFETY: the `virt` machine's PLIC: priority of the line, enable bits of lines 0..32 for hart 0 in machine mode,
// that context's threshold, and its claim register.
const PLIC_PRIORITY: Register<u32> = unsafe { Register::at(0x0C00_0000 + 4 * IRQ) };
// SAFETY: as above.
const PLIC_ENABLE: Register<u32> = unsafe { Register::at(0x0C00_2000) };
// SAFETY: as above.
const PLIC_THRESHOLD: Register<u32> = unsafe { Register::at(0x0C20_0000) };
// SAFETY: as above.
const PLIC_CLAIM: Register<u32> = unsafe { Register::at(0x0C20_0004) };

/// Interrupt enable: data received.
const RECEIVED: u8 = 1 << 0;
/// Interrupt enable: transmit FIFO empty.
const SENT: u8 = 1 << 1;
/// Line status: data to read.
const DATA_READY: u8 = 1 << 0;
/// Line status: transmit FIFO empty.
const FIFO_EMPTY: u8 = 1 << 5;
/// Line status: the last bit has left.
const IDLE: u8 = 1 << 6;

/// Bytes that fit into the empty transmit FIFO.
const FIFO: usize = 16;

static RECEIVER: AtomicWaker = AtomicWaker::new();
static TRANSMITTER: AtomicWaker = AtomicWaker::new();

/// Serial in.
pub(crate) struct Receiver(());

/// Serial out.
pub(crate) struct Transmitter(());

/// Sets the port up. What came in before is lost.
pub(super) fn open() -> (Receiver, Transmitter) {
    // The rate matters to nobody but the receive FIFO, which hands over less than its trigger level only after the time
    // of four bytes: take the shortest.
    const DIVISOR_ACCESS: u8 = 1 << 7;
    const EIGHT_BITS: u8 = 0b11;
    LINE_CONTROL.write(DIVISOR_ACCESS | EIGHT_BITS);
    DATA.write(1);
    INTERRUPT_ENABLE.write(0);
    LINE_CONTROL.write(EIGHT_BITS);
    // On, both cleared, interrupt at 14 bytes.
    FIFO_CONTROL.write(0b1100_0111);

    PLIC_PRIORITY.write(1);
    PLIC_ENABLE.write(1 << IRQ);
    PLIC_THRESHOLD.write(0);
    // SAFETY: the handler below is linked in.
    unsafe { mie::set_mext() };
    (Receiver(()), Transmitter(()))
}

impl ErrorType for Receiver {
    type Error = Infallible;
}

impl ErrorType for Transmitter {
    type Error = Infallible;
}

impl Read for Receiver {
    async fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Infallible> {
        if bytes.is_empty() {
            return Ok(0);
        }
        poll_fn(|context| {
            let mut count = 0;
            while count < bytes.len() && LINE_STATUS.read() & DATA_READY != 0 {
                bytes[count] = DATA.read();
                count += 1;
            }
            if count > 0 {
                return Poll::Ready(Ok(count));
            }
            RECEIVER.register(context.waker());
            listen(RECEIVED);
            Poll::Pending
        })
        .await
    }
}

impl Write for Transmitter {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        poll_fn(|context| {
            if LINE_STATUS.read() & FIFO_EMPTY == 0 {
                TRANSMITTER.register(context.waker());
                listen(SENT);
                return Poll::Pending;
            }
            let count = bytes.len().min(FIFO);
            for &byte in &bytes[..count] {
                DATA.write(byte);
            }
            Poll::Ready(Ok(count))
        })
        .await
    }

    async fn flush(&mut self) -> Result<(), Infallible> {
        poll_fn(|context| {
            if LINE_STATUS.read() & IDLE != 0 {
                return Poll::Ready(Ok(()));
            }
            TRANSMITTER.register(context.waker());
            listen(SENT);
            Poll::Pending
        })
        .await
    }
}

/// Sends without interrupts, for a device that is about to restart. This port takes everything, so true.
pub(crate) fn send_blocking(bytes: &[u8]) -> bool {
    for &byte in bytes {
        while LINE_STATUS.read() & FIFO_EMPTY == 0 {}
        DATA.write(byte);
    }
    while LINE_STATUS.read() & IDLE == 0 {}
    true
}

/// Asks for one interrupt from this source. It comes at once where the condition holds already.
fn listen(source: u8) {
    critical_section::with(|_| INTERRUPT_ENABLE.write(INTERRUPT_ENABLE.read() | source));
}

#[riscv_rt::core_interrupt(Interrupt::MachineExternal)]
fn on_interrupt() {
    let irq = PLIC_CLAIM.read();
    let enabled = INTERRUPT_ENABLE.read();
    let status = LINE_STATUS.read();
    // A source that has fired is silent until somebody waits for it again.
    let received = status & DATA_READY != 0 && enabled & RECEIVED != 0;
    let sent = status & FIFO_EMPTY != 0 && enabled & SENT != 0;
    INTERRUPT_ENABLE.write(enabled & !(if received { RECEIVED } else { 0 } | if sent { SENT } else { 0 }));
    if received {
        RECEIVER.wake();
    }
    if sent {
        TRANSMITTER.wake();
    }
    PLIC_CLAIM.write(irq);
}
