//! Who is in the group: agent ids, leaving, getting lost, starting anew; and time.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod lab;

use dsr_transport::memory::Faults;
use dsr_transport::{Action, Event, MS, MutateError, Presence, Session};
use lab::{Lab, config, image, room};
/// `[spec: LINK-15]`
#[test]
fn law_an_agent_id_has_one_holder() {
    let mut lab = Lab::of(2);
    let mut second = config(1);
    (second.replica.incarnation, second.nonce, second.name) = (4, 99, "double".into());
    lab.start(2, second);
    let now = lab.now;
    let claiming = lab.session(2).mutate(&room("a"), 0, now).unwrap_err();
    assert!(matches!(claiming, MutateError::Claiming { .. }));
    lab.pass(1000);
    let refused = lab.session(2).mutate(&room("a"), 0, now).unwrap_err().to_string();
    assert!(
        refused.contains("agent 1") && refused.contains("\"a1\"") && refused.contains("\"double\""),
        "{refused}"
    );
    assert!(lab.told.iter().any(|told| matches!(told.2, Action::Refused(_)) && told.1 == 2));
    lab.mutate(0, &room("kitchen"));
    // The holder is killed: its id is free.
    lab.pass(100);
    lab.sessions[0] = None;
    let mut third = config(1);
    (third.replica.incarnation, third.nonce) = (5, 100);
    lab.start(0, third);
    lab.pass(1000);
    lab.mutate(0, &room("hall"));
    lab.pass(50);
    lab.sessions[2] = None;
    assert!(lab.are_equal() && lab.session(1).snapshot().vertex_by_name("kitchen").is_some());
}

/// Two that could not hear each other hold one id; the later one becomes a reader, and loses nothing.
/// `[spec: LINK-15]`
#[test]
fn law_the_later_of_two_holders_gives_up() {
    let mut lab = Lab::new(3, Faults::NONE);
    lab.network.partition(0b100);
    lab.start(0, config(1));
    lab.start(1, config(2));
    let mut second = config(1);
    (second.replica.incarnation, second.nonce) = (1, 99);
    lab.start(2, second);
    lab.pass(1000);
    lab.mutate(2, &room("island"));
    lab.mutate(0, &room("mainland"));
    lab.network.partition(0);
    lab.pass(4000);
    assert!(lab.are_equal() && lab.session(0).snapshot().vertex_by_name("island").is_some());
    assert!(lab.session(0).is_writer() && !lab.session(2).is_writer() && !lab.session(2).is_over());
}

/// `[spec: LINK-16]`
#[test]
fn law_peers_leave_and_get_lost() {
    let mut lab = Lab::of(3);
    lab.pass(2000);
    let presence = |lab: &Lab, of: Presence| {
        let told = lab
            .told
            .iter()
            .filter(|told| matches!(&told.2, Action::Peer { presence, .. } if *presence == of));
        told.map(|told| told.1).collect::<Vec<_>>()
    };
    assert_eq!(presence(&lab, Presence::Joined).len(), 6);
    let now = lab.now;
    lab.session(0).mutate(&room("last"), 0, now).unwrap();
    lab.session(0).handle(Event::Leave, now);
    lab.drain(0);
    lab.pass(5);
    assert_eq!(presence(&lab, Presence::Left), [1, 2]);
    assert!(lab.session(0).is_over() && lab.session(0).next_wake().is_none());
    assert!(matches!(lab.session(0).mutate(&room("no"), 0, now), Err(MutateError::Left)));
    assert!(lab.are_equal(), "what waited was sent");
    lab.sessions[2] = None;
    lab.pass(3000);
    assert_eq!(presence(&lab, Presence::Lost), [0; 0]);
    lab.pass(1000);
    assert_eq!(presence(&lab, Presence::Lost), [1]);
    assert_eq!(lab.session(1).peers().count(), 0);
}

/// A start under the same replica id, with all that it had, is a new origin. `[spec: LINK-4]`
#[test]
fn law_a_new_start_is_a_new_origin() {
    let mut lab = Lab::of(2);
    for at in 0..5 {
        lab.mutate(0, &room(&format!("r{at}")));
    }
    lab.pass(100);
    let graph = lab.session(0).snapshot();
    let mut again = config(1);
    again.nonce = 2;
    lab.sessions[0] = Some(Session::on(again, graph, 5, lab.now));
    lab.pass(400);
    // Its numbers begin anew, below those that its peer has delivered.
    lab.mutate(0, &room("after"));
    lab.pass(20);
    assert!(lab.are_equal() && lab.session(1).snapshot().vertex_by_name("after").is_some());
}

/// Clocks jump. `[spec: LINK-2]`
#[test]
fn law_time_may_go_back() {
    let mut session = Session::new(config(1), 1, 100_000 * MS);
    let mut now = 50_000 * MS;
    let mut turns = 0;
    while session.is_claiming() {
        session.handle(Event::Tick, now);
        while session.poll_action().is_some() {}
        let wake = session.next_wake().unwrap();
        assert!(wake > now && wake < now + 200 * MS, "in the caller's time");
        now = wake;
        turns += 1;
        assert!(turns < 100);
    }
    assert!((50_149..50_200).contains(&(now / MS)), "{now}");
}

/// Equal events at equal times with equal seeds lead to equal actions. `[spec: LINK-2]`
#[test]
fn law_a_session_is_a_function() {
    let mut lab = Lab::of(3);
    lab.mutate(0, &image("photo", 10_000));
    let mut twin = lab.session(1).clone();
    let (mut sent, mut other) = (Vec::new(), Vec::new());
    for ms in 1..500 {
        let now = lab.now + ms * MS;
        for (session, actions) in [(lab.sessions[1].as_mut().unwrap(), &mut sent), (&mut twin, &mut other)] {
            session.handle(Event::Tick, now);
            actions.extend(std::iter::from_fn(|| session.poll_action()));
        }
    }
    assert!(!sent.is_empty());
    assert_eq!(sent, other);
}
