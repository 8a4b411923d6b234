//! Scenarios: what scripts do, what is explored and judged, which verdicts follow, and that the alarms go off.

use dsr_core::{Dictionary, State, VertexId, view};
use dsr_model::alarms::{Broken, Flaw, Sound};
use dsr_model::checked::Checked;
use dsr_model::checked::alphabet::Alphabet;
use dsr_model::replay::replay;
use dsr_model::scenario::{
    Coverage, IdleStep, Options, PropertyKind, Report, Scenario, ScenarioStep, Trace, Verdict, shipped,
};
use dsr_model::trace::FindingKind;
use std::sync::Arc;

/// A scenario on two rooms with a robot and a person in one of them.
#[allow(clippy::unwrap_used, reason = "a test's own input is fine or the test fails")]
fn small(replicas: &str, properties: &str) -> Scenario {
    let text = format!(
        r#"{{"format": 1, "name": "small", "about": "A test.", "scene": "@empty", "dictionary": "@aal",
        "setup": [
            {{"add_vertex": {{"type": "room", "name": "hall", "link": {{"from": "world", "label": "RT"}}}}}},
            {{"add_vertex": {{"type": "room", "name": "yard", "link": {{"from": "world", "label": "RT"}}}}}},
            {{"add_vertex": {{"type": "robot", "name": "robot", "attributes": {{"level": 1}},
                "link": {{"label": "in", "to": "hall"}}}}}},
            {{"add_vertex": {{"type": "person", "name": "person", "link": {{"label": "in", "to": "hall"}}}}}}],
        "focus": ["robot", "hall", "yard"],
        "replicas": [{replicas}], "properties": [{properties}]}}"#
    );
    Scenario::read(&text, "small.json").unwrap()
}

fn run(replicas: &str, properties: &str) -> Report {
    small(replicas, properties).check(Options::default())
}

/// A property that is not asked for its verdict.
const ANY: &str =
    r#"{"name": "any", "why": "Something must be asked.", "always": {"vertex": {"name": "robot"}}}"#;

fn property(name: &str, kind: &str, predicate: &str) -> String {
    format!(r#"{{"name": "{name}", "why": "A test.", "{kind}": {predicate}}}"#)
}

fn verdicts(report: &Report) -> Vec<Verdict> {
    report.properties.iter().map(|property| property.verdict).collect()
}

fn set_level(level: i32) -> String {
    format!(r#"{{"update_attributes": {{"vertex": "robot", "attributes": {{"level": {level}}}}}}}"#)
}

fn level_is(level: i32) -> String {
    format!(r#"{{"attribute": {{"of": "robot", "name": "level", "is": {level}}}}}"#)
}

fn move_to(room: &str) -> String {
    format!(
        r#"{{"move_edge": {{"old": {{"from": "robot", "label": "in"}},
            "new": {{"from": "robot", "label": "in", "to": "{room}"}}}}}}"#
    )
}

