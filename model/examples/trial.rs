//! Trial.
use dsr_core::scene::{FLAT, Scene, Strictness};
use dsr_core::*;
use dsr_model::histories::*;
use dsr_model::progress::*;
use dsr_model::suite::*;
use std::sync::Arc;
#[global_allocator]
static A: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let focus: usize = args[1].parse().unwrap();
    let replicas: usize = args[2].parse().unwrap();
    let mutations: usize = args[3].parse().unwrap();
    let kinds: Vec<MutationKind> = args[5..].iter().map(|n| MutationKind::from_name(n).unwrap()).collect();
    let kinds = if kinds.is_empty() { MutationKind::ALL.to_vec() } else { kinds };
    let dictionary = Dictionary::aal();
    let scene = Scene::read(FLAT, &dictionary, Strictness::Strict).unwrap().scene;
    let subject = Subject { state: &scene.state, dictionary: &dictionary, names: &FLAT_FOCUS };
    let make = if args[4].contains('l') { Subject::at_last } else { Subject::histories };
    let mut run =
        make(&subject, focus, Bound { replicas, mutations }, &kinds, args[4].contains('2')).unwrap();
    run.symmetry = args[4].starts_with("sym");
    let progress = Arc::new(Progress::new(Limits::default()));
    let r = run.run(&progress);
    println!(
        "{} f{} ops {} {} {:?} {:.2}s {:?} unseen {:?} {:?}",
        r.name,
        r.focus,
        r.operations,
        r.verdict,
        r.states,
        r.seconds,
        r.second_engine.map(|s| (s.unique, s.generated)),
        r.properties
            .iter()
            .filter(|p| p.verdict == dsr_model::verdict::Verdict::Vacuous)
            .map(|p| &p.clause)
            .collect::<Vec<_>>(),
        r.notes
    );
    for t in r.traces {
        println!("{}", t.text);
    }
}
