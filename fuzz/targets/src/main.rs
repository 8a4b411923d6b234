//! `dsr-fuzz`: targets without a fuzzer. `docs/fuzzing.md` says when.

#![forbid(unsafe_code)]

use dsr_fuzz_targets::noise::Noise;
use dsr_fuzz_targets::seeds::{self, Best};
use dsr_fuzz_targets::{Broken, TARGETS, Target, target};
use std::path::Path;
use std::process::ExitCode;
use std::{env, fs, io};

const USAGE: &str = "dsr-fuzz list                            the targets
dsr-fuzz first TARGET FOLDER             writes the inputs to begin with
dsr-fuzz marks TARGET FOLDER...          which marks the files reach, and which are missing
dsr-fuzz run TARGET FILE...              tries inputs, and tells what each reaches or breaks
dsr-fuzz seeds ROUNDS TARGET [FOLDER...] searches small inputs for each mark, from files too, and writes fuzz/seeds";

/// Why a command ends.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error("{USAGE}")]
    Usage,
    #[error("there is no target {0:?}; `dsr-fuzz list` names all")]
    NoTarget(String),
    #[error("{path}: {source}")]
    File { path: String, source: io::Error },
    #[error("a law is broken by {input}: {broken}")]
    Law { input: String, broken: Broken },
}

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let ended = match arguments.as_slice() {
        ["list"] => {
            for target in &TARGETS {
                println!("{:16} {}", target.name, target.about);
            }
            Ok(())
        }
        ["first", name, folder] => named(name).and_then(|target| first(target, Path::new(folder))),
        ["marks", name, folders @ ..] => named(name).and_then(|target| marks(target, folders)),
        ["run", name, files @ ..] => named(name).and_then(|target| run(target, files)),
        ["seeds", rounds, name, folders @ ..] => match rounds.parse() {
            Ok(rounds) => named(name).and_then(|target| search(target, rounds, folders)),
            Err(_) => Err(Failure::Usage),
        },
        _ => Err(Failure::Usage),
    };
    match ended {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}

fn named(name: &str) -> Result<&'static Target, Failure> {
    target(name).ok_or_else(|| Failure::NoTarget(name.into()))
}

fn at(path: &Path) -> impl Fn(io::Error) -> Failure + '_ {
    |source| Failure::File { path: path.display().to_string(), source }
}

fn first(target: &Target, folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(at(folder))?;
    for (number, input) in (target.first)().into_iter().enumerate() {
        let path = folder.join(format!("first-{number:03}"));
        fs::write(&path, input).map_err(at(&path))?;
    }
    Ok(())
}

fn files(folders: &[&str]) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let mut all = Vec::new();
    for folder in folders {
        all.extend(seeds::files(Path::new(folder)).map_err(at(Path::new(folder)))?);
    }
    Ok(all)
}

fn reached(target: &Target, inputs: &[(String, Vec<u8>)], best: &mut Best) -> Result<(), Failure> {
    inputs.iter().try_for_each(|(name, input)| match best.try_input(target, input) {
        Ok(_) => Ok(()),
        Err(broken) => Err(Failure::Law { input: name.clone(), broken }),
    })
}

fn marks(target: &Target, folders: &[&str]) -> Result<(), Failure> {
    let mut best = Best::default();
    reached(target, &files(folders)?, &mut best)?;
    let missing: Vec<&str> =
        target.marks.iter().copied().filter(|mark| !best.0.contains_key(*mark)).collect();
    println!("{} of {} marks", target.marks.len() - missing.len(), target.marks.len());
    for mark in missing {
        println!("missing {mark}");
    }
    for mark in best.0.keys().filter(|mark| !target.marks.contains(&mark.as_str())) {
        println!("not in the list {mark}");
    }
    Ok(())
}

fn run(target: &Target, paths: &[&str]) -> Result<(), Failure> {
    for path in paths {
        let input = fs::read(path).map_err(at(Path::new(path)))?;
        match (target.run)(&input) {
            Ok(marks) => println!("{path}: {}", marks.iter().collect::<Vec<_>>().join(" ")),
            Err(broken) => return Err(Failure::Law { input: (*path).into(), broken }),
        }
    }
    Ok(())
}

fn search(target: &Target, rounds: usize, folders: &[&str]) -> Result<(), Failure> {
    let folder = seeds::folder().join(target.name);
    let kept = seeds::files(&folder).map_err(at(&folder))?;
    let mut best = Best::default();
    reached(target, &kept, &mut best)?;
    let before = best.clone();
    let mut pool = (target.first)();
    pool.extend(files(folders)?.into_iter().map(|(_, input)| input));
    let numbered = pool.iter().enumerate().map(|(number, input)| (format!("input {number}"), input.clone()));
    reached(target, &numbered.collect::<Vec<_>>(), &mut best)?;
    let law = |broken| Failure::Law { input: "a changed input".into(), broken };
    seeds::search(target, &mut best, &pool, rounds, &mut Noise::new(rounds as u64)).map_err(law)?;
    fs::create_dir_all(&folder).map_err(at(&folder))?;
    for (mark, input) in &best.0 {
        let small = seeds::minimised(target, mark, input);
        let path = folder.join(mark);
        if before.0.get(mark).is_none_or(|known| small.len() < known.len()) || !path.exists() {
            fs::write(&path, small).map_err(at(&path))?;
        }
    }
    println!("{:16} {} marks", target.name, best.0.len());
    Ok(())
}
