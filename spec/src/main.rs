//! Writes `spec/MATRIX.md` and lists what is wrong between specification, code and witnesses.

use dsr_spec::{MATRIX_PATH, matrix, read_inputs, trace};
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let inputs = read_inputs(&root)?;
    let trace = trace(&inputs.texts, &inputs.rust);
    std::fs::write(root.join(MATRIX_PATH), matrix(&trace))?;
    println!("{} clauses; wrote {MATRIX_PATH}", trace.clauses.all().len());
    let exempt: Vec<String> = trace
        .exemptions()
        .map(|clause| clause.marker.map_or(String::new(), |marker| format!("{} ({marker})", clause.id)))
        .collect();
    println!("{} clauses need no witness: {}", exempt.len(), exempt.join(", "));
    for fault in &trace.faults {
        println!("{fault}");
    }
    Ok(if trace.faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
