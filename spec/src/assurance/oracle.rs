//! What ties the proofs to the Rust code.

use crate::evidence::Evidence;

/// The chapter that there is if there is an oracle.
const CHAPTER: &str = "ORACLE";

/// Whether the specification has an oracle.
pub(super) fn is_here(evidence: &Evidence) -> bool {
    evidence.trace.clauses.all().iter().any(|clause| clause.id.chapter() == CHAPTER)
}

pub(super) fn oracle(evidence: &Evidence) -> String {
    let cases = evidence.cases.total;
    if is_here(evidence) {
        format!(
            "**The oracle** is the model itself as a program: Coq extracts OCaml from the definitions that the theorems are \
             about, and a driver around it reads and writes what the core does. It runs beside the core, and both must \
             answer the same: joins and closure, mutations with their refusals, views with repairs, digests, `delta_for`, \
             decoding. It is asked on the conformance corpus (`dsr oracle corpus`, {cases} cases), on every canonical history \
             at the default bounds (`dsr oracle histories`) and on a million random ones (`dsr oracle random`). Where it \
             agrees, the core does on these inputs what the theorems are about; of other inputs that says nothing.\n\n\
             Trusted with it: Coq's kernel; its extraction, which is not verified; the OCaml compiler; the driver, whose JSON \
             and binary codecs are written by hand; and what stands in for Coq's own numbers and strings, Zarith and OCaml's."
        )
    } else {
        format!(
            "**There is no oracle yet.** The model runs inside Coq, and could be extracted to a program that answers beside \
             the core; no such program is part of this repository, so no case counts as judged by it. Until then what ties \
             the core to the proofs is that both are held to one text: the core by its tests, by the checker, and by \
             {cases} conformance cases, whose expectations are written from the clauses; the model by its theorems."
        )
    }
}
