//! A short history of two agents with every kind of mutation, and the states of all its parts.

use super::*;
use std::collections::BTreeSet;

/// Nine deltas of two agents that act partly at once.
pub(crate) fn history(agents: [u32; 2]) -> Vec<Delta> {
    let mut one = Peer::new(agents[0]);
    let mut deltas = vec![one.apply(&child(ROOT, "kitchen"))];
    let kitchen = one.view().vertex_by_name("kitchen").unwrap();
    deltas.push(one.apply(&child(kitchen, "table")));
    let table = one.view().vertex_by_name("table").unwrap();
    let mut two = one.fork(agents[1]);
    deltas.push(two.apply(&set(of(kitchen), "light", 2_i32)));
    deltas.push(two.apply(&edge(table, "near", ROOT)));
    deltas.push(two.apply(&relocate(parent(kitchen, table), parent(ROOT, table))));
    deltas.push(one.apply(&set(of(kitchen), "light", 1_i32)));
    deltas.push(one.apply(&edge(table, "near", ROOT)));
    deltas.push(one.apply(&remove(key(table, "near", ROOT))));
    let mut three = two.fork(agents[1]);
    three.state.join(&deltas[6]);
    deltas.push(three.apply(&destroy(kitchen)));
    deltas
}

/// The join of the deltas whose bits are set.
pub(crate) fn part(deltas: &[Delta], mask: usize) -> State {
    let mut state = State::new();
    for (_, delta) in deltas.iter().enumerate().filter(|(at, _)| mask >> at & 1 == 1) {
        state.join(delta);
    }
    state
}

/// The distinct states of all parts.
pub(crate) fn parts(deltas: &[Delta]) -> Vec<State> {
    (0..1 << deltas.len()).map(|mask| part(deltas, mask)).collect::<BTreeSet<_>>().into_iter().collect()
}
