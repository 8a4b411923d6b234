//! Alarms: cores broken on purpose, and which layer finds each. `[spec: CHECK-8]`
//!
//! A checker that finds nothing may be blind. Each alarm is `dsr-core` with one flaw, or the search with one,
//! behind the same traits, under the same clauses and with the reductions that ship; none is told what is
//! broken. Every one must be found, and the sound core by no layer. Alarms of fast replicas run beside the sound
//! reference, and are to be told from it.

mod authors;
mod broken;
mod flawed;
mod joins;
mod parts;
mod replica_alarm;
mod replicas;
mod report;
mod resync;
mod run;
mod shapes;
mod shown;
mod subject;
mod views;

pub use broken::{Broken, Flaw, Sound};
pub use flawed::{Flawed, ReplicaFlaw};
pub use replica_alarm::ReplicaAlarm;
pub use report::{AlarmReport, Report, report};
pub use run::{Finding, LayerReport, run_alarm, run_sound, run_sound_replica};
pub use shown::Shown;
pub use subject::{A, B, subject};

use crate::checked::Checked;
use dsr_core::{MutationKind, VertexId};
use std::sync::Arc;

/// A core broken on purpose.
#[derive(Clone, Debug)]
pub struct Alarm {
    /// Its name.
    pub name: &'static str,
    /// What is broken, in a sentence.
    pub broken: &'static str,
    /// The clause that it offends, at its root. What a layer reports may be a consequence.
    pub clause: &'static str,
    flaw: Arc<dyn Flaw>,
}

impl Alarm {
    /// What is done wrongly.
    pub fn flaw(&self) -> &dyn Flaw {
        &*self.flaw
    }

    /// Whether the search is broken, and the core is sound.
    pub fn is_of_the_search(&self) -> bool {
        self.clause == "CHECK-11"
    }

    /// The core broken so.
    pub fn on(&self, core: Checked) -> Broken {
        Broken::new(self.name, core, self.flaw.clone())
    }

    /// The broken core with some kinds of mutation on some vertices of [`subject`].
    pub fn core(&self, kinds: &[MutationKind], focus: &[VertexId]) -> Broken {
        self.on(subject(kinds, focus))
    }
}

fn alarm(name: &'static str, clause: &'static str, broken: &'static str, flaw: impl Flaw + 'static) -> Alarm {
    Alarm { name, broken, clause, flaw: Arc::new(flaw) }
}

/// No alarm: the sound core where a broken one is expected, to show that what is found is due to the flaw.
pub fn none() -> Alarm {
    alarm("none", "", "nothing is broken", Sound)
}

/// Every alarm.
pub fn all() -> Vec<Alarm> {
    [of_joins(), of_authors(), of_resynchronisation(), of_views(), of_shapes()].concat()
}

fn of_joins() -> Vec<Alarm> {
    use joins::{
        Counting, DroppedLosers, DroppedPending, FirstArrival, ForgottenContext, GapsTakenAsSeen,
        LastDelivered, LocalCycleOrder, NoClosure, Resurrection, RevivingUpdate, ShallowClosure,
    };
    vec![
        alarm(
            "forgotten-context-dot",
            "JOIN-1",
            "a removal is forgotten where its record never was",
            ForgottenContext,
        ),
        alarm("resurrection", "STATE-3", "a record is taken in though its dot is dead", Resurrection),
        alarm(
            "gaps-taken-as-seen",
            "CTX-1",
            "contexts are bare version vectors: a gap counts as seen",
            GapsTakenAsSeen,
        ),
        alarm("closure-skipped", "CLOSE-1", "nothing dies with its anchor", NoClosure),
        alarm("closure-one-level", "CLOSE-3", "closure makes one pass and stops", ShallowClosure),
        alarm("join-counts", "JOIN-3", "a record that is delivered again gains a stamp", Counting),
        alarm("last-delivered-wins", "JOIN-5", "the write delivered last replaces the others", LastDelivered),
        alarm(
            "tie-by-arrival",
            "STAMP-2",
            "of two claims with one stamp the first to arrive stays",
            FirstArrival,
        ),
        alarm(
            "cycle-by-local-order",
            "VIEW-3",
            "a kinematic edge is refused where it would close a cycle",
            LocalCycleOrder,
        ),
        alarm("update-revives", "STATE-3", "an update brings back the vertex that it is on", RevivingUpdate),
        alarm("pending-dropped", "CLOSE-4", "what arrives before its anchors is thrown away", DroppedPending),
        alarm(
            "losers-dropped",
            "VIEW-1",
            "the loser of a conflict is thrown away where it is seen",
            DroppedLosers,
        ),
    ]
}

