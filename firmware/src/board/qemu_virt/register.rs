//! Device registers.

use core::ptr;

/// One memory-mapped register of type `T`.
pub(super) struct Register<T>(usize, core::marker::PhantomData<T>);

impl<T: Copy> Register<T> {
    /// The register at this address.
    ///
    /// # Safety
    ///
    /// On this machine the address must belong to a device register of just this width, and reading or writing it must
    /// not touch memory that Rust owns.
    pub(super) const unsafe fn at(address: usize) -> Self {
        Self(address, core::marker::PhantomData)
    }

    /// Reads, with the device's side effects.
    pub(super) fn read(&self) -> T {
        // SAFETY: `at` was promised that the address is a register of this type.
        unsafe { ptr::read_volatile(ptr::with_exposed_provenance(self.0)) }
    }

    /// Writes, with the device's side effects.
    pub(super) fn write(&self, value: T) {
        // SAFETY: `at` was promised that the address is a register of this type, and no part of Rust's memory.
        unsafe { ptr::write_volatile(ptr::with_exposed_provenance_mut(self.0), value) }
    }
}
