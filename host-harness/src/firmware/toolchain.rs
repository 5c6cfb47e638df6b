//! Finds a compiler for the boards: one with the target's core library, or one with that library's sources.

use std::env;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::workspace;
use crate::error::Error;

/// The target of both RISC-V boards.
pub const RISCV_TARGET: &str = "riscv32imc-unknown-none-elf";

/// Where Debian puts rustc, whose package for library sources rustup may not have.
const SYSTEM_RUSTC: &str = "/usr/bin/rustc";

/// Debian's packages that hold a compiler with the sources of its library, and its linter.
pub const DEBIAN_COMPILER: [&str; 3] = ["rustc-web", "rust-web-src", "rust-web-clippy"];

/// A rustc and what lies beside it.
#[derive(Clone, Debug)]
pub struct Compiler {
    /// The program.
    pub rustc: PathBuf,
    /// As rustc says it, `1.96.0`.
    pub release: String,
    /// LLVM's release, as rustc says it: `22.1.8`; empty for other code generators.
    pub llvm: String,
    host: String,
    sysroot: PathBuf,
}

/// How to compile for [`RISCV_TARGET`].
#[derive(Clone, Debug)]
pub enum Toolchain {
    /// Core comes compiled, as after `rustup target add`.
    Prebuilt(Compiler),
    /// Core is compiled from its sources along with the firmware.
    BuildStd {
        /// The compiler that the sources belong to.
        compiler: Compiler,
        /// An LLD: Debian's rustc brings none for bare metal.
        linker: PathBuf,
    },
}

impl Compiler {
    /// Asks a rustc who it is; none if it isn't there or is too old for this workspace.
    fn probe(rustc: &Path) -> Option<Self> {
        let version = answer(rustc, "-vV")?;
        let field = |name: &str| version.lines().find_map(|line| line.strip_prefix(name)).map(str::to_owned);
        let compiler = Self {
            rustc: rustc.to_owned(),
            release: field("release: ")?,
            llvm: field("LLVM version: ").unwrap_or_default(),
            host: field("host: ")?,
            sysroot: answer(rustc, "--print=sysroot")?.trim().into(),
        };
        (minor_version(&compiler.release)? >= minor_version(env!("CARGO_PKG_RUST_VERSION"))?).then_some(compiler)
    }

    /// The compilers worth asking, the user's own choice first.
    fn candidates() -> impl Iterator<Item = Self> {
        let chosen = env::var_os("RUSTC").map_or_else(|| "rustc".into(), PathBuf::from);
        [chosen, SYSTEM_RUSTC.into()].into_iter().filter_map(|rustc| Self::probe(&rustc))
    }

    /// A compiler that has the sources of its library, and those sources, if there is one.
    pub fn with_library_source() -> Option<(Self, PathBuf)> {
        Self::candidates().find_map(|compiler| compiler.library_source().map(|library| (compiler, library)))
    }

    fn library_source(&self) -> Option<PathBuf> {
        let library = self.sysroot.join("lib/rustlib/src/rust/library");
        library.join("core/src/lib.rs").is_file().then_some(library)
    }

    fn has_target(&self, target: &str) -> bool {
        self.sysroot.join("lib/rustlib").join(target).join("lib").is_dir()
    }

    /// The LLD that rustup's toolchains bring.
    fn bundled_linker(&self) -> Option<PathBuf> {
        let linker = self.sysroot.join("lib/rustlib").join(&self.host).join("bin/rust-lld");
        linker.is_file().then_some(linker)
    }

    /// Makes a cargo call use this compiler and let it use what only nightly may, such as `-Zbuild-std`.
    pub fn lend_to(&self, cargo: &mut Command) {
        cargo.env("RUSTC", &self.rustc).env("RUSTC_BOOTSTRAP", "1");
    }
}

