//! The core as a program that answers facts, or as an adapter; sound, or broken as the first argument says.
//!
//! `facts-of-core [FLAW] [facts]`: without `facts` it is an adapter of the conformance corpus.

use dsr_conformance::adapter::Core;
use dsr_oracle::flawed::{Flaw, Served, serve};
use dsr_oracle::program::FACTS;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let facts = arguments.pop_if(|last| last == FACTS).is_some();
    let name = arguments.first().map_or("sound", String::as_str);
    let Some(flaw) = Flaw::of(name) else {
        let names: Vec<&str> = Flaw::ALL.iter().map(|(name, _)| *name).collect();
        eprintln!("no flaw {name:?}; there are {}", names.join(", "));
        return ExitCode::from(3);
    };
    let (input, output) = (std::io::stdin().lock(), std::io::stdout().lock());
    let served = if facts {
        serve(flaw, input, output).map_err(|error| error.to_string())
    } else {
        let served = dsr_conformance::serve::serve(&mut Core::default(), input, output);
        served.map(|()| Served::Whole).map_err(|error| error.to_string())
    };
    match served {
        Ok(Served::Whole) => ExitCode::SUCCESS,
        Ok(Served::Crash) => ExitCode::from(7),
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}
