//! Adapters to start from, in `conformance/templates`: each a small implementation that speaks the protocol.

/// A folder to copy.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Template {
    /// The language's name, as on the command line.
    pub language: &'static str,
    /// Each file: its path within the folder, and its text.
    pub files: &'static [(&'static str, &'static str)],
    /// How it is built within the folder, if it has to be.
    pub build: Option<&'static str>,
    /// How it is started within the folder.
    pub start: &'static str,
}

macro_rules! files {
    ($language:literal, $($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../templates/", $language, "/", $path)))),*]
    };
}

/// All of them.
pub const TEMPLATES: [Template; 3] = [
    Template {
        language: "python",
        files: files!("python", "adapter.py"),
        build: None,
        start: "python3 adapter.py",
    },
    Template {
        language: "rust",
        files: files!("rust", "Cargo.toml", "src/main.rs", "src/graph.rs"),
        build: Some("cargo build"),
        start: "target/debug/my-adapter",
    },
    Template {
        language: "cpp",
        files: files!("cpp", "Makefile", "adapter.cpp"),
        build: Some("make"),
        start: "./adapter",
    },
];
