//! Cores broken on purpose are found by the laws of the target `history`, from bytes alone. `[spec: CHECK-8]`
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test fails by panicking")]

use dsr_fuzz_targets::noise::Noise;
use dsr_fuzz_targets::{on_broken_core, seeds};
use dsr_model::alarms;

/// Inputs that are made of noise if no seed finds it.
const TRIES: u64 = 3000;

/// Every seed, then noise.
fn inputs() -> impl Iterator<Item = Vec<u8>> {
    let kept = seeds::files(&seeds::folder().join("history")).unwrap();
    kept.into_iter().map(|(_, input)| input).chain((0..TRIES).map(|seed| Noise::new(seed).bytes(300)))
}

/// Each broken core breaks a law; the sound one, put in the same place, breaks none.
#[test]
fn law_every_broken_core_is_found() {
    let mut silent = Vec::new();
    for alarm in alarms::all().into_iter().filter(|alarm| !alarm.is_of_the_search()) {
        let found =
            inputs().enumerate().find_map(|(at, input)| Some((at, on_broken_core(&alarm, &input).err()?)));
        match found {
            Some((at, broken)) => println!("{:24} {} by input {at}", alarm.name, broken.clause),
            None => silent.push(alarm.name),
        }
    }
    assert_eq!(silent, [""; 0]);
}

/// The control: nothing is found where nothing is broken.
#[test]
fn law_the_sound_core_is_silent() {
    let sound = alarms::none();
    let reached = inputs().take(600).map(|input| on_broken_core(&sound, &input).unwrap().iter().count());
    assert!(reached.max().unwrap() > 10);
}
