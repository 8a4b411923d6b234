//! Digests and what answers them: enough, least, and harmless whatever is asked. `[spec: SYNC-3]`

use crate::laws;
use crate::target::{Broken, Marks, Outcome, equal, holds};
use arbitrary::Unstructured;
use dsr_core::{
    CausalContext, Dictionary, Digest, Dot, Replica, ReplicaId, Run, State, check_digest, check_well_formed,
    decode_digest, delta_for, digest, encode_digest, fingerprint, limits,
};
use dsr_testkit::{Anchors, bytes};

/// How many records a universe has at most.
const RECORDS_MAX: usize = 16;

/// Two states over one universe, with long histories behind them if the bytes say so, and digests of nobody.
pub(crate) fn exchange(input: &[u8]) -> Outcome {
    let mut marks = Marks::default();
    let Ok((a, b, asked)) = case(&mut Unstructured::new(input)) else { return Ok(marks) };
    let [mine, theirs] = [digest(&a), digest(&b)];
    for state in [&a, &b] {
        laws::context_marks(state, &mut marks);
    }
    marks.add_if(mine.context == theirs.context && a != b, "equal-contexts-differ");
    let delta = delta_for(&b, &mine);
    is_enough(&a, &b, &delta)?;
    if delta.context().runs().map(|run| run.last - run.first).sum::<u64>() < 64 {
        is_least(&a, &b, &delta)?;
    } else {
        marks.add("long-run-missed");
    }
    look(&a, &delta, &mut marks);
    one_exchange(&a, &b)?;
    tells_apart(&a, &b)?;
    let mut replica = Replica::new(ReplicaId::agent(1), Dictionary::open());
    replica.apply(&b);
    for question in [&mine, &asked] {
        equal(
            "REPLICA-1",
            "the answers of replica and state",
            &replica.delta_for(question),
            &delta_for(&b, question),
        )?;
    }
    of_nobody(&b, &asked, &mut marks)?;
    Ok(marks)
}

fn case(u: &mut Unstructured<'_>) -> arbitrary::Result<(State, State, Digest)> {
    let universe = bytes::universe(u, RECORDS_MAX, Anchors::Right)?;
    let mut pair = [State::new(), State::new()];
    for state in &mut pair {
        let fates = bytes::fates(u, &universe)?;
        // Events that both could have seen, of another replica: all of them dead.
        *state = universe.state(&fates).joined(&State::assemble([], context(u)?));
    }
    let [a, b] = pair;
    let live = (0..u.int_in_range(0..=3_u8)?).map(|_| run(u)).collect::<arbitrary::Result<_>>()?;
    Ok((a, b, Digest { context: context(u)?, live }))
}

/// Runs of agents 6 and 7, far from the universe's.
fn context(u: &mut Unstructured<'_>) -> arbitrary::Result<CausalContext> {
    let mut context = CausalContext::new();
    match u.int_in_range(0..=7_u8)? {
        0 => {
            for _ in 0..u.int_in_range(1..=40_u8)? {
                context.insert_run(run(u)?);
            }
        }
        1 => context.insert_prefix(ReplicaId::agent(6), limits::SEQUENCE_MAX),
        2 => context.insert_run(run(u)?),
        _ => {}
    }
    Ok(context)
}

/// A run, short or of any length.
fn run(u: &mut Unstructured<'_>) -> arbitrary::Result<Run> {
    let replica = ReplicaId::agent(6 + u32::from(u.ratio(1_u8, 8_u8)?));
    if u.ratio(1_u8, 6_u8)? {
        let ends = [u.int_in_range(1..=limits::SEQUENCE_MAX)?, u.int_in_range(1..=limits::SEQUENCE_MAX)?];
        return Ok(Run { replica, first: ends[0].min(ends[1]), last: ends[0].max(ends[1]) });
    }
    let first = u64::from(u.int_in_range(1..=120_u8)?);
    Ok(Run { replica, first, last: first + u.int_in_range(0..=2)? })
}

fn merged(state: &State, other: &State) -> State {
    let mut merged = state.clone();
    merged.merge(other);
    merged
}

fn is_enough(a: &State, b: &State, delta: &State) -> Result<(), Broken> {
    equal("SYNC-3", "a with the answer, a with b", &a.joined(delta), &a.joined(b))?;
    equal("SYNC-3", "merged with the answer, with b", &merged(a, delta), &merged(a, b))?;
    equal("SYNC-3", "the answer", &check_well_formed(delta), &Ok(()))?;
    holds("SYNC-3", delta.is_below(b), || format!("{delta:#?}\nis more than\n{b:#?}"))
}

