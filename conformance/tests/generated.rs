//! The files of computed cases are what their generators give. Run with `DSR_WRITE=1` to write them anew.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on says where")]

use dsr_conformance::case::{CaseFile, write};
use dsr_conformance::generate::gallery;
use dsr_model::gallery::rows;
use std::path::Path;

fn compare_or_write(file: &CaseFile) {
    let name = format!("{}/{}.json", file.family, file.topic);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus/v1").join(&name);
    let text = write(file).unwrap();
    if std::env::var_os("DSR_WRITE").is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(written == text, "{name} is out of date: run this test with DSR_WRITE=1");
}

/// `[spec: CONF-11]`
#[test]
fn conform_the_gallery_has_a_case_for_each_row_and_an_outcome_where_several_take_part() {
    let files = gallery().unwrap();
    let several = rows().iter().filter(|row| row.setup.replicas() > 1).count();
    assert_eq!(files[0].cases.len(), rows().len());
    assert_eq!(files[1].cases.len(), several);
    files.iter().for_each(compare_or_write);
}
