# Where the processor starts, and calls of the simulator: number in a2, arguments from a3 on, as upstream's assembler for
# Xtensa isn't open to Rust.

    .section .text.start, "ax"
    .global start
start:
    # The stack's end, 127 MB up in RAM.
    movi a1, 0x67f
    slli a1, a1, 20
    call0 run

    # fn simulator_exit(code: u32) -> !
    .global simulator_exit
simulator_exit:
    mov a3, a2
    movi a2, 1
    simcall
forever:
    j forever

    # fn simulator_read(file: u32, buffer: *mut u8, length: usize) -> isize
    .global simulator_read
simulator_read:
    mov a5, a4
    mov a4, a3
    mov a3, a2
    movi a2, 3
    simcall
    ret

    # fn simulator_write(file: u32, bytes: *const u8, length: usize) -> isize
    .global simulator_write
simulator_write:
    mov a5, a4
    mov a4, a3
    mov a3, a2
    movi a2, 4
    simcall
    ret

    # What the compiler calls where it can't go on.
    .global abort
abort:
    movi a2, 254
    j simulator_exit