/// Without any one of its dots the answer would not do.
fn is_least(a: &State, b: &State, delta: &State) -> Result<(), Broken> {
    let all = merged(a, b);
    for dot in delta.context().runs().flat_map(Run::dots) {
        let context: CausalContext =
            delta.context().runs().flat_map(Run::dots).filter(|other| *other != dot).collect();
        let records = delta.records().filter(|(other, _)| *other != dot);
        let less = State::assemble(records.map(|(other, record)| (other, record.clone())), context);
        holds("SYNC-3", merged(a, &less) != all, || format!("{dot} is not needed in {delta:#?}"))?;
    }
    Ok(())
}

/// `[spec: SYNC-5]`
fn one_exchange(a: &State, b: &State) -> Result<(), Broken> {
    let new_a = a.joined(&delta_for(b, &digest(a)));
    let new_b = b.joined(&delta_for(a, &digest(b)));
    equal("SYNC-5", "both after one exchange", &new_a, &new_b)?;
    equal("SYNC-4", "their fingerprints", &fingerprint(&new_a), &fingerprint(&new_b))?;
    equal("SYNC-5", "what is left to say", &delta_for(&new_a, &digest(&new_b)), &State::new())
}

/// Over one universe, equal digests are equal states. `[spec: SYNC-1]` `[spec: SYNC-4]`
fn tells_apart(a: &State, b: &State) -> Result<(), Broken> {
    equal("SYNC-1", "equal states, equal digests", &(a == b), &(digest(a) == digest(b)))?;
    equal("SYNC-4", "equal states, equal fingerprints", &(a == b), &(fingerprint(a) == fingerprint(b)))?;
    for state in [a, b] {
        let digest = digest(state);
        equal("ENC-11", "a digest", &check_digest(&digest), &Ok(()))?;
        equal("ENC-11", "bytes and back", &decode_digest(&encode_digest(&digest)).as_ref(), &Ok(&digest))?;
        let lives = |dot: &Dot| digest.lives(*dot) == state.holds(*dot);
        let all = state
            .records()
            .map(|(dot, _)| dot)
            .chain(state.context().runs().map(|run| Dot::new(run.replica, run.last)));
        for dot in all {
            holds("SYNC-1", lives(&dot), || format!("{dot} in {digest:?}"))?;
        }
    }
    Ok(())
}

/// Whatever a digest says, sound or not, the answer is a part of the state.
fn of_nobody(state: &State, asked: &Digest, marks: &mut Marks) -> Result<(), Broken> {
    let answer = delta_for(state, asked);
    equal("SYNC-3", "an answer to anybody", &check_well_formed(&answer), &Ok(()))?;
    holds("SYNC-3", answer.is_below(state), || format!("{answer:#?}\nis more than\n{state:#?}"))?;
    let is_sound = check_digest(asked).is_ok();
    // Who writes the digest of no state may write the bytes of another, as where runs are out of order.
    let bytes = encode_digest(asked);
    match decode_digest(&bytes) {
        Ok(read) => {
            holds("ENC-11", !is_sound || read == *asked, || format!("{asked:#?}\nis read as\n{read:#?}"))?;
            equal("ENC-11", "bytes, and the bytes of what they spell", &bytes, &encode_digest(&read))?;
            marks.add_if(read != *asked, "read-as-another");
        }
        Err(error) => holds("ENC-11", !is_sound, || format!("{error}: {asked:#?}"))?,
    }
    marks.add(if is_sound { "digest-sound" } else { "digest-of-no-state" });
    Ok(())
}

/// What of an answer is rare.
fn look(a: &State, delta: &State, marks: &mut Marks) {
    marks.add_if(delta.context().is_empty(), "nothing-missed");
    marks.add_if(!delta.is_empty(), "records-missed");
    let dead = |state: &State| a.records().any(|(dot, _)| state.is_dead(dot));
    marks.add_if(dead(delta), "deaths-missed");
    marks.add_if(dead(delta) && !delta.is_empty(), "records-and-deaths-missed");
    marks.add_if(delta.context().runs().any(|run| run.first > 1), "answer-with-gap");
    let depth = laws::closure_depth(a, delta);
    marks.add_if(depth.is_some(), &format!("closure-{}", depth.unwrap_or(0)));
}