impl Toolchain {
    /// Looks for a toolchain.
    ///
    /// # Errors
    /// If there is none; the error says exactly what to install.
    pub fn find() -> Result<Self, Error> {
        let candidates: Vec<_> = Compiler::candidates().collect();
        if let Some(compiler) = candidates.iter().find(|compiler| compiler.has_target(RISCV_TARGET)) {
            return Ok(Self::Prebuilt(compiler.clone()));
        }
        let Some(compiler) = candidates.iter().find(|compiler| compiler.library_source().is_some()) else {
            return Err(Error::target(
                format!("no compiler for {RISCV_TARGET}"),
                format!(
                    "`cargo verify`, which installs it where it may, `rustup target add {RISCV_TARGET}`, or on Debian \
                     `apt install {}`",
                    DEBIAN_COMPILER.join(" ")
                ),
            ));
        };
        let linker = candidates.iter().find_map(Compiler::bundled_linker).or_else(installed_lld);
        let Some(linker) = linker else {
            return Err(Error::target(
                format!("{} has no linker for {RISCV_TARGET}", compiler.rustc.display()),
                "`apt install lld`, or use a rustup toolchain, which brings rust-lld",
            ));
        };
        Ok(Self::BuildStd { compiler: compiler.clone(), linker })
    }

    /// A call of a cargo subcommand for [`RISCV_TARGET`], with a target directory apart from the host's.
    ///
    /// # Errors
    /// If the workspace is gone.
    pub fn cargo(&self, subcommand: &str) -> Result<Command, Error> {
        let mut command = workspace::cargo()?;
        command.arg(subcommand);
        self.apply(&mut command)?;
        Ok(command)
    }

    /// A call of clippy for [`RISCV_TARGET`]. Its driver must be of the compiler's own release.
    ///
    /// # Errors
    /// If the compiler has no clippy beside it.
    pub fn clippy(&self) -> Result<Command, Error> {
        let Self::BuildStd { compiler, .. } = self else {
            return self.cargo("clippy");
        };
        let clippy = compiler.sysroot.join("bin/cargo-clippy");
        if !clippy.is_file() {
            let [.., package] = DEBIAN_COMPILER;
            return Err(Error::target(
                format!("rustc {} has no clippy at {}", compiler.release, clippy.display()),
                format!("apt install {package}"),
            ));
        }
        let mut command = Command::new(clippy);
        command.current_dir(workspace::root()?).env("CARGO", workspace::cargo_program()).arg("clippy");
        workspace::clear_cargo_run(&mut command);
        self.apply(&mut command)?;
        Ok(command)
    }

    fn apply(&self, command: &mut Command) -> Result<(), Error> {
        command.args(["--target", RISCV_TARGET, "--target-dir"]).arg(workspace::target_dir()?.join("firmware"));
        // Flags that somebody set for the host would replace what the firmware needs.
        command.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
        match self {
            Self::Prebuilt(compiler) => {
                command.env("RUSTC", &compiler.rustc);
            }
            Self::BuildStd { compiler, linker } => {
                compiler.lend_to(command);
                let variable = format!("CARGO_TARGET_{}_LINKER", RISCV_TARGET.to_uppercase().replace('-', "_"));
                command.arg("-Zbuild-std=core,alloc").env(variable, linker);
            }
        }
        Ok(())
    }

    /// The compiler's release, `1.96.0`.
    pub fn release(&self) -> &str {
        match self {
            Self::Prebuilt(compiler) | Self::BuildStd { compiler, .. } => &compiler.release,
        }
    }

    /// What it is, in a line.
    pub fn describe(&self) -> String {
        match self {
            Self::Prebuilt(compiler) => format!("rustc {} with {RISCV_TARGET}", compiler.release),
            Self::BuildStd { compiler, .. } => {
                format!("rustc {} at {}, core from its sources", compiler.release, compiler.rustc.display())
            }
        }
    }
}

/// Looks for a program on the path.
pub fn installed(program: impl AsRef<OsStr>) -> Option<PathBuf> {
    let name = Path::new(program.as_ref());
    let path = env::var_os("PATH")?;
    env::split_paths(&path).map(|dir| dir.join(name).with_extension(env::consts::EXE_EXTENSION)).find(|at| at.is_file())
}

/// An LLD by any name that Debian, Fedora or Homebrew gives it.
fn installed_lld() -> Option<PathBuf> {
    ["rust-lld", "ld.lld", "ld.lld-22", "ld.lld-19", "ld.lld-16"].into_iter().find_map(installed)
}

fn answer(program: &Path, argument: &str) -> Option<String> {
    let output = Command::new(program).arg(argument).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The `95` of `1.95.0`.
fn minor_version(release: &str) -> Option<u32> {
    release.strip_prefix("1.")?.split('.').next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_compare_as_numbers() {
        assert_eq!(minor_version("1.95"), Some(95));
        assert!(minor_version("1.100.0-nightly") > minor_version("1.95.0"));
        assert_eq!(minor_version("2.0.0"), None);
    }
}