fn of_authors() -> Vec<Alarm> {
    use authors::{
        FullContext, KillsUnseen, LinkApart, LosersKept, MoveCopies, RefusalConsumes, ReusedDot,
        StampNotAdvanced, StrandingRemoval, UpdateKeepsOld,
    };
    vec![
        alarm(
            "full-causal-context",
            "MUT-0.1",
            "a delta covers everything that its author ever did",
            FullContext,
        ),
        alarm(
            "kill-unobserved",
            "MUT-0.1",
            "a removal kills the next event of the same author, unseen",
            KillsUnseen,
        ),
        alarm(
            "stamp-not-advanced",
            "STAMP-1",
            "a stamp is one above the author's own, not above all held",
            StampNotAdvanced,
        ),
        alarm("reused-dot", "ID-3", "after a restart without its counter a replica keeps its id", ReusedDot),
        alarm("losers-kept", "MUT-4", "removing an edge leaves the claims that it hides", LosersKept),
        alarm(
            "stranding-removal",
            "MUT-4.2",
            "an edge is removed though somebody loses the way to the root",
            StrandingRemoval,
        ),
        alarm("refusal-consumes", "MUT-0", "a refused mutation uses up a dot", RefusalConsumes),
        alarm("update-keeps-old", "MUT-3", "an update leaves the writes that it replaces", UpdateKeepsOld),
        alarm("move-copies", "MUT-5", "a moved edge stays where it was as well", MoveCopies),
        alarm(
            "link-apart",
            "MUT-1.1",
            "a new vertex and its link are two messages, one of them lost",
            LinkApart,
        ),
    ]
}

fn of_resynchronisation() -> Vec<Alarm> {
    use resync::{ContextDigest, SendsTheView};
    vec![
        alarm(
            "digest-by-context",
            "SYNC-2",
            "who has seen the same dots is taken to hold the same",
            ContextDigest,
        ),
        alarm("resync-sends-view", "SYNC-3", "claims that the view hides are not sent", SendsTheView),
    ]
}

fn of_views() -> Vec<Alarm> {
    use views::{
        FirstWrite, FunctionalNotRepaired, NewestName, NoCycleCheck, NotReattached, OwnClaimWins,
        PendingShown,
    };
    vec![
        alarm(
            "no-cycle-check",
            "VIEW-3",
            "kinematic claims are shown without looking for cycles",
            NoCycleCheck,
        ),
        alarm("newest-name", "VIEW-7", "a name that two vertices have finds the newer", NewestName),
        alarm(
            "functional-not-repaired",
            "VIEW-6",
            "all claims under a functional label are shown",
            FunctionalNotRepaired,
        ),
        alarm("own-claim-wins", "VIEW-1", "each replica shows its own claim", OwnClaimWins),
        alarm("pending-shown", "CLOSE-4", "edges are shown before their ends have arrived", PendingShown),
        alarm("not-reattached", "VIEW-5", "what lost its way to the root is left in the air", NotReattached),
        alarm("first-write", "VIEW-8", "of several live writes the first dot is shown", FirstWrite),
    ]
}

fn of_shapes() -> Vec<Alarm> {
    use shapes::{EntanglementUntold, OrderUntold, RanksUntold};
    vec![
        alarm(
            "ranks-untold",
            "CHECK-11",
            "the search judges sets as one whose claims rank differently",
            RanksUntold,
        ),
        alarm(
            "entanglement-untold",
            "CHECK-11",
            "the search forgets that claims on two registers can decide about each other",
            EntanglementUntold,
        ),
        alarm(
            "order-untold",
            "CHECK-11",
            "the search takes it that no rank ever decides anything",
            OrderUntold,
        ),
    ]
}

/// Every alarm of a fast replica.
pub fn of_replicas() -> Vec<ReplicaAlarm> {
    use replicas::{
        DeathsUnanswered, LoserTold, MissedChange, NamesKept, NotUndone, SnapshotsShare, SpuriousChange,
        StaleParent, WritesKept,
    };
    vec![
        ReplicaAlarm::of::<MissedChange>("change-missed", "EVENT-1", "an edge is hidden and nobody is told"),
        ReplicaAlarm::of::<SpuriousChange>("change-made-up", "EVENT-1", "a name is told as an attribute"),
        ReplicaAlarm::of::<LoserTold>("loser-told", "EVENT-3", "a write that loses is told as if it had won"),
        ReplicaAlarm::of::<StaleParent>("stale-parent", "REPLICA-1", "a parent that has gone is still shown"),
        ReplicaAlarm::of::<NamesKept>("names-kept", "REPLICA-1", "a name finds a vertex that has gone"),
        ReplicaAlarm::of::<WritesKept>("writes-kept", "REPLICA-1", "writes that have gone are still found"),
        ReplicaAlarm::of::<NotUndone>("not-undone", "REPLICA-1", "a refused mutation removes all the same"),
        ReplicaAlarm::of::<DeathsUnanswered>(
            "deaths-unanswered",
            "REPLICA-1",
            "an answer to a digest leaves out what is dead",
        ),
        ReplicaAlarm::of::<SnapshotsShare>(
            "snapshots-share",
            "REPLICA-2",
            "a snapshot shows what its replica has come to since",
        ),
    ]
}
