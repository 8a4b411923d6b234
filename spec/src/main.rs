//! Writes `spec/MATRIX.md`, `docs/assurance.md` and the README's table of claims, and lists what is wrong between
//! specification, code, witnesses and evidence.

use dsr_spec::{
    ASSURANCE_PATH, MATRIX_PATH, README_PATH, assurance, evidence, matrix, read_documents, read_file,
    read_inputs, readme,
};
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let evidence = evidence(&read_inputs(&root)?, &read_documents(&root)?);
    let trace = &evidence.trace;
    std::fs::write(root.join(MATRIX_PATH), matrix(trace))?;
    std::fs::write(root.join(ASSURANCE_PATH), assurance(&evidence, &read_file(&root, ASSURANCE_PATH)?)?)?;
    std::fs::write(root.join(README_PATH), readme(&evidence, &read_file(&root, README_PATH)?)?)?;
    println!("{} clauses; wrote {MATRIX_PATH}, {ASSURANCE_PATH}, {README_PATH}", trace.clauses.all().len());
    let exempt: Vec<String> = trace
        .exemptions()
        .map(|clause| clause.marker.map_or(String::new(), |marker| format!("{} ({marker})", clause.id)))
        .collect();
    println!("{} clauses need no witness: {}", exempt.len(), exempt.join(", "));
    for fault in &trace.faults {
        println!("{fault}");
    }
    for gap in &evidence.gaps {
        println!("{gap}");
    }
    let is_sound = trace.faults.is_empty() && evidence.gaps.is_empty();
    Ok(if is_sound { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
