//! Errors for people: file, place, what is wrong, what to do.

use crate::input::InputError;
use crate::output::err;
use crate::status::Status;
use dsr_core::scene::Fault;

/// Tells why a file gives no graph; the status is that of wrong input.
pub(super) fn unusable(file: &str, error: &InputError) -> Status {
    if let InputError::Refused(refused) = error {
        faults(file, &refused.faults);
        err(format_args!("{file}: refused for {error}; --lenient drops what can be dropped"));
    } else {
        err(format_args!("{file}: {error}\n  remedy: {}", error.remedy()));
    }
    Status::Usage
}

/// Tells each fault: `FILE:LINE:COLUMN: …`, as editors and terminals link it.
pub(super) fn faults(file: &str, faults: &[Fault]) {
    for fault in faults {
        err(format_args!("{}\n  remedy: {}", line(file, fault), fault.kind.remedy()));
    }
}

/// Tells what reading leniently has dropped.
pub(super) fn dropped(file: &str, faults: &[Fault]) {
    for fault in faults {
        err(format_args!("{}\n  dropped", line(file, fault)));
    }
}

fn line(file: &str, fault: &Fault) -> String {
    let full = fault.to_string();
    let head = format!("line {}, column {}", fault.place.line, fault.place.column);
    let rest = full.strip_prefix(&head).unwrap_or(&full).trim_start_matches([',', ':', ' ']);
    format!("{file}:{}:{}: {rest}", fault.place.line, fault.place.column)
}
