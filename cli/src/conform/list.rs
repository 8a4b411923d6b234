//! `dsr conform list`.

use super::chosen::{Choice, Format, Printed};
use super::error::ConformError;
use crate::output::{add, out};
use crate::status::Status;
use dsr_conformance::case::Level;

const AFTER: &str = "\
Examples:
  dsr conform list --only '*/refusals/*'
  dsr conform list --clause JOIN-3
  dsr conform list --profile observe --format json";

/// Lists the cases
#[derive(clap::Args, Debug)]
#[command(after_help = AFTER)]
pub(super) struct Arguments {
    #[command(flatten)]
    choice: Choice,
    /// Only cases that witness this clause
    #[arg(long, value_name = "ID")]
    clause: Option<String>,
    #[command(flatten)]
    printed: Printed,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, ConformError> {
        if let Some(clause) = &self.clause
            && clause.parse().ok().and_then(|id| dsr_spec::clause_text(&id)).is_none()
        {
            let what = format!("there is no clause {clause:?}\n  remedy: name one of spec/, such as JOIN-3");
            return Err(ConformError::Usage(vec![what]));
        }
        let cases = self.choice.citing(self.clause.as_deref())?;
        let mut text = String::new();
        match self.printed.format {
            Format::Text => {
                for case in &cases {
                    let level = match case.level {
                        Level::Must => "must",
                        Level::Should => "should",
                        Level::May => "may",
                    };
                    add(&mut text, format_args!("{:<44} {level:<6} {}\n", case.id, case.title));
                }
            }
            Format::Json => {
                let listed: Vec<_> = cases
                    .iter()
                    .map(|case| {
                        serde_json::json!({
                            "id": case.id, "title": case.title, "level": case.level, "profile": case.profile,
                            "requires": case.requires, "clauses": case.spec,
                        })
                    })
                    .collect();
                add(&mut text, format_args!("{}\n", serde_json::to_string_pretty(&listed)?));
            }
        }
        out(&text);
        Ok(Status::Claimed)
    }
}
