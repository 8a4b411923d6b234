//! The JSON Schema of traces in `spec/` is that of the Rust types.

use dsr_model::trace::Trace;
use std::path::Path;

/// Set `DSR_WRITE=1` to write the file anew. `[spec: TRACE-1]` `[spec: TRACE-2]`
#[test]
fn law_the_schema_in_the_specification_is_that_of_the_types() {
    let schema = schemars::schema_for!(Trace);
    let text = serde_json::to_string_pretty(&schema).expect("json") + "\n";
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../spec/trace.schema.json");
    if std::env::var_os("DSR_WRITE").is_some() {
        std::fs::write(&file, &text).expect("a file that can be written");
    }
    let written = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(written == text, "spec/trace.schema.json is out of date: run this test with DSR_WRITE=1");
}
