//! `dsr conform new-adapter`: a template, written to a folder.

use crate::output::{err, out};
use crate::status::Status;
use dsr_conformance::templates::{TEMPLATES, Template};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Arguments of `dsr conform new-adapter`.
#[derive(clap::Args, Debug)]
pub(crate) struct NewAdapter {
    /// In which language
    #[arg(long, value_enum)]
    lang: Language,
    /// The folder to write; it must be new, or empty
    #[arg(long, value_name = "DIR", default_value = "my-adapter")]
    to: PathBuf,
    /// Writes over files that are there
    #[arg(long)]
    force: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug, clap::ValueEnum)]
enum Language {
    /// Python 3.8 or later, nothing else
    Python,
    /// Rust, with `serde_json`
    Rust,
    /// C++17, with nlohmann/json
    Cpp,
}

/// Why nothing is written, or not all.
#[derive(Debug, thiserror::Error)]
enum NewAdapterError {
    #[error(
        "{0} is there and not empty\n  remedy: name another folder by --to, or write over its files by --force"
    )]
    Taken(PathBuf),
    #[error("{path} cannot be written: {why}\n  remedy: name another folder by --to")]
    Write { path: PathBuf, why: io::Error },
    #[error("there is no template {0:?}\n  remedy: report this")]
    NoTemplate(&'static str),
}

impl Language {
    const fn name(self) -> &'static str {
        match self {
            Self::Python => "python",
            Self::Rust => "rust",
            Self::Cpp => "cpp",
        }
    }
}

impl NewAdapter {
    pub(crate) fn run(&self) -> Status {
        match self.write() {
            Ok(template) => {
                out(&next(template, &self.to));
                Status::Claimed
            }
            Err(error) => {
                err(error);
                Status::Usage
            }
        }
    }

    fn write(&self) -> Result<&'static Template, NewAdapterError> {
        let name = self.lang.name();
        let found = TEMPLATES.iter().find(|template| template.language == name);
        let template = found.ok_or(NewAdapterError::NoTemplate(name))?;
        if !self.force && !is_free(&self.to)? {
            return Err(NewAdapterError::Taken(self.to.clone()));
        }
        for (path, text) in template.files {
            let path = self.to.join(path);
            let failed = |why| NewAdapterError::Write { path: path.clone(), why };
            fs::create_dir_all(path.parent().unwrap_or(&self.to)).map_err(failed)?;
            fs::write(&path, text).map_err(failed)?;
        }
        Ok(template)
    }
}

/// Whether a folder is not there, or is empty.
fn is_free(folder: &Path) -> Result<bool, NewAdapterError> {
    match fs::read_dir(folder) {
        Ok(mut items) => Ok(items.next().is_none()),
        Err(why) if why.kind() == io::ErrorKind::NotFound => Ok(true),
        Err(why) => Err(NewAdapterError::Write { path: folder.into(), why }),
    }
}

/// The commands to run next.
fn next(template: &Template, folder: &Path) -> String {
    let files: Vec<&str> = template.files.iter().map(|(path, _)| *path).collect();
    let build = template.build.map(|build| format!(" && {build}")).unwrap_or_default();
    let start = template.start;
    format!(
        "{}: wrote {}\nNext:\n  cd {}{build}\n  dsr conform smoke -- {start}\n  \
         dsr conform run -- {start}\n",
        folder.display(),
        files.join(", "),
        folder.display(),
    )
}
