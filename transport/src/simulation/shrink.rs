//! A plan that fails, made small: fewer steps, fewer nodes, fewer faults, while it still fails.

use super::plan::{Plan, Step};
use super::run::run;
use crate::memory::Faults;

/// So many runs are spent on it.
const RUNS_MAX: usize = 400;

/// The smallest plan found that fails, and the runs that it took. A plan that does not fail is returned as it is.
pub fn shrink(plan: &Plan) -> (Plan, usize) {
    let mut search = Search { best: plan.clone(), runs: 0 };
    if !search.fails(plan) {
        return (plan.clone(), search.runs);
    }
    loop {
        let before = search.best.clone();
        search.drop_steps();
        search.drop_nodes();
        search.drop_faults();
        if search.best == before || search.runs >= RUNS_MAX {
            return (search.best, search.runs);
        }
    }
}

struct Search {
    best: Plan,
    runs: usize,
}

impl Search {
    fn fails(&mut self, plan: &Plan) -> bool {
        self.runs += 1;
        run(plan).failure.is_some()
    }

    /// Takes a smaller plan if it fails, too.
    fn attempt(&mut self, plan: Plan) -> bool {
        let better = plan != self.best && self.runs < RUNS_MAX && self.fails(&plan);
        if better {
            self.best = plan;
        }
        better
    }

    /// Leaves out halves, quarters, … of the steps, then each one.
    fn drop_steps(&mut self) {
        let mut size = self.best.steps.len() / 2;
        while size > 0 {
            let mut at = 0;
            while at < self.best.steps.len() {
                let mut plan = self.best.clone();
                plan.steps.drain(at..(at + size).min(plan.steps.len()));
                if !self.attempt(plan) {
                    at += size;
                }
            }
            size /= 2;
        }
    }

    /// Leaves out all that happens at a node.
    fn drop_nodes(&mut self) {
        for node in (0..=self.best.nodes).rev() {
            let mut plan = self.best.clone();
            plan.steps.retain(|(_, step)| !concerns(step, node));
            self.attempt(plan);
        }
    }

    fn drop_faults(&mut self) {
        let none = Faults::NONE;
        let edits: [fn(&mut Faults); 5] = [
            |faults| faults.loss = 0,
            |faults| faults.duplicates = 0,
            |faults| faults.damage = 0,
            |faults| faults.delay_max = faults.delay_min,
            |faults| faults.loss /= 2,
        ];
        for edit in edits {
            let mut plan = self.best.clone();
            edit(&mut plan.faults);
            self.attempt(plan);
        }
        let mut plan = self.best.clone();
        plan.faults = none;
        self.attempt(plan);
    }
}

fn concerns(step: &Step, at: usize) -> bool {
    match *step {
        Step::Mutate { node, .. }
        | Step::Image { node, .. }
        | Step::Burst { node, .. }
        | Step::Crash { node }
        | Step::Start { node }
        | Step::Leave { node }
        | Step::Jump { node, .. }
        | Step::Slow { node, .. }
        | Step::Impostor { node, .. } => node == at,
        Step::Partition { .. } | Step::Heal | Step::Hostile { .. } => false,
    }
}
