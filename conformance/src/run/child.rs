//! An adapter as a child process. `[spec: CONF-12]`

use super::peer::{Open, Peer, Trouble};
use crate::protocol::LINE_BYTES_MAX;
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, TryRecvError, channel, sync_channel};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

const LAST_WORDS_BYTES_MAX: usize = 4096;
/// How long to wait for the end of standard error of a child that has ended: a grandchild may keep it open.
const LAST_WORDS_WAIT: Duration = Duration::from_millis(200);
/// Lines read ahead of the requests: one is a reply, a second one is a fault already.
const LINES_AHEAD: usize = 2;
/// How long a child that has closed its output may take to end, before it is ended.
const GRACE: Duration = Duration::from_secs(2);

/// What a child is allowed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ChildLimits {
    /// How long it may take for one reply.
    pub reply: Duration,
    /// The most bytes of a line that it writes.
    pub line_bytes: usize,
}

impl Default for ChildLimits {
    fn default() -> Self {
        Self { reply: Duration::from_secs(10), line_bytes: LINE_BYTES_MAX }
    }
}

/// A command that starts an adapter.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Program {
    /// The program, then its arguments.
    pub command: Vec<String>,
    /// What it is allowed.
    pub limits: ChildLimits,
}

impl Open for Program {
    fn open(&mut self) -> Result<Box<dyn Peer>, Trouble> {
        let not_started = |why: &dyn std::fmt::Display| Trouble::Crash {
            how: format!("{:?} cannot be started: {why}", self.command),
        };
        let [program, arguments @ ..] = self.command.as_slice() else {
            return Err(not_started(&"no program is named"));
        };
        let mut child = Command::new(program)
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| not_started(&error))?;
        let (Some(stdin), Some(stdout), Some(stderr)) =
            (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            return Err(not_started(&"its pipes are missing"));
        };
        let (requests, to_write) = channel();
        let (replies, to_read) = sync_channel(LINES_AHEAD);
        let last_words = Arc::new(Mutex::new(VecDeque::new()));
        let (longest, words) = (self.limits.line_bytes, Arc::clone(&last_words));
        // The threads end with the pipes. Nobody waits for them: a grandchild may keep a pipe open for ever.
        thread::spawn(move || write_lines(stdin, &to_write));
        thread::spawn(move || read_lines(BufReader::new(stdout), longest, &replies));
        let (all_said, is_said) = channel();
        thread::spawn(move || {
            keep_last(stderr, &words);
            // Nobody may be waiting for it.
            let _ = all_said.send(());
        });
        Ok(Box::new(Running {
            child,
            requests: Some(requests),
            replies: to_read,
            last_words,
            is_said,
            limits: self.limits,
        }))
    }
}

/// What comes out of a child.
enum Heard {
    Line(String),
    Wrong(String),
}

struct Running {
    child: Child,
    /// None once the input has ended.
    requests: Option<Sender<String>>,
    replies: Receiver<Heard>,
    last_words: Arc<Mutex<VecDeque<u8>>>,
    /// Says when standard error has ended.
    is_said: Receiver<()>,
    limits: ChildLimits,
}

impl Peer for Running {
    fn exchange(&mut self, line: &str) -> Result<String, Trouble> {
        if let Some(trouble) = self.unasked() {
            return Err(trouble);
        }
        // A writer that has ended shows as the end of the replies.
        let _ = self.requests.as_ref().map(|requests| requests.send(format!("{line}\n")));
        match self.replies.recv_timeout(self.limits.reply) {
            Ok(Heard::Line(line)) => Ok(line),
            Ok(Heard::Wrong(what)) => Err(Trouble::protocol(what)),
            Err(RecvTimeoutError::Timeout) => Err(Trouble::Timeout { seconds: self.limits.reply.as_secs() }),
            Err(RecvTimeoutError::Disconnected) => Err(Trouble::Crash { how: self.end() }),
        }
    }

    fn unasked(&mut self) -> Option<Trouble> {
        match self.replies.try_recv() {
            Ok(Heard::Line(line)) => {
                Some(Trouble::protocol(format!("a line that nothing asked for: {}", excerpt(&line))))
            }
            Ok(Heard::Wrong(what)) => Some(Trouble::protocol(what)),
            Err(TryRecvError::Disconnected) => Some(Trouble::Crash { how: self.end() }),
            Err(TryRecvError::Empty) => None,
        }
    }

    fn finish(&mut self) {
        self.requests = None;
        self.end();
    }

    fn last_words(&mut self) -> String {
        if matches!(self.child.try_wait(), Ok(Some(_))) {
            // What a child said last may still be on its way.
            let _ = self.is_said.recv_timeout(LAST_WORDS_WAIT);
        }
        let words = self.last_words.lock().map(|words| words.iter().copied().collect::<Vec<u8>>());
        String::from_utf8_lossy(&words.unwrap_or_default()).into_owned()
    }
}

impl Running {
    /// How the child ended; it is ended if it only closed its output.
    fn end(&mut self) -> String {
        let deadline = Instant::now() + GRACE;
        loop {
            match self.child.try_wait() {
                Ok(Some(status)) => return status.to_string(),
                Ok(None) if Instant::now() < deadline => thread::sleep(Duration::from_millis(5)),
                Ok(None) => return "its output is closed".into(),
                Err(error) => return error.to_string(),
            }
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Without effect on one that has ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn write_lines(mut stdin: impl Write, lines: &Receiver<String>) {
    while let Ok(line) = lines.recv() {
        if stdin.write_all(line.as_bytes()).and_then(|()| stdin.flush()).is_err() {
            return;
        }
    }
}

/// Sends each line until the end, until one is wrong, or until nobody listens.
fn read_lines(mut stdout: impl BufRead, longest: usize, heard: &SyncSender<Heard>) {
    loop {
        let mut line = Vec::new();
        let read = stdout.by_ref().take(longest as u64 + 1).read_until(b'\n', &mut line);
        let whole = line.pop_if(|byte| *byte == b'\n').is_some();
        let next = match read {
            Ok(0) | Err(_) => return,
            Ok(_) if !whole && line.len() > longest => {
                Heard::Wrong(format!("a line of more than {longest} bytes"))
            }
            Ok(_) => match String::from_utf8(line) {
                Ok(line) if whole => Heard::Line(line),
                Ok(line) => Heard::Wrong(format!("the last line has no end: {}", excerpt(&line))),
                Err(error) => {
                    let sound = error.utf8_error().valid_up_to();
                    Heard::Wrong(format!("a line is not UTF-8 from byte {} on", sound + 1))
                }
            },
        };
        let is_wrong = matches!(next, Heard::Wrong(_));
        if heard.send(next).is_err() || is_wrong {
            return;
        }
    }
}

/// Reads all of standard error, and keeps the end of it.
fn keep_last(mut stderr: impl Read, words: &Mutex<VecDeque<u8>>) {
    let mut piece = [0; 1024];
    while let Ok(count @ 1..) = stderr.read(&mut piece) {
        let Ok(mut words) = words.lock() else { return };
        words.extend(&piece[..count]);
        let excess = words.len().saturating_sub(LAST_WORDS_BYTES_MAX);
        words.drain(..excess);
    }
}

/// The beginning of a line, as it is: who shows it escapes it.
pub(super) fn excerpt(line: &str) -> String {
    const CHARACTERS_MAX: usize = 80;
    let start: String = line.chars().take(CHARACTERS_MAX).collect();
    if start.len() < line.len() { format!("`{start}…`") } else { format!("`{start}`") }
}
