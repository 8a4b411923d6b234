//! What the binaries for libFuzzer share. The targets themselves are in `targets`.

/// Tries an input of the target of a name; panics at a broken law.
pub fn watch(name: &str, input: &[u8]) {
    let target = dsr_fuzz_targets::target(name).expect("each binary is named after a target");
    dsr_fuzz_targets::watch(target, input);
}
