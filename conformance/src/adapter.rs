//! What answers requests.

use crate::protocol::{
    Answer, AnswerFor, CaseBegin, Command, Decline, Deliver, Hello, HelloReply, MadeDelta, Mutate, Read,
    Restart, Shown,
};

pub use crate::core_adapter::Core;

/// An implementation that can be asked. `[spec: CONF-4]`
///
/// The first five methods suffice for the profile `observe`; the other two are features.
pub trait Adapter {
    /// The handshake.
    fn hello(&mut self, hello: &Hello) -> Result<HelloReply, Decline>;
    /// Begins a case with empty replicas; what there was of another one is forgotten.
    fn begin(&mut self, case: &CaseBegin) -> Result<(), Decline>;
    /// Makes mutations as one group, all or none; returns the delta's handle.
    fn mutate(&mut self, mutate: &Mutate) -> Result<MadeDelta, Decline>;
    /// Joins a delta.
    fn deliver(&mut self, deliver: &Deliver) -> Result<(), Decline>;
    /// What a replica shows.
    fn read(&mut self, read: &Read) -> Result<Shown, Decline>;
    /// Stops a replica and starts it anew.
    fn restart(&mut self, _restart: &Restart) -> Result<(), Decline> {
        Err(Decline::error(crate::protocol::ErrorCode::Unsupported, "no command `restart`"))
    }
    /// Makes the delta that one replica lacks of another.
    fn resynchronise(&mut self, _answer: &AnswerFor) -> Result<MadeDelta, Decline> {
        Err(Decline::error(crate::protocol::ErrorCode::Unsupported, "no command `answer`"))
    }
    /// Ends a case.
    fn end(&mut self) {}
}

/// The answer to any command. `bye` is the caller's to act on.
pub fn answer(adapter: &mut dyn Adapter, command: &Command) -> Result<Answer, Decline> {
    let done = Answer::Done(crate::protocol::Done {});
    Ok(match command {
        Command::Hello(hello) => Answer::Hello(adapter.hello(hello)?),
        Command::CaseBegin(case) => adapter.begin(case).map(|()| done)?,
        Command::Mutate(mutate) => Answer::Delta(adapter.mutate(mutate)?),
        Command::Deliver(deliver) => adapter.deliver(deliver).map(|()| done)?,
        Command::Read(read) => Answer::View(adapter.read(read)?),
        Command::Restart(restart) => adapter.restart(restart).map(|()| done)?,
        Command::Answer(answer) => Answer::Delta(adapter.resynchronise(answer)?),
        Command::CaseEnd(_) => {
            adapter.end();
            done
        }
        Command::Bye(_) => done,
    })
}
