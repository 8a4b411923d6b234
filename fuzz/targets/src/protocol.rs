//! Any text into what the conformance harness reads: requests, replies, case files, logs, expectations.
//! `[spec: CONF-1]` `[spec: CONF-2]` `[spec: CONF-11]` `[spec: CONF-13]` `[spec: CONF-14]`

use crate::target::{Broken, Marks, Outcome, equal, holds, variant};
use dsr_conformance::adapter::Core;
use dsr_conformance::case;
use dsr_conformance::expect::Expectations;
use dsr_conformance::log;
use dsr_conformance::protocol::{
    BytesShown, DigestShown, Done, Found, HelloReply, MadeDelta, Reply, Request, Shown, StateShown,
    read_strictly,
};
use dsr_conformance::serve::{ServeError, serve};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::fmt::Debug;

/// The lines, as requests to the core's adapter and as replies; the whole, as files.
pub(crate) fn text(bytes: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    served(bytes, &mut marks)?;
    let Ok(text) = std::str::from_utf8(bytes) else { return Ok(marks) };
    for line in text.lines().take(32) {
        lines::<Request>("request", line, &mut marks)?;
        replies(line, &mut marks)?;
    }
    files(bytes, text, &mut marks)?;
    Ok(marks)
}

/// Each request gets one reply, with its id, and what a reply says can be read.
fn served(bytes: &[u8], marks: &mut Marks) -> Result<(), Broken> {
    let mut output = Vec::new();
    let ended = serve(&mut Core::default(), bytes, &mut output);
    let output = String::from_utf8(output).map_err(|error| Broken::new("CONF-1", error))?;
    let requests: Vec<&[u8]> = bytes.split(|&byte| byte == b'\n').collect();
    for (reply, request) in output.lines().zip(&requests) {
        let reply: Value = serde_json::from_str(reply).map_err(|error| Broken::new("CONF-2", error))?;
        if let Ok(request) = serde_json::from_slice::<Value>(request) {
            equal("CONF-2", "the ids of request and reply", &reply["id"], &request["id"])?;
        }
        look(&reply, marks);
    }
    match ended {
        Ok(()) => {
            let due = requests.len() - usize::from(bytes.is_empty() || bytes.ends_with(b"\n"));
            equal("CONF-1", "requests, and replies", &due, &output.lines().count())
        }
        Err(error) => {
            let is_told = !matches!(error, ServeError::NoReply { .. } | ServeError::Io(_));
            holds("CONF-2", is_told, || format!("no reply: {error}"))?;
            marks.add(format!("served-{}", variant(&error)));
            Ok(())
        }
    }
}

/// What kind of answer it is.
fn look(reply: &Value, marks: &mut Marks) {
    if let Some(code) = reply["error"]["code"].as_str() {
        marks.add(format!("error-{code}"));
    }
    for member in reply["ok"].as_object().into_iter().flatten() {
        marks.add(format!("answer-{}", member.0));
    }
    if reply["ok"].as_object().is_some_and(serde_json::Map::is_empty) {
        marks.add("answer-done");
    }
}

fn replies(line: &str, marks: &mut Marks) -> Result<(), Broken> {
    lines::<Reply<HelloReply>>("reply-hello", line, marks)?;
    lines::<Reply<MadeDelta>>("reply-delta", line, marks)?;
    lines::<Reply<Shown>>("reply-view", line, marks)?;
    lines::<Reply<Found>>("reply-vertex", line, marks)?;
    lines::<Reply<StateShown>>("reply-state", line, marks)?;
    lines::<Reply<DigestShown>>("reply-digest", line, marks)?;
    lines::<Reply<BytesShown>>("reply-bytes", line, marks)?;
    lines::<Reply<Done>>("reply-done", line, marks)
}

/// What is read strictly is written and read again as the same.
fn lines<T: Serialize + DeserializeOwned + PartialEq + Debug>(
    what: &str,
    line: &str,
    marks: &mut Marks,
) -> Result<(), Broken> {
    let Ok(read) = read_strictly::<T>(line) else { return Ok(()) };
    let written = serde_json::to_string(&read).map_err(|error| Broken::new("CONF-2", error))?;
    let again =
        read_strictly::<T>(&written).map_err(|error| Broken::new("CONF-2", format!("{error}: {written}")))?;
    marks.add(format!("line-{what}"));
    equal("CONF-2", "a line, and what was written of it", &again, &read)
}

/// The path that a file of cases must have, by what it says itself.
fn path_of(text: &str) -> String {
    let read: Value = serde_json::from_str(text).unwrap_or_default();
    let part = |key: &str| read[key].as_str().unwrap_or_default().to_owned();
    format!("{}/{}.json", part("family"), part("topic"))
}

fn files(bytes: &[u8], text: &str, marks: &mut Marks) -> Result<(), Broken> {
    let path = path_of(text);
    match case::read(&path, text) {
        Ok(cases) => {
            let written = case::write(&cases).map_err(|error| Broken::new("CONF-11", error))?;
            let again = case::read(&path, &written);
            let again = again.map_err(|error| Broken::new("CONF-11", format!("{error}\n{written}")))?;
            marks.add("file-of-cases");
            equal("CONF-11", "cases, and what was written of them", &again, &cases)?;
        }
        Err(error) => {
            let is_told = error.line > 0 && !error.what.is_empty() && !error.remedy.is_empty();
            holds("CONF-11", is_told, || format!("no explanation: {error:?}"))?;
        }
    }
    match log::read("log", bytes) {
        Ok(log) => marks.add(if log.incomplete.is_some() { "log-incomplete" } else { "log" }),
        Err(error) => {
            let is_told = error.line > 0 && !error.what.is_empty();
            holds("CONF-13", is_told, || format!("no explanation: {error:?}"))?;
        }
    }
    match Expectations::read("expected", text) {
        Ok(read) => {
            let written = read.text().map_err(|error| Broken::new("CONF-14", error))?;
            marks.add("expectations");
            equal(
                "CONF-14",
                "expectations, written and read",
                &Expectations::read("expected", &written).as_ref(),
                &Ok(&read),
            )
        }
        Err(error) => holds("CONF-14", error.to_string().len() > 10, || format!("no explanation: {error:?}")),
    }
}
