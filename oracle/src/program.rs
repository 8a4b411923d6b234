//! A program as a child process. `[spec: ORACLE-1]` `[spec: ORACLE-6]`
//!
//! Questions are written by one thread and answers read by another, so whoever asks may be far ahead of the answers, and
//! nobody waits for a pipe that nobody empties.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Where the program is unless another one is named.
pub const DEFAULT: &str = "target/coq/oracle/dsr-oracle";
/// The argument that makes it answer facts.
pub const FACTS: &str = "facts";

/// How long one answer may take.
pub const PATIENCE: Duration = Duration::from_secs(60);
/// The longest answer.
const LINE_BYTES_MAX: usize = 64 << 20;
/// Groups of answers read ahead of whoever wants them.
const GROUPS_AHEAD: usize = 64;
/// The most answers of a group.
const GROUP_MAX: usize = 512;
/// How long a program may take to end once its input has.
const GRACE: Duration = Duration::from_secs(5);
/// How much of what it says on standard error is kept.
const WORDS_BYTES_MAX: usize = 2000;

/// Why the program cannot be asked. None of these is an agreement. `[spec: ORACLE-6]`
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Trouble {
    /// There is no such program.
    #[error(
        "there is no program {path:?}\n  remedy: build it with `spec/coq/check`, or name another one with --program"
    )]
    Missing {
        /// Where it was looked for.
        path: String,
    },
    /// It is there and cannot be started.
    #[error(
        "{command:?} cannot be started: {why}\n  remedy: check its permissions, or build it anew with `spec/coq/check`"
    )]
    NotStarted {
        /// The program and its arguments.
        command: Vec<String>,
        /// Why.
        why: String,
    },
    /// It ended before it had answered.
    #[error("the program ended ({how}) without an answer to: {question}{}", said(words))]
    Ended {
        /// How it ended.
        how: String,
        /// What was to be answered next.
        question: String,
        /// What it said on standard error.
        words: String,
    },
    /// It did not answer in time.
    #[error("no answer within {seconds} s to: {question}")]
    Late {
        /// The time allowed.
        seconds: u64,
        /// What was to be answered.
        question: String,
    },
    /// What came is no line of text.
    #[error("the answer is no line of UTF-8 of at most {LINE_BYTES_MAX} bytes, to: {question}")]
    NoLine {
        /// What was to be answered.
        question: String,
    },
    /// What came is no answer of the chapter.
    #[error("{answer} is no answer, to: {question}")]
    Garbage {
        /// What came.
        answer: String,
        /// What was to be answered.
        question: String,
    },
    /// It answered what nobody had asked.
    #[error("{answer} is an answer to nothing that was asked")]
    Unasked {
        /// What came.
        answer: String,
    },
}

fn said(words: &str) -> String {
    let words = words.trim_end();
    if words.is_empty() { String::new() } else { format!("\nstandard error:\n{words}") }
}

/// How a program is started.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Start {
    /// The program, then its arguments.
    pub command: Vec<String>,
    /// How long one answer may take.
    pub patience: Duration,
}

impl Start {
    /// A program, without arguments.
    pub fn new(program: impl Into<String>) -> Self {
        Self { command: vec![program.into()], patience: PATIENCE }
    }

    /// The same with one more argument.
    #[must_use]
    pub fn with(mut self, argument: impl Into<String>) -> Self {
        self.command.push(argument.into());
        self
    }

    /// Starts it.
    pub fn start(&self) -> Result<Program, Trouble> {
        Program::start(self)
    }
}

/// What comes out of a program.
enum Heard {
    Lines(Vec<String>),
    NoLine,
}

/// A program that has been started.
#[derive(Debug)]
pub struct Program {
    child: Child,
    /// None once its input has ended.
    to_write: Option<Sender<Vec<u8>>>,
    heard: Receiver<Heard>,
    /// Answers that have been read and not been taken, the next one last.
    ready: Vec<String>,
    words: Arc<Mutex<Vec<u8>>>,
    patience: Duration,
}