fn script(name: &str, steps: &[String]) -> String {
    format!(r#"{{"name": "{name}", "script": [{}]}}"#, steps.join(", "))
}

fn act(mutation: &str) -> String {
    format!(r#"{{"do": {mutation}}}"#)
}

/// `[spec: SCEN-15]` `[spec: SCEN-12]` `[spec: SCEN-8]` `[spec: CHECK-14]`
#[test]
fn law_shipped_scenarios_hold() {
    let names =
        ["bed", "fall", "carrying", "action protocol", "two parents", "cycle", "removal against updates"];
    let names = names.into_iter().chain(["concurrent move", "orphaned child", "duplicate name"]);
    let (mut found, mut reduced) = (Vec::new(), Vec::new());
    for (file, text) in shipped() {
        let scenario = Scenario::read(text, file).unwrap();
        let report = scenario.check(Options::default());
        assert!(report.is_as_expected(), "{file}: {report:#?}");
        assert_eq!(report.coverage, Coverage::EverySubset, "{file}");
        for property in &report.properties {
            let is_universal = matches!(property.kind, PropertyKind::Always | PropertyKind::AtEnd);
            let expected = if is_universal { Verdict::Holds } else { Verdict::Witnessed };
            assert_eq!(property.verdict, expected, "{file}: {}", property.name);
            assert_eq!(property.trace.is_some(), !is_universal, "{file}: {}", property.name);
            let left_out = property.trace.as_ref().map_or(0, |trace| trace.left_out);
            reduced.extend((left_out > 0).then(|| (property.name.clone(), left_out)));
        }
        let file_stem = file.trim_end_matches(".json").replace('-', " ");
        assert_eq!(report.name, file_stem);
        found.push(report.name);
    }
    assert_eq!(found, names.map(str::to_owned).collect::<Vec<_>>());
    // The search finds the fewest mutations; here it delivered one of them to somebody who need not see it.
    let needless = ["it can finish", "it can be aborted"];
    assert_eq!(reduced, needless.map(|name| (name.to_owned(), 1)));
}

/// The papers' cases run on the flat. `[spec: SCEN-2]`
#[test]
fn law_the_papers_cases_run_on_the_flat() {
    for (file, text) in &shipped()[..4] {
        let scenario = Scenario::read(text, file).unwrap();
        let dictionary = Dictionary::aal();
        let graph = view(scenario.initial(), &dictionary);
        for name in ["bed_radar", "dining-kitchen", "docking_station", "bathroom_pir", "walker"] {
            assert!(graph.vertex_by_name(name).is_some(), "{file}: {name}");
        }
        assert!(graph.repairs().is_empty());
    }
}

/// A guard is waited for, in the replica's own view. `[spec: SCEN-4]` `[spec: SCEN-9]`
#[test]
fn law_a_guard_waits() {
    let first = script("first", &[act(&set_level(2)), act(&set_level(3))]);
    let guarded = format!(r#"{{"when": {}, "do": {}}}"#, level_is(2), move_to("yard"));
    let second = script("second", &[guarded]);
    let properties = [
        property(
            "no move before",
            "always",
            &format!(
                r#"{{"if": {{"all": [{}, {{"count": {{"writes": {{"of": "robot", "name": "level"}}, "exactly": 1}}}}]}},
                "then": {{"edge": {{"from": "robot", "label": "in", "to": "hall"}}}}}}"#,
                level_is(1)
            ),
        ),
        property("it may move", "sometimes_at_end", r#"{"done": "second"}"#),
        property("it may miss the moment", "sometimes_at_end", r#"{"not": {"done": "second"}}"#),
    ];
    let report = run(&[first, second].join(", "), &properties.join(", "));
    // The first is false: a reader can receive the move and neither level.
    assert_eq!(verdicts(&report), [Verdict::Violated, Verdict::Witnessed, Verdict::Witnessed]);
    assert!(report.complete && report.idle.is_empty());
}

/// The verdict on `at_end` of one script alone.
#[track_caller]
fn check_alone(steps: &[String], at_end: &str) {
    let report = run(&script("alone", steps), &property("end", "at_end", at_end));
    assert_eq!(verdicts(&report), [Verdict::Holds], "{report:#?}");
}

/// `[spec: SCEN-4.1]`
#[test]
fn law_a_step_that_cannot_be_taken_waits_is_skipped_or_stops() {
    let (never, last) = (level_is(9), act(&set_level(5)));
    for (otherwise, level, done) in [("wait", 1, false), ("skip", 5, true), ("stop", 1, false)] {
        let done = if done { r#"{"done": "alone"}"# } else { r#"{"not": {"done": "alone"}}"# };
        let end = format!(r#"{{"all": [{}, {done}]}}"#, level_is(level));
        let guarded = format!(r#"{{"when": {never}, "do": {}, "else": "{otherwise}"}}"#, move_to("yard"));
        check_alone(&[guarded, last.clone()], &end);
        let refused =
            format!(r#"{{"do": {{"remove_vertex": {{"vertex": "hall"}}}}, "refused": "{otherwise}"}}"#);
        check_alone(&[refused, last.clone()], &end);
        // Left out, `refused` is as `else`.
        let refused =
            format!(r#"{{"do": {{"remove_vertex": {{"vertex": "hall"}}}}, "else": "{otherwise}"}}"#);
        check_alone(&[refused, last.clone()], &end);
    }
    // Left out, both are "wait".
    check_alone(
        &[format!(r#"{{"when": {never}, "do": {}}}"#, move_to("yard")), last],
        r#"{"not": {"done": "alone"}}"#,
    );
}

/// `[spec: SCEN-4]`
#[test]
fn law_a_step_is_repeated_and_may_only_wait() {
    let step =
        format!(r#"{{"when": {{"vertex": {{"name": "robot"}}}}, "do": {}, "repeat": 3}}"#, set_level(4));
    let report = run(&script("alone", &[step]), ANY);
    assert_eq!((report.mutations, report.histories, report.states), (3, 4, 8));
    let only_waits = format!(r#"{{"when": {}}}"#, level_is(1));
    check_alone(
        &[only_waits, act(&set_level(5))],
        &format!(r#"{{"all": [{}, {{"done": "alone"}}]}}"#, level_is(5)),
    );
}

/// `[spec: SCEN-5]`
#[test]
fn law_a_group_is_one_delta_or_nothing() {
    let group = format!(r#"{{"do": [{}, {}]}}"#, set_level(2), move_to("yard"));
    let together = format!(
        r#"{{"if": {}, "then": {{"edge": {{"from": "robot", "label": "in", "to": "yard"}}}}}}"#,
        level_is(2)
    );
    let report = run(&script("alone", &[group]), &property("together", "always", &together));
    assert_eq!((verdicts(&report), report.states), (vec![Verdict::Holds], 2));
    let refused = format!(
        r#"{{"do": [{}, {{"remove_vertex": {{"vertex": "hall"}}}}], "refused": "skip"}}"#,
        set_level(2)
    );
    check_alone(&[refused], &level_is(1));
    // A member sees what the one before did.
    let chain = r#"{"do": [
        {"add_vertex": {"type": "cup", "name": "cup", "link": {"from": "hall", "label": "RT"}}},
        {"add_edge": {"from": "cup", "label": "in", "to": "yard"}}, {"remove_vertex": {"vertex": "cup"}}]}"#;
    check_alone(&[chain.into()], r#"{"all": [{"done": "alone"}, {"not": {"vertex": {"name": "cup"}}}]}"#);
}

/// Patterns must match one edge. `[spec: SCEN-3]`
#[test]
fn law_a_pattern_matches_exactly_one_edge() {
    let ambiguous = r#"{"do": {"remove_edge": {"label": "in", "to": "hall"}}, "refused": "stop"}"#.to_owned();
    check_alone(&[ambiguous], r#"{"not": {"done": "alone"}}"#);
    let none = r#"{"do": {"update_attributes": {"edge": {"from": "robot", "label": "with"}, "attributes": {"level": 1}}},
        "refused": "stop"}"#.to_owned();
    check_alone(&[none], r#"{"not": {"done": "alone"}}"#);
    let one = r#"{"do": {"update_attributes": {"edge": {"from": "robot", "label": "in"}, "attributes": {"level": 7}}}}"#;
    let end = r#"{"attribute": {"of": {"from": "robot", "label": "in"}, "name": "level", "is": 7}}"#;
    check_alone(&[one.into()], end);
}

/// Each predicate, on a graph that nothing changes. `[spec: SCEN-7]`
#[test]
fn law_predicates_mean_what_they_say() {
    for (predicate, expected) in [
        (r#"{"vertex": {"name": "robot", "type": "robot"}}"#, true),
        (r#"{"vertex": {"name": "robot", "type": "person"}}"#, false),
        (r#"{"vertex": {"name": "world"}}"#, true),
        (r#"{"edge": {"from": "robot"}}"#, true),
        (r#"{"edge": {"label": "in", "to": "yard"}}"#, false),
        (r#"{"attribute": {"of": "robot", "name": "level", "is": {"type": "int", "value": 1}}}"#, true),
        (r#"{"attribute": {"of": "robot", "name": "level", "at_least": 1}}"#, true),
        (r#"{"attribute": {"of": "robot", "name": "level", "at_most": 0.5}}"#, false),
        (r#"{"attribute": {"of": "person", "name": "level", "at_most": 5}}"#, false),
        (r#"{"attribute": {"of": "person", "name": "level", "present": false}}"#, true),
        (
            r#"{"attribute": {"of": {"from": "robot", "label": "in"}, "name": "level", "present": true}}"#,
            false,
        ),
        (r#"{"count": {"edges": {"label": "in"}, "exactly": 2}}"#, true),
        (r#"{"count": {"vertices": {"type": "room"}, "at_least": 3}}"#, false),
        (r#"{"count": {"vertices": {}, "at_most": 5}}"#, true),
        (r#"{"count": {"writes": {"of": "robot", "name": "level"}, "exactly": 1}}"#, true),
        (r#"{"count": {"repairs": "any", "exactly": 0}}"#, true),
        (r#"{"placement": {"of": "hall", "is": "child", "parent": "world"}}"#, true),
        (r#"{"placement": {"of": "hall", "is": "child", "parent": "yard"}}"#, false),
        (r#"{"placement": {"of": "robot", "is": "outside"}}"#, true),
        (r#"{"placement": {"of": "world", "is": "root"}}"#, true),
        (r#"{"placement": {"of": "robot", "is": "absent"}}"#, false),
        (r#"{"repair": "detached"}"#, false),
        (r#"{"not": {"repair": "any"}}"#, true),
        (r#"{"all": [{"edge": {}}, {"repair": "any"}]}"#, false),
        (r#"{"any": [{"edge": {}}, {"repair": "any"}]}"#, true),
        (r#"{"if": {"repair": "any"}, "then": {"edge": {"label": "with"}}}"#, true),
        (r#"{"if": {"edge": {}}, "then": {"edge": {"label": "with"}}}"#, false),
    ] {
        let waiting = format!(r#"{{"when": {}}}"#, level_is(9));
        let report = run(&script("idle", &[waiting]), &property("it", "always", predicate));
        let verdict = if expected { Verdict::Holds } else { Verdict::Violated };
        assert_eq!(verdicts(&report), [verdict], "{predicate}");
    }
}

/// `[spec: SCEN-6]`
#[test]
fn law_a_free_replica_does_anything_within_its_alphabet() {
    let free = r#"{"name": "free", "alphabet": ["update_attributes", "move_edge"], "budget": 2}"#;
    let properties = [
        property("may rest", "sometimes_at_end", &level_is(1)),
        property(
            "may move",
            "sometimes",
            r#"{"not": {"edge": {"from": "robot", "label": "in", "to": "hall"}}}"#,
        ),
        property(
            "never touches the person",
            "always",
            r#"{"edge": {"from": "person", "label": "in", "to": "hall"}}"#,
        ),
        property("is always done", "at_end", r#"{"done": "free"}"#),
    ];
    let report = run(free, &properties.join(", "));
    let expected = [Verdict::Witnessed, Verdict::Witnessed, Verdict::Holds, Verdict::Holds];
    assert_eq!(verdicts(&report), expected, "{report:#?}");
    assert!(report.is_as_expected() && report.states > 10);
}

/// The bed as two mutations: the false alarm that the shipped scenario avoids by a group. Two mutations are
/// needed, and two are told. `[spec: SCEN-13]` `[spec: SCEN-8]`
#[test]
fn law_a_false_property_yields_a_shortest_counterexample() {
    let (file, text) = shipped()[0];
    let from = text.find(r#""do": ["#).unwrap();
    let to = text.find(r#"{"do": ["#).unwrap();
    let split = text[from..to]
        .replacen(r#""do": ["#, r#""do": "#, 1)
        .replacen("}}},\n", "}}}},\n{\"do\": ", 1)
        .replacen("}}}]}", "}}}}", 1);
    let text = text.replace(&text[from..to], &split);
    let report = Scenario::read(&text, file).unwrap().check(Options::default());
    let violated: Vec<_> = report.properties.iter().filter(|it| it.verdict == Verdict::Violated).collect();
    assert_eq!(violated.iter().map(|it| it.name.as_str()).collect::<Vec<_>>(), ["no false alarm"]);
    let trace = violated[0].trace.as_ref().unwrap();
    assert_eq!(trace.mutations, 2);
    let lines: Vec<String> = trace.to_string().lines().map(str::trim_end).map(str::to_owned).collect();
    assert_eq!(
        lines[..4],
        [
            "  1. person agent: move_edge person -in-> * to person -in-> bed (delta 1)",
            "  2. person agent: update_attributes person lying=true posture=\"lying\" (delta 2)",
            "  3. mqtt agent receives delta 2",
            "  4. mqtt agent sees",
        ]
    );
    assert!(
        lines[4..].iter().any(|line| line.contains("person.lying = ") && line.contains("true")),
        "{lines:#?}"
    );
    let run = trace.run.as_ref().unwrap();
    assert_eq!((run.finding.kind, run.finding.clause.as_str()), (FindingKind::Fails, "no false alarm"));
    assert_eq!(run.finding.replicas, ["mqtt agent"]);
}

/// What shipped scenarios see is recorded as every layer records runs, and happens again.
/// `[spec: TRACE-1]` `[spec: TRACE-6]` `[spec: SCEN-13]`
#[test]
fn law_every_witness_is_a_trace_that_replays() {
    let mut replayed = 0;
    for (file, text) in shipped() {
        let report = Scenario::read(text, file).unwrap().check(Options::default());
        for property in report.properties.iter().filter(|property| property.verdict == Verdict::Witnessed) {
            let run = property.trace.as_ref().and_then(|trace| trace.run.as_ref());
            let run = run.unwrap_or_else(|| panic!("{file}: {} is not recorded", property.name));
            assert_eq!((run.finding.kind, &run.finding.clause), (FindingKind::Seen, &property.name));
            assert!(run.replicas.iter().all(|replica| {
                replica.name != "a reader" || run.steps.iter().any(|step| step.replica == replica.name)
            }));
            let again = replay(run).unwrap_or_else(|error| panic!("{file}: {error}\n{run}"));
            assert!(again.steps == run.steps.len() && again.judged.is_err());
            replayed += 1;
        }
    }
    assert!(replayed > 10, "{replayed}");
}

/// What never happens is reported, and so is a step that is never taken. `[spec: SCEN-12]` `[spec: SCEN-8]`
#[test]
fn law_what_never_happens_is_a_finding() {
    let step = format!(r#"{{"when": {}, "do": {}}}"#, level_is(9), move_to("yard"));
    let never =
        [property("never", "sometimes", &level_is(9)), property("nor", "sometimes_at_end", &level_is(9))];
    let report = run(&script("alone", &[act(&set_level(2)), step]), &never.join(", "));
    assert_eq!(verdicts(&report), [Verdict::NotWitnessed, Verdict::NotWitnessed]);
    assert_eq!(report.idle, [IdleStep { replica: "alone".into(), step: 1 }]);
    assert!(report.complete && !report.is_as_expected());
    assert!(report.properties.iter().all(|property| property.trace.is_none()));
}

/// Two concurrent writers and one that waits for both: traces tell who received what. `[spec: SCEN-13]`
#[test]
fn law_a_trace_tells_deliveries_and_mutations() {
    let both = r#"{"count": {"writes": {"of": "robot", "name": "level"}, "exactly": 2}}"#;
    let settle = format!(r#"{{"when": {both}, "do": {}}}"#, set_level(4));
    let replicas = [
        script("one", &[act(&set_level(2))]),
        script("two", &[act(&set_level(3))]),
        script("three", &[settle]),
    ];
    let report = run(&replicas.join(", "), &property("settled", "sometimes_at_end", &level_is(4)));
    let trace: &Trace = report.properties[0].trace.as_ref().unwrap();
    let text: Vec<String> = trace.steps.iter().map(ToString::to_string).collect();
    assert_eq!(trace.mutations, 3);
    assert_eq!(
        text[2..4],
        ["three receives deltas 1, 2", "three: update_attributes robot level=4 (delta 3)"]
    );
    assert!(matches!(trace.steps.last(), Some(ScenarioStep::See { replica, .. }) if replica == "everybody"));
    let json = serde_json::to_value(trace).unwrap();
    assert_eq!(
        json["steps"][2],
        serde_json::json!({"step": "receive", "replica": "three", "deltas": [1, 2]})
    );
    let mutation: dsr_core::Mutation =
        serde_json::from_value(json["steps"][3]["mutations"][0].clone()).unwrap();
    assert_eq!(mutation.kind().name(), "update_attributes");
    assert!(serde_json::from_value::<State>(json["steps"][3]["delta"].clone()).is_ok());
}

/// Following the least deliveries only loses nothing: the same states, ends and verdicts. `[spec: SCEN-10]`
#[test]
fn differential_least_deliveries_lose_nothing() {
    let mixed = [
        script("one", &[act(&set_level(2)), act(&move_to("yard")), act(&set_level(3))]),
        script(
            "two",
            &[
                act(&set_level(4)),
                format!(r#"{{"when": {}, "do": {}, "else": "skip"}}"#, level_is(2), move_to("yard")),
            ],
        ),
        r#"{"name": "free", "alphabet": ["remove_edge", "update_attributes"], "budget": 1}"#.into(),
    ];
    let mixed = small(
        &mixed.join(", "),
        &property("in a room", "always", r#"{"edge": {"from": "robot", "label": "in"}}"#),
    );
    let classics = shipped()[4..].iter().filter(|(file, _)| !file.starts_with("removal"));
    let classics = classics.map(|(file, text)| Scenario::read(text, file).unwrap());
    for scenario in classics.chain([mixed]) {
        let options = Options { traces: false, ..Options::default() };
        let least = scenario.check(options);
        let every = scenario.check(Options { every_delivery: true, ..options });
        let name = scenario.name();
        assert!(least.complete && every.complete, "{name}");
        assert_eq!(verdicts(&least), verdicts(&every), "{name}");
        assert_eq!((least.states, &least.repairs), (every.states, &every.repairs), "{name}");
        assert!(least.histories <= every.histories, "{name}");
    }
}

/// A limit that is met is said, and decides nothing. `[spec: SCEN-12]`
#[test]
fn law_a_limit_makes_no_verdict() {
    let scenario = Scenario::read(shipped()[0].1, "bed.json").unwrap();
    for options in
        [Options { states_max: 20, ..Options::default() }, Options { histories_max: 5, ..Options::default() }]
    {
        let report = scenario.check(options);
        assert!(!report.complete && !report.is_as_expected());
        assert_eq!(report.properties[0].verdict, Verdict::Undecided);
        assert!(report.properties.iter().all(|property| property.verdict != Verdict::Holds));
    }
}

/// Histories with too many deltas for all subsets are told apart. `[spec: SCEN-11]`
#[test]
fn law_large_histories_are_judged_where_replicas_get() {
    let stream = format!(r#"{{"do": {}, "repeat": 8}}"#, set_level(2));
    let report = run(&script("alone", &[stream.clone(), stream]), ANY);
    assert_eq!(report.coverage, Coverage::ReachedOnly { histories: 1 });
    assert!(report.complete);
    assert_eq!((report.histories, report.states), (17, 17));
}

/// A merge that keeps what the other side has removed, if it came from the left.
#[derive(Debug)]
struct LeftStays;

impl Flaw for LeftStays {
    fn merge(&self, left: &State, right: &State) -> State {
        let mut merged = left.clone();
        merged.merge(right);
        let records = left.records().chain(merged.records()).map(|(dot, record)| (dot, record.clone()));
        State::assemble(records, merged.context().clone())
    }
}

fn checked(scenario: &Scenario) -> Checked {
    Checked {
        dictionary: scenario.dictionary().clone(),
        initial: scenario.initial().clone(),
        alphabet: Alphabet::of(&[], Vec::<VertexId>::new()),
    }
}

/// The alarm: a broken core is found, and the sound one behind the same wrapper is not.
/// `[spec: SCEN-11]`
#[test]
fn law_a_broken_core_is_found() {
    let scenario = Scenario::read(shipped()[4].1, "two-parents.json").unwrap();
    let sound = Broken::new("sound", checked(&scenario), Arc::new(Sound));
    assert!(scenario.check_under(sound, Options::default()).is_as_expected());
    let broken = Broken::new("left stays", checked(&scenario), Arc::new(LeftStays));
    let report = scenario.check_under(broken, Options::default());
    let breach = report.breach.expect("a broken merge must be found");
    assert!(!report.complete);
    let trace = breach.trace.unwrap();
    assert!(matches!(trace.steps.last(), Some(ScenarioStep::Break { .. })), "{trace}");
}
