// 15. a joiner drops a write together with an older one: the same schedule
// A test of a crate that depends on `dsr-core` (features `std` and `serde`) and on `serde_json`.

use dsr_core::{
    Author, Delta, Dictionary, EdgeId, Mutation, ReplicaId, State, VertexId, delta_for, digest, view,
};
use std::collections::BTreeSet;

#[test]
fn replays_join_5_15_a_joiner_drops_a_write_together_with_an_older() {
    let mut agent_1 = Replica::new(1, r#"{"context":{"r1":"1-3"},"store":{"r1.1":{"vertex":{"name":"k","stamp":1,"type":"thing"}},"r1.2":{"edge":{"from":"root","label":"RT","stamp":1,"to":"r1.1"}},"r1.3":{"write":{"name":"x","stamp":1,"target":"r1.1","timestamp_ns":"0","value":{"type":"int","value":1}}}}}"#);
    let mut agent_2 = Replica::new(2, r#"{"context":{"r1":"1-3"},"store":{"r1.1":{"vertex":{"name":"k","stamp":1,"type":"thing"}},"r1.2":{"edge":{"from":"root","label":"RT","stamp":1,"to":"r1.1"}},"r1.3":{"write":{"name":"x","stamp":1,"target":"r1.1","timestamp_ns":"0","value":{"type":"int","value":1}}}}}"#);
    let mut agent_3 = Replica::new(3, r#"{"context":{},"store":{}}"#);
    // 1. agent 1: update_attributes k x=2  → m1
    let m1 = agent_1.mutate(&[r#"{"update_attributes":{"attributes":{"x":{"type":"int","value":2}},"vertex":"r1.1"}}"#], &[
        "- r1.1.x = 1",
        "+ r1.1.x = 2",
    ]);
    // 2. agent 2: receives m1
    agent_2.receive(&m1, &[
        "- r1.1.x = 1",
        "+ r1.1.x = 2",
    ]);
    // 3. agent 3: receives m1
    agent_3.receive(&m1, &[]);
    // 4. agent 2: sends agent 3 what it lacks  → m2
    let m2 = agent_2.answer(&agent_3);
    // 5. agent 1: update_attributes k x=3  → m3
    let m3 = agent_1.mutate(&[r#"{"update_attributes":{"attributes":{"x":{"type":"int","value":3}},"vertex":"r1.1"}}"#], &[
        "- r1.1.x = 2",
        "+ r1.1.x = 3",
    ]);
    // 6. agent 2: receives m3
    agent_2.receive(&m3, &[
        "- r1.1.x = 2",
        "+ r1.1.x = 3",
    ]);
    // 7. agent 3: receives m3
    agent_3.receive(&m3, &[]);
    // 8. agent 3: receives m2
    agent_3.receive(&m2, &[
        "+ edge r1.2 root -RT-> r1.1",
        "+ r1.1.x = 3",
        "+ vertex r1.1 k (thing)",
    ]);
    // ✓ [JOIN-5] all replicas are equal, and every view is sound
    assert_eq!(agent_1.state, agent_2.state);
    assert_eq!(agent_1.state, agent_3.state);
}

const DICTIONARY: &str = r#"{"attributes":{},"closed":false,"edge_labels":[],"functional_labels":[],"vertex_types":[]}"#;

/// A replica, and what it shows.
#[allow(dead_code, reason = "not every trace has every kind of step")]
struct Replica {
    author: Author,
    start: State,
    state: State,
    dictionary: Dictionary,
}

#[allow(dead_code, reason = "not every trace has every kind of step")]
impl Replica {
    fn new(agent: u32, state: &str) -> Self {
        let state: State = serde_json::from_str(state).expect("a state");
        let dictionary = serde_json::from_str(DICTIONARY).expect("a dictionary");
        let author = Author::new(ReplicaId { agent, incarnation: 0 });
        Self { author, start: state.clone(), state, dictionary }
    }

    /// Makes mutations one after the other; what is broadcast.
    fn mutate(&mut self, mutations: &[&str], changes: &[&str]) -> Delta {
        let before = self.facts();
        let mut whole = Delta::new();
        for mutation in mutations {
            let mutation: Mutation = serde_json::from_str(mutation).expect("a mutation");
            let delta = mutation.delta(&view(&self.state, &self.dictionary), self.author).expect("it is allowed");
            self.state.join(&delta);
            whole.join(&delta);
        }
        self.changed(&before, changes);
        whole
    }

    /// A message arrives.
    fn receive(&mut self, delta: &Delta, changes: &[&str]) {
        let before = self.facts();
        self.state.join(delta);
        self.changed(&before, changes);
    }

    /// What another replica, by its digest, is missing.
    fn answer(&self, to: &Self) -> Delta {
        delta_for(&self.state, &digest(&to.state))
    }

    /// Stops, and starts again under the next incarnation.
    fn restart(&mut self, keeps: bool, changes: &[&str]) {
        let before = self.facts();
        self.author.replica.incarnation += 1;
        if !keeps {
            self.state = self.start.clone();
        }
        self.changed(&before, changes);
    }

    /// What is shown, a line for each fact.
    fn facts(&self) -> BTreeSet<String> {
        let view = view(&self.state, &self.dictionary);
        let vertices = view.vertices().iter().map(|&id| match view.vertex(id) {
            Some(vertex) => format!("vertex {id} {} ({})", vertex.name, vertex.vertex_type),
            None => format!("vertex {id} root (root)"),
        });
        let edges = view.edges().iter().map(|shown| format!("edge {} {}", shown.id, shown.edge.key()));
        let of = |id: VertexId| view.attributes_of(id).map(move |(_, write)| (id.to_string(), write));
        let on = |id: EdgeId| view.attributes_of(id).map(move |(_, write)| (id.to_string(), write));
        let attributes = view.vertices().iter().flat_map(|&id| of(id));
        let attributes = attributes.chain(view.edges().iter().flat_map(|shown| on(shown.id)));
        let attributes = attributes.map(|(id, write)| format!("{id}.{} = {}", write.name, write.value));
        let repairs = view.repairs().iter().map(|repair| format!("repair: {repair}"));
        vertices.chain(edges).chain(attributes).chain(repairs).collect()
    }

    #[track_caller]
    fn changed(&self, before: &BTreeSet<String>, changes: &[&str]) {
        let after = self.facts();
        let gone = before.difference(&after).map(|fact| format!("- {fact}"));
        let come = after.difference(before).map(|fact| format!("+ {fact}"));
        let mut found: Vec<String> = gone.chain(come).collect();
        found.sort();
        let mut written = changes.to_vec();
        written.sort();
        assert_eq!(found, written);
    }
}
