//! Random mutations, decided by a seed.

use dsr_conformance::protocol::{EdgeName, Link, Mutation, Tagged, Unique, View};
use dsr_core::{Value, ValueType};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

const LABELS: [&str; 5] = ["RT", "RT", "in", "near", ""];

pub(crate) struct Dice(ChaCha8Rng);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        usize::try_from(self.0.next_u32()).unwrap() % bound
    }

    pub(crate) fn pick<'i, T: ?Sized>(&mut self, items: &[&'i T]) -> &'i T {
        items[self.below(items.len())]
    }

    fn value(&mut self) -> Tagged {
        let float = self.pick(&[&0.0, &-0.0, &1.5, &f64::NAN, &f64::NEG_INFINITY, &f64::MIN_POSITIVE]);
        #[expect(clippy::cast_possible_truncation, reason = "any 32-bit float will do")]
        let short = *float as f32;
        let whole = *self.pick(&[&0, &u64::MAX, &(1 << 53), &((1 << 53) + 1)]);
        Tagged(
            match ValueType::ALL[self.below(ValueType::ALL.len())] {
                ValueType::String => Value::String("kitchen \u{0} \u{1F916}".into()),
                ValueType::Int => Value::Int(i32::MIN),
                ValueType::Float => Value::Float(short),
                ValueType::FloatVec => Value::FloatVec(vec![short; self.below(3)].into()),
                ValueType::Bool => Value::Bool(self.below(2) == 0),
                ValueType::ByteVec => Value::ByteVec(vec![0, 255].into()),
                ValueType::UInt => Value::UInt(u32::MAX),
                ValueType::UInt64 => Value::UInt64(whole),
                ValueType::Double => Value::Double(*float),
                ValueType::U64Vec => Value::U64Vec(vec![whole; 2].into()),
                ValueType::Vec2 => Value::Vec2([short; 2]),
                ValueType::Vec3 => Value::Vec3([short; 3]),
                ValueType::Vec4 => Value::Vec4([short; 4]),
                ValueType::Vec6 => Value::Vec6([short; 6]),
            }
            .with_canonical_nans(),
        )
    }

    fn attributes(&mut self) -> Unique<Tagged> {
        let names = ["level", "pose", "x/y", "attributes"];
        Unique((0..self.below(3)).map(|_| (self.pick(&names).to_owned(), self.value())).collect())
    }

    fn edge(&mut self, handles: &[&str], view: &View) -> EdgeName {
        if !view.edges.is_empty() && self.below(6) > 0 {
            let edge = &view.edges[self.below(view.edges.len())];
            return EdgeName { from: edge.from.clone(), label: edge.label.clone(), to: edge.to.clone() };
        }
        let label = self.pick(&LABELS).into();
        EdgeName { from: self.pick(handles).into(), label, to: self.pick(handles).into() }
    }

    /// Any mutation, of what is there or was once; many are refused.
    pub(crate) fn mutation(&mut self, handles: &[&str], view: &View, new: &str) -> Mutation {
        let label = self.pick(&LABELS).to_owned();
        let (one, other) = (self.pick(handles).to_owned(), self.pick(handles).to_owned());
        match self.below(8) {
            0 | 1 => {
                let (from, to) = if self.below(4) > 0 { (Some(one), None) } else { (None, Some(one)) };
                let name = if self.below(8) > 0 { new } else { self.pick(&["root", "v1", ""]) };
                let link = Link { from, label, to, attributes: self.attributes() };
                let attributes = self.attributes();
                Mutation::AddVertex {
                    r#as: new.into(),
                    r#type: "thing".into(),
                    name: name.into(),
                    attributes,
                    link,
                }
            }
            2 => Mutation::AddEdge { from: one, label, to: other, attributes: self.attributes() },
            3 | 4 => {
                let mut updates: Unique<Option<Tagged>> = Unique::default();
                for (name, value) in self.attributes().0 {
                    updates.0.insert(name, (self.below(3) > 0).then_some(value));
                }
                let (vertex, edge) = if self.below(2) == 0 {
                    (Some(one), None)
                } else {
                    (None, Some(self.edge(handles, view)))
                };
                Mutation::UpdateAttributes { vertex, edge, attributes: updates }
            }
            5 => {
                let EdgeName { from, label, to } = self.edge(handles, view);
                Mutation::RemoveEdge { from, label, to }
            }
            6 => {
                let old = self.edge(handles, view);
                let mut new = EdgeName { from: one, ..old.clone() };
                if self.below(3) == 0 {
                    new = EdgeName { from: new.from, label, to: other };
                }
                Mutation::MoveEdge { old, new, attributes: self.attributes() }
            }
            _ => Mutation::RemoveVertex { vertex: one },
        }
    }
}
