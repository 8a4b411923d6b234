//! The scenarios that ship with the checker. `[spec: SCEN-15]`

/// The shipped scenarios: file name and text, the papers' cases first. `[spec: SCEN-15]`
pub fn shipped() -> &'static [(&'static str, &'static str)] {
    &[
        ("bed.json", include_str!("../../data/scenarios/bed.json")),
        ("fall.json", include_str!("../../data/scenarios/fall.json")),
        ("carrying.json", include_str!("../../data/scenarios/carrying.json")),
        ("action-protocol.json", include_str!("../../data/scenarios/action-protocol.json")),
        ("two-parents.json", include_str!("../../data/scenarios/two-parents.json")),
        ("cycle.json", include_str!("../../data/scenarios/cycle.json")),
        ("removal-against-updates.json", include_str!("../../data/scenarios/removal-against-updates.json")),
        ("concurrent-move.json", include_str!("../../data/scenarios/concurrent-move.json")),
        ("orphaned-child.json", include_str!("../../data/scenarios/orphaned-child.json")),
        ("duplicate-name.json", include_str!("../../data/scenarios/duplicate-name.json")),
    ]
}
