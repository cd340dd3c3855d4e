//! `cargo fmu check`: the same program, compiled with the feature `check`, under a name of its own. Of one name, each of the two
//! would put itself in the place of the other while that is at work.

#[path = "main.rs"]
mod program;

fn main() -> std::process::ExitCode {
    program::main()
}