impl std::fmt::Debug for Heard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if matches!(self, Self::Lines(_)) { "lines" } else { "no line" })
    }
}

impl Program {
    fn start(start: &Start) -> Result<Self, Trouble> {
        let not_started = |why: String| Trouble::NotStarted { command: start.command.clone(), why };
        let [program, arguments @ ..] = start.command.as_slice() else {
            return Err(not_started("no program is named".into()));
        };
        if program.contains('/') && !Path::new(program).exists() {
            return Err(Trouble::Missing { path: program.clone() });
        }
        let mut child = Command::new(program)
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| not_started(error.to_string()))?;
        let (Some(stdin), Some(stdout), Some(stderr)) =
            (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            return Err(not_started("its pipes are missing".into()));
        };
        let (to_write, writing) = channel::<Vec<u8>>();
        let (reading, heard) = sync_channel(GROUPS_AHEAD);
        let words = Arc::new(Mutex::new(Vec::new()));
        let kept = Arc::clone(&words);
        // The threads end with the pipes. Nobody waits for them: a grandchild may keep a pipe open for ever.
        thread::spawn(move || write_all(stdin, &writing));
        thread::spawn(move || read_all(BufReader::with_capacity(1 << 16, stdout), &reading));
        thread::spawn(move || keep_words(stderr, &kept));
        let patience = start.patience;
        Ok(Self { child, to_write: Some(to_write), heard, ready: Vec::new(), words, patience })
    }

    /// Sends lines, each with its end. Whoever sends takes as many answers; how far it is ahead is its own matter.
    pub fn send(&self, lines: Vec<u8>) {
        // A writer that has ended shows as the end of the answers.
        let _ = self.to_write.as_ref().map(|to_write| to_write.send(lines));
    }

    /// The next answer, to a question that is named if it does not come.
    pub fn answer(&mut self, question: &dyn Fn() -> String) -> Result<String, Trouble> {
        loop {
            if let Some(line) = self.ready.pop() {
                return Ok(line);
            }
            match self.heard.recv_timeout(self.patience) {
                Ok(Heard::Lines(mut lines)) => {
                    lines.reverse();
                    self.ready = lines;
                }
                Ok(Heard::NoLine) => return Err(Trouble::NoLine { question: excerpt(&question()) }),
                Err(RecvTimeoutError::Timeout) => {
                    let seconds = self.patience.as_secs();
                    return Err(Trouble::Late { seconds, question: excerpt(&question()) });
                }
                Err(RecvTimeoutError::Disconnected) => {
                    let (how, words) = (self.end(), self.words());
                    return Err(Trouble::Ended { how, question: excerpt(&question()), words });
                }
            }
        }
    }

    /// Asks a few questions and waits for their answers.
    pub fn ask(&mut self, lines: &[String]) -> Result<Vec<String>, Trouble> {
        let mut answers = Vec::with_capacity(lines.len());
        for group in lines.chunks(GROUP_MAX) {
            self.send(joined(group));
            for line in group {
                answers.push(self.answer(&|| line.clone())?);
            }
        }
        Ok(answers)
    }

    /// Ends its input, and sees to it that nothing more comes and that it ends well. `[spec: ORACLE-6]`
    pub fn finish(mut self) -> Result<(), Trouble> {
        self.to_write = None;
        if let Some(answer) = self.ready.pop() {
            return Err(Trouble::Unasked { answer: excerpt(&answer) });
        }
        let ended =
            |how, words| Trouble::Ended { how, question: "nothing: its input had ended".into(), words };
        match self.heard.recv_timeout(GRACE) {
            Ok(Heard::Lines(lines)) => {
                let answer = lines.first().map(|line| excerpt(line)).unwrap_or_default();
                Err(Trouble::Unasked { answer })
            }
            Ok(Heard::NoLine) => Err(Trouble::Unasked { answer: "what is no line".into() }),
            Err(RecvTimeoutError::Timeout) => Err(ended("it did not".into(), self.words())),
            Err(RecvTimeoutError::Disconnected) => match self.child_status() {
                Some(status) if status.success() => Ok(()),
                Some(status) => Err(ended(status.to_string(), self.words())),
                None => Err(ended("its output is closed".into(), self.words())),
            },
        }
    }

    fn end(&mut self) -> String {
        self.child_status().map_or_else(|| "its output is closed".into(), |status| status.to_string())
    }

    fn child_status(&mut self) -> Option<std::process::ExitStatus> {
        let deadline = Instant::now() + GRACE;
        while Instant::now() < deadline {
            match self.child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Ok(None) => thread::sleep(Duration::from_millis(2)),
                Err(_) => return None,
            }
        }
        None
    }

    fn words(&self) -> String {
        // What it said last may still be on its way.
        thread::sleep(Duration::from_millis(20));
        let words = self.words.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&words).into_owned()
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // Without effect on one that has ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Lines with their ends.
pub(crate) fn joined(lines: &[String]) -> Vec<u8> {
    let mut text = Vec::with_capacity(lines.iter().map(|line| line.len() + 1).sum());
    for line in lines {
        text.extend_from_slice(line.as_bytes());
        text.push(b'\n');
    }
    text
}

