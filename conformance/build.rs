//! Lists the files of cases, in order, for `src/corpus.rs` to take in.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?).join("corpus/v1");
    let mut paths = Vec::new();
    println!("cargo::rerun-if-changed={}", folder.display());
    for family in fs::read_dir(&folder)? {
        let family = family?.path();
        if family.is_dir() {
            println!("cargo::rerun-if-changed={}", family.display());
            for file in fs::read_dir(&family)? {
                paths.push(file?.path());
            }
        }
    }
    paths.sort_unstable();
    let mut text = String::from("&[\n");
    for path in &paths {
        let name = path.strip_prefix(&folder).map_err(io::Error::other)?;
        let parts: Vec<_> = name.iter().map(|part| part.to_string_lossy()).collect();
        let line = format!("    ({:?}, include_str!({:?})),\n", parts.join("/"), path.to_string_lossy());
        text.write_str(&line).map_err(io::Error::other)?;
    }
    text.push_str("]\n");
    let out = PathBuf::from(env::var("OUT_DIR").map_err(io::Error::other)?);
    fs::write(out.join("files.rs"), text)
}
