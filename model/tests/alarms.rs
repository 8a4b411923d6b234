//! The canary: every core that is broken on purpose is found, and the sound one by nothing.

use dsr_model::alarms::{all, of_replicas, report};

/// [spec: CHECK-8]
#[test]
fn canary_every_flaw_is_found_and_the_sound_core_by_nothing() {
    let report = report(false);
    println!("{report}");
    for alarm in &report.alarms {
        println!("{:24} {:6.2} s {:?}", alarm.name, alarm.seconds, alarm.layers.last().map(|l| &l.finding));
    }
    let missed: Vec<&str> =
        report.alarms.iter().filter(|alarm| !alarm.found).map(|alarm| alarm.name).collect();
    assert!(missed.is_empty(), "not found: {missed:?}");
    for layer in report.sound.iter().chain(&report.sound_replica) {
        assert_eq!(layer.finding, None, "a false alarm");
    }
}

/// [spec: CHECK-8]
#[test]
fn law_alarms_have_names_of_their_own() {
    let mut names: Vec<&str> =
        all().iter().map(|alarm| alarm.name).chain(of_replicas().iter().map(|alarm| alarm.name)).collect();
    let count = names.len();
    assert!(count >= 15);
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}