/// A line for people: long runs of digits shortened in their middle, and nothing that upsets a terminal.
pub(crate) fn excerpt(line: &str) -> String {
    const CHARACTERS_MAX: usize = 400;
    const DIGITS_MAX: usize = 40;
    let words = line.split(' ').map(|word| {
        let is_digits = word.len() > DIGITS_MAX && word.bytes().all(|byte| byte.is_ascii_hexdigit());
        if is_digits { format!("{}…({} bytes)", &word[..DIGITS_MAX], word.len() / 2) } else { word.into() }
    });
    let text = words.collect::<Vec<String>>().join(" ");
    let plain = text.chars().map(|character| if character.is_control() { '\u{fffd}' } else { character });
    let start: String = plain.take(CHARACTERS_MAX).collect();
    if start.len() < text.len() { start + "…" } else { start }
}

fn write_all(mut stdin: impl Write, lines: &Receiver<Vec<u8>>) {
    while let Ok(lines) = lines.recv() {
        if stdin.write_all(&lines).and_then(|()| stdin.flush()).is_err() {
            return;
        }
    }
}

/// Hands over lines as they come, in groups, until the end or until one is wrong.
fn read_all(mut stdout: BufReader<impl Read>, heard: &SyncSender<Heard>) {
    loop {
        let mut lines = Vec::new();
        loop {
            let mut line = Vec::new();
            let longest = LINE_BYTES_MAX as u64 + 1;
            match stdout.by_ref().take(longest).read_until(b'\n', &mut line) {
                Ok(0) | Err(_) => {
                    if !lines.is_empty() {
                        let _ = heard.send(Heard::Lines(lines));
                    }
                    return;
                }
                Ok(_) => {}
            }
            let whole = line.pop_if(|byte| *byte == b'\n').is_some();
            match String::from_utf8(line) {
                Ok(line) if whole => lines.push(line),
                _ => {
                    let _ = heard.send(Heard::Lines(lines)).and_then(|()| heard.send(Heard::NoLine));
                    return;
                }
            }
            if lines.len() == GROUP_MAX || !stdout.buffer().contains(&b'\n') {
                break;
            }
        }
        if heard.send(Heard::Lines(lines)).is_err() {
            return;
        }
    }
}

/// Reads all of standard error, and keeps its beginning.
fn keep_words(mut stderr: impl Read, words: &Mutex<Vec<u8>>) {
    let mut piece = [0; 1024];
    while let Ok(count @ 1..) = stderr.read(&mut piece) {
        let mut words = words.lock().unwrap_or_else(PoisonError::into_inner);
        let room = WORDS_BYTES_MAX.saturating_sub(words.len());
        words.extend(&piece[..count.min(room)]);
    }
}
