//! What goes wrong between an adapter and its output.

use dsr_conformance::adapter::Core;
use dsr_conformance::protocol::{Done, Reply};
use dsr_conformance::serve::serve;
use std::io::{self, BufRead, Read as _, Write};
use std::process::ExitCode;
use std::time::Duration;

/// Never says a word.
pub(super) fn hang() -> ExitCode {
    std::thread::sleep(Duration::from_secs(600));
    ExitCode::SUCCESS
}

/// Floods standard error, and serves all the same.
pub(super) fn chatter(input: impl BufRead) -> ExitCode {
    for _ in 0..20_000 {
        eprintln!("error: panic: {{\"id\": 1, \"error\": 1}} \u{1b}[31m");
    }
    let _ = io::stderr().write_all(&[0xff, 0xfe]);
    let served = serve(&mut Core::default(), input, io::stdout());
    if served.is_ok() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Shakes hands, and never reads again.
pub(super) fn deaf(mut input: impl BufRead) -> ExitCode {
    let mut line = String::new();
    if input.read_line(&mut line).is_err() {
        return ExitCode::FAILURE;
    }
    let served = serve(&mut Core::default(), line.as_bytes(), io::stdout());
    if served.is_ok() { hang() } else { ExitCode::FAILURE }
}

/// A line without an end.
pub(super) fn endless(mut output: impl Write) -> ExitCode {
    while output.write_all(&[b' '; 4096]).is_ok() {}
    ExitCode::FAILURE
}

/// Writes something else than the core's replies, from the middle of the victim on.
pub(super) struct Mangling<W> {
    pub(super) how: String,
    pub(super) output: W,
    pub(super) doomed: bool,
    pub(super) request: u64,
}

impl<W: Write> Write for Mangling<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // `serve` writes each reply at once, then its end.
        if bytes == b"\n" {
            return if self.doomed { Ok(1) } else { self.output.write(bytes) };
        }
        self.request += 1;
        // The second argument says in which reply, counted from 1.
        self.doomed = std::env::args().nth(2).and_then(|at| at.parse().ok()) == Some(self.request);
        if !self.doomed {
            self.output.write_all(bytes)?;
            return Ok(bytes.len());
        }
        match self.how.as_str() {
            "garbage" => self.output.write_all(b"Traceback (most recent call last):\n")?,
            "hangs" => drop(hang()),
            "dies" => std::process::exit(101),
            "wrong-id" => {
                let reply = Reply::new(self.request - 1, Ok(Done {}));
                writeln!(self.output, "{}", serde_json::to_string(&reply)?)?;
            }
            "cut-off" => {
                self.output.write_all(b"{\"id\": 3, \"ok\": {\"\xc3\n")?;
            }
            "half-line" => {
                self.output.write_all(b"{\"id\": 3, ")?;
                self.output.flush()?;
                std::process::exit(0);
            }
            "deep" => writeln!(self.output, "{{\"id\": 3, \"ok\": {}", "[".repeat(100_000))?,
            "bomb" => {
                let (open, close) = ("[".repeat(100_000), "]".repeat(100_000));
                writeln!(self.output, "{{\"id\": {}, \"ok\": {open}{close}}}", self.request)?;
            }
            "nul" => self.output.write_all(b"{\"id\": 3, \"ok\": {\0\0}}\n")?,
            "padded" => {
                // A whole line of the most bytes that there may be.
                self.output.write_all(bytes)?;
                io::copy(&mut io::repeat(b' ').take((1 << 20) - bytes.len() as u64), &mut self.output)?;
                self.output.write_all(b"\n")?;
            }
            "one-behind" => {
                let reply = Reply::new(self.request + 1, Ok(Done {}));
                writeln!(self.output, "{}", serde_json::to_string(&reply)?)?;
                self.output.write_all(bytes)?;
                self.output.write_all(b"\n")?;
            }
            "grandchild" => {
                // Whoever inherits standard output keeps it open after this one has ended.
                std::process::Command::new("sleep").arg("20").spawn()?;
                std::process::exit(101);
            }
            "twice" => {
                self.output.write_all(bytes)?;
                self.output.write_all(b"\n")?;
                self.output.write_all(bytes)?;
                self.output.write_all(b"\n")?;
            }
            "list" => writeln!(self.output, "{{\"id\": 3, \"ok\": [\"d1\"]}}")?,
            "neither" => writeln!(self.output, "{{\"id\": {}}}", self.request)?,
            "too-long" => {
                io::copy(&mut io::repeat(b'x').take(2 << 20), &mut self.output)?;
                self.output.write_all(b"\n")?;
            }
            other => return Err(io::Error::other(format!("{other:?} is no way to be broken"))),
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}
