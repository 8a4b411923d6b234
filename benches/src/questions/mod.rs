//! What is asked. One file for each kind of question.
//!
//! A question makes its sides: one for each library that can do the job. What is made before the stopwatch
//! starts and after it stops does not count. Each side shows once that it does the job, and is an error if it
//! does not.

pub mod attribute;
pub mod element;
pub mod join;
pub mod kinematic;
pub mod movement;
pub mod reconcile;

use crate::contest::Side;
use crate::error::Result;

/// Makes the sides of a question for the libraries that are wanted.
pub type MakeSides = fn(&Question, &dyn Fn(&str) -> bool) -> Result<Vec<Side>>;

/// A question.
#[derive(Clone, Copy)]
pub struct Question {
    /// Its name, such as `apply/f64`.
    pub id: &'static str,
    /// What is asked, in a sentence.
    pub asks: &'static str,
    /// Whether it takes long, so that fewer rounds must do.
    pub heavy: bool,
    /// Operations of one round.
    pub turns: usize,
    /// Its sides, ours first.
    pub sides: MakeSides,
}

impl std::fmt::Debug for Question {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Question").field("id", &self.id).finish_non_exhaustive()
    }
}

/// The sides of some libraries by one generic function.
macro_rules! sides {
    ($side:expr; $($library:ident),+ $(,)?) => {{
        fn all(
            question: &$crate::questions::Question,
            is_wanted: &dyn Fn(&str) -> bool,
        ) -> $crate::error::Result<Vec<$crate::contest::Side>> {
            let mut sides = Vec::new();
            $(if is_wanted(<$crate::libraries::$library as $crate::scene::Scene>::NAME) {
                sides.push($side(question, std::marker::PhantomData::<$crate::libraries::$library>)?);
            })+
            Ok(sides)
        }
        all
    }};
}
pub(crate) use sides;

/// All questions, in the order of the report.
pub fn all() -> Vec<Question> {
    let mut all = Vec::new();
    all.extend(attribute::questions());
    all.extend(element::questions());
    all.extend(movement::questions());
    all.extend(kinematic::questions());
    all.extend(join::questions());
    all.extend(reconcile::questions());
    all
}

/// Whether a name is meant by a pattern, in which `*` stands for anything.
pub fn is_meant(pattern: &str, id: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == id,
        Some((head, rest)) => id.strip_prefix(head).is_some_and(|tail| {
            tail.char_indices().map(|(at, _)| at).chain([tail.len()]).any(|at| is_meant(rest, &tail[at..]))
        }),
    }
}
