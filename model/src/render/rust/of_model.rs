//! A test that replays a trace by the semantics that it names.

use super::{comment, raw, test_name};
use crate::render::words::add;
use crate::trace::Trace;

pub(super) fn of_model(trace: &Trace) -> String {
    let mut text = String::new();
    add(&mut text, format_args!("// {}\n", comment(&trace.title)));
    text += "// A test of a crate that depends on `dsr-model`. A semantics that `dsr-model` does not know is replayed by\n\
             // `dsr_model::replay::replay_with(&semantics, &trace)`.\n//\n";
    for (at, step) in trace.steps.iter().enumerate() {
        let line = comment(&format!("{}: {}", step.replica, step.does));
        add(&mut text, format_args!("// {:>3}. {line}\n", at + 1));
    }
    add(
        &mut text,
        format_args!("//      {} {}\n\n", trace.finding.kind.sign(), comment(&trace.finding.to_string())),
    );
    text += "use dsr_model::replay::replay;\nuse dsr_model::trace::Trace;\n\n#[test]\n";
    add(&mut text, format_args!("fn {}() {{\n", test_name(trace)));
    text += "    let trace = Trace::read(TRACE).expect(\"a trace\");\n    \
             if let Err(difference) = replay(&trace) {\n        panic!(\"{difference}\");\n    }\n}\n\n";
    let json = serde_json::to_string_pretty(trace).unwrap_or_default();
    add(&mut text, format_args!("const TRACE: &str = {};\n", raw(&json)));
    text
}
