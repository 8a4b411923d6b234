#![no_main]

libfuzzer_sys::fuzz_target!(|input: &[u8]| dsr_fuzz::watch("json_dictionary", input));
