//! Inputs kept by cause: `fuzz/seeds/<target>/<mark>` is a small input that reaches the mark.
//!
//! They come from the fuzzer, or from [`search`], and are made small by [`minimised`].

use crate::noise::Noise;
use crate::target::{Broken, Target};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The folder of all seeds in this repository.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../seeds")
}

/// The files of a folder, by name; none if there is no folder.
pub fn files(folder: &Path) -> io::Result<Vec<(String, Vec<u8>)>> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_file() {
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
            files.push((name.unwrap_or_default(), fs::read(&path)?));
        }
    }
    files.sort_unstable();
    Ok(files)
}

/// The smallest input known for each mark.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Best(pub BTreeMap<String, Vec<u8>>);

impl Best {
    /// Tries an input, and keeps it under each mark for which it is the smallest; whether it was kept.
    pub fn try_input(&mut self, target: &Target, input: &[u8]) -> Result<bool, Broken> {
        let marks = (target.run)(input)?;
        let mut kept = false;
        for mark in marks.iter() {
            if self.0.get(mark).is_none_or(|best| (input.len(), input) < (best.len(), &best[..])) {
                self.0.insert(mark.to_owned(), input.to_vec());
                kept = true;
            }
        }
        Ok(kept)
    }
}

/// Changes and joins inputs of a pool and those that reach the marks, so many times, and keeps what reaches new
/// ones or is smaller.
pub fn search(
    target: &Target,
    best: &mut Best,
    pool: &[Vec<u8>],
    rounds: usize,
    noise: &mut Noise,
) -> Result<(), Broken> {
    for _ in 0..rounds {
        let known: Vec<&Vec<u8>> = best.0.values().chain(pool).collect();
        if known.is_empty() {
            return Ok(());
        }
        let (one, other) = (known[noise.below(known.len())], known[noise.below(known.len())]);
        let input = match noise.below(8) {
            0 => [&one[..], other].concat(),
            1 | 2 => {
                let start = noise.below(other.len());
                let end = start + noise.below((other.len() - start).min(40) + 1);
                let at = noise.below(one.len() + 1);
                [&one[..at], &other[start..end], &one[at..]].concat()
            }
            _ => noise.changed(one),
        };
        best.try_input(target, &input)?;
    }
    Ok(())
}

/// A smaller input that still reaches a mark: pieces are left out while it does, then bytes made 0.
pub fn minimised(target: &Target, mark: &str, input: &[u8]) -> Vec<u8> {
    let reaches = |input: &[u8]| (target.run)(input).is_ok_and(|marks| marks.has(mark));
    let mut small = input.to_vec();
    let mut piece = small.len() / 2;
    while piece > 0 {
        let mut at = 0;
        while at < small.len() {
            let end = (at + piece).min(small.len());
            let less = [&small[..at], &small[end..]].concat();
            if reaches(&less) {
                small = less;
            } else {
                at += piece;
            }
        }
        piece /= 2;
    }
    if target.is_structured() {
        for at in 0..small.len() {
            let mut simpler = small.clone();
            if std::mem::replace(&mut simpler[at], 0) != 0 && reaches(&simpler) {
                small = simpler;
            }
        }
    }
    small
}
