#!/usr/bin/env bash
# From a fresh machine with rustup to an ESP32 that runs flat: installs Espressif's compiler for Xtensa and espflash where they
# are missing, builds the firmware, flashes it, and shows what the board says. Arguments go to `cargo rig flash esp32`:
#
#   firmware/esp32.sh --port /dev/ttyUSB0
#   firmware/esp32.sh --second-core
#   firmware/esp32.sh --save flash.bin      # no board: what its flash would hold
set -euo pipefail
cd "$(dirname "$0")/.."

# Where espup writes the paths of Xtensa's gcc, which links; espup itself reads this variable.
export ESPUP_EXPORT_FILE="${ESPUP_EXPORT_FILE:-$HOME/export-esp.sh}"

has() {
    command -v "$1" >/dev/null
}

if ! has rustup; then
    echo "rustup is missing: https://rustup.rs says how to install it" >&2
    exit 1
fi
if ! rustup run esp rustc --version >/dev/null 2>&1; then
    has espup || cargo install espup --locked
    espup install --targets esp32
fi
if [ -f "$ESPUP_EXPORT_FILE" ]; then
    # shellcheck source=/dev/null  # espup's, on this machine alone
    . "$ESPUP_EXPORT_FILE"
fi
if ! has xtensa-esp32-elf-gcc; then
    echo "xtensa-esp32-elf-gcc is not on the path: set ESPUP_EXPORT_FILE to the file that \`espup install\` wrote" >&2
    exit 1
fi
has espflash || cargo install espflash --locked

case " $* " in
    *" --save "* | *" --print "*) exec cargo rig flash esp32 "$@" ;;
    *) exec cargo rig flash esp32 --monitor "$@" ;;
esac
