//! Parses, dispatches, exits.

use std::process::ExitCode;

fn main() -> ExitCode {
    rootq::cli::main()
}
