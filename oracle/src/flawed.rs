//! Answers broken on purpose: what must be found. `[spec: ORACLE-7]`

use crate::fact::{Question, TAKEN, hex, made, read, refused};
use dsr_core::{
    CausalContext, Dictionary, Record, State, decode, digest, encode, encode_digest, fingerprint, view,
};
use std::io::{self, BufRead, Write};

/// How a program that speaks from the core is broken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Flaw {
    /// Not at all.
    Sound,
    /// A join forgets the dots of a removal whose record never was there.
    Join,
    /// A mutation's writes have a stamp too many.
    Delta,
    /// A taken name is an unknown vertex.
    Refusal,
    /// The broken cycle is reported as a second parent.
    View,
    /// Of a digest only the first run lives.
    Digest,
    /// An answer does not tell of removals.
    Answer,
    /// One byte too many is accepted.
    Accepts,
    /// It crashes at the fifth question.
    Crash,
    /// It never answers the fifth question.
    Hang,
    /// It answers the fifth question with what is no answer.
    Garbage,
    /// It leaves out the answer to the fifth question, and ends as if all were well.
    Short,
    /// It answers the fifth question twice.
    Twice,
}

impl Flaw {
    /// All of them, by name.
    pub const ALL: [(&'static str, Self); 13] = [
        ("sound", Self::Sound),
        ("join", Self::Join),
        ("delta", Self::Delta),
        ("refusal", Self::Refusal),
        ("view", Self::View),
        ("digest", Self::Digest),
        ("answer", Self::Answer),
        ("accepts", Self::Accepts),
        ("crash", Self::Crash),
        ("hang", Self::Hang),
        ("garbage", Self::Garbage),
        ("short", Self::Short),
        ("twice", Self::Twice),
    ];

    /// The flaw of a name.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(known, _)| *known == name).map(|(_, flaw)| flaw)
    }
}

/// What a server stops for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Served {
    /// Its input has ended.
    Whole,
    /// It was to crash.
    Crash,
}

/// The question from which on a program misbehaves.
const PATIENT: usize = 5;

/// Answers each line of `input`, from the core, with a flaw. Flushes when nothing more waits. `[spec: ORACLE-1]`
pub fn serve(flaw: Flaw, input: impl io::Read, output: impl Write) -> io::Result<Served> {
    let mut input = io::BufReader::with_capacity(1 << 16, input);
    let mut output = io::BufWriter::with_capacity(1 << 16, output);
    let mut dictionary = Dictionary::open();
    let mut line = String::new();
    for number in 1.. {
        line.clear();
        if input.read_line(&mut line)? == 0 {
            break;
        }
        let answer = answer(flaw, &mut dictionary, line.trim_end_matches('\n'));
        match flaw {
            Flaw::Crash if number == PATIENT => return output.flush().map(|()| Served::Crash),
            Flaw::Hang if number == PATIENT => {
                output.flush()?;
                loop {
                    std::thread::park();
                }
            }
            Flaw::Garbage if number == PATIENT => output.write_all(b"lorem ipsum\n")?,
            Flaw::Short if number == PATIENT => return output.flush().map(|()| Served::Whole),
            _ => {}
        }
        if flaw == Flaw::Twice && number == PATIENT {
            writeln!(output, "{answer}")?;
        }
        writeln!(output, "{answer}")?;
        if !input.buffer().contains(&b'\n') {
            output.flush()?;
        }
    }
    output.flush()?;
    Ok(Served::Whole)
}

fn answer(flaw: Flaw, dictionary: &mut Dictionary, line: &str) -> String {
    if let Some(json) = line.strip_prefix("dictionary ") {
        return match serde_json::from_str(json) {
            Ok(read) => {
                *dictionary = read;
                TAKEN.into()
            }
            Err(error) => format!("error no dictionary: {error}"),
        };
    }
    match read(line) {
        Ok(question) => broken(flaw, &question, dictionary).unwrap_or_else(|| question.answer(dictionary)),
        Err(error) => format!("error {}", error.to_string().replace('\n', " ")),
    }
}

/// What a broken core answers where it differs from the sound one.
fn broken(flaw: Flaw, question: &Question, dictionary: &Dictionary) -> Option<String> {
    match (flaw, question) {
        (Flaw::Join, Question::Join(states)) => {
            let [first, others @ ..] = states.as_slice() else { return None };
            let joined = others.iter().fold(first.clone(), |joined, other| forgetful(&joined, other));
            Some(hex(&encode(&joined)))
        }
        (Flaw::Delta, Question::Delta { author, state, mutation }) => {
            let delta = mutation.delta(&view(state, dictionary), *author).ok()?;
            let records = delta.records().map(|(dot, record)| (dot, later(record)));
            let delta = State::assemble(records, delta.context().clone());
            Some(made(&delta, &state.joined(&delta)))
        }
        (Flaw::Refusal, Question::Delta { author, state, mutation }) => {
            let kind = mutation.delta(&view(state, dictionary), *author).err()?.kind();
            (kind == "NameTaken").then(|| refused("ReservedName"))
        }
        (Flaw::View, Question::View(_)) => {
            let text = question.answer(dictionary);
            let at = text.find("[\"cycle-broken\"")?;
            Some(format!("{}[\"rt-parent\"{}", &text[..at], &text[at + "[\"cycle-broken\"".len()..]))
        }
        (Flaw::Digest, Question::Digest(state)) => {
            let mut digest = digest(state);
            digest.live.truncate(1);
            Some(format!("{} {}", hex(&encode_digest(&digest)), fingerprint(state)))
        }
        (Flaw::Answer, Question::Answer { state, digest }) => {
            let delta = dsr_core::delta_for(state, digest);
            let held = delta.records().map(|(dot, record)| (dot, record.clone()));
            let context: CausalContext = delta.records().map(|(dot, _)| dot).collect();
            Some(hex(&encode(&State::assemble(held, context))))
        }
        (Flaw::Accepts, Question::Accepts(bytes)) => {
            let (_, shorter) = bytes.split_last()?;
            (decode(bytes).is_err() && decode(shorter).is_ok()).then(|| "yes".into())
        }
        _ => None,
    }
}

/// The join of a core that forgets what it never held.
fn forgetful(left: &State, right: &State) -> State {
    let joined = left.joined(right);
    let mut context = left.context().clone();
    for (dot, _) in joined.records() {
        context.insert(dot);
    }
    right.records().for_each(|(dot, _)| context.insert(dot));
    State::assemble(joined.records().map(|(dot, record)| (dot, record.clone())), context)
}

fn later(record: &Record) -> Record {
    match record.clone() {
        Record::Write(mut write) => {
            write.stamp += 1;
            Record::Write(write)
        }
        other => other,
    }
}
