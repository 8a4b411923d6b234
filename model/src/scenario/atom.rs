//! What predicates are made of: questions on one view. `[spec: SCEN-7]`

use super::cursor::{Cursor, Object, Read};
use super::error::Fault;
use super::mutation::NamedTarget;
use super::pattern::{EdgePattern, VertexPattern};
use super::scope::Scope;
use dsr_core::{Dot, Name, Placement, Value, View};

/// A question on one view.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Atom {
    Count(Countable, Bound),
    Attribute { of: NamedTarget, name: Name, test: Test },
    Placement { of: Name, is: Place, parent: Option<Name> },
}

/// What can be counted.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Countable {
    Vertices(VertexPattern),
    Edges(EdgePattern),
    /// The live writes of one attribute.
    Writes(NamedTarget, Name),
    /// The repairs of one kind, or all.
    Repairs(Option<&'static str>),
}

/// What a count obeys.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Bound {
    Exactly(usize),
    AtLeast(usize),
    AtMost(usize),
}

/// What an attribute's winning write passes.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Test {
    Is(Value),
    AtLeast(f64),
    AtMost(f64),
    Present(bool),
}

/// Where a vertex stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Place {
    Root,
    Child,
    Detached,
    Outside,
    Absent,
}

const PLACES: &[(&str, Place)] = &[
    ("root", Place::Root),
    ("child", Place::Child),
    ("detached", Place::Detached),
    ("outside", Place::Outside),
    ("absent", Place::Absent),
];

/// The kinds of repair, as [`dsr_core::Repair::kind`] names them, and any.
const REPAIRS: &[(&str, Option<&str>)] = &[
    ("same-key", Some("same-key")),
    ("functional", Some("functional")),
    ("rt-parent", Some("rt-parent")),
    ("cycle-broken", Some("cycle-broken")),
    ("detached", Some("detached")),
    ("reattached", Some("reattached")),
    ("name-clash", Some("name-clash")),
    ("undeclared", Some("undeclared")),
    ("any", None),
];

const COUNT: &[&str] = &["vertices", "edges", "writes", "repairs", "exactly", "at_least", "at_most"];
const COUNTABLE: &[&str] = &["vertices", "edges", "writes", "repairs"];
const BOUNDS: &[&str] = &["exactly", "at_least", "at_most"];
const COUNT_MAX: u64 = 1 << 20;

/// The one field of `among` that an object has.
fn only<'j>(
    cursor: &Cursor<'_>,
    object: &Object<'j>,
    among: &'static [&'static str],
) -> Read<(&'static str, Cursor<'j>)> {
    let mut present = among.iter().filter_map(|field| object.get(field).map(|value| (*field, value)));
    match (present.next(), present.next()) {
        (Some(found), None) => Ok(found),
        (None, _) => cursor.fault(Fault::NotOneOf { allowed: among, found: 0 }),
        (Some(_), Some(_)) => cursor.fault(Fault::NotOneOf { allowed: among, found: 2 + present.count() }),
    }
}

fn read_target(cursor: &Cursor<'_>, scope: &Scope) -> Read<NamedTarget> {
    if cursor.value.is_string() {
        return Ok(NamedTarget::Vertex(scope.vertex(cursor)?));
    }
    Ok(NamedTarget::Edge(EdgePattern::read_one(cursor, scope)?))
}

impl Atom {
    pub(super) fn vertex(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let pattern = VertexPattern::read(cursor, scope)?;
        Ok(Self::Count(Countable::Vertices(pattern), Bound::AtLeast(1)))
    }

    pub(super) fn edge(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let pattern = EdgePattern::read(cursor, scope)?;
        Ok(Self::Count(Countable::Edges(pattern), Bound::AtLeast(1)))
    }

    pub(super) fn repair(cursor: &Cursor<'_>) -> Read<Self> {
        Ok(Self::Count(Countable::Repairs(cursor.word(REPAIRS)?), Bound::AtLeast(1)))
    }

    pub(super) fn count(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let object = cursor.object(COUNT)?;
        let (what, counted) = only(cursor, &object, COUNTABLE)?;
        let counted = match what {
            "vertices" => Countable::Vertices(VertexPattern::read(&counted, scope)?),
            "edges" => Countable::Edges(EdgePattern::read(&counted, scope)?),
            "writes" => {
                let writes = counted.object(&["of", "name"])?;
                let name = writes.need("name")?;
                Countable::Writes(
                    read_target(&writes.need("of")?, scope)?,
                    scope.attribute(&name, name.text()?)?,
                )
            }
            _ => Countable::Repairs(counted.word(REPAIRS)?),
        };
        let (bound, number) = only(cursor, &object, BOUNDS)?;
        let number = usize::try_from(number.whole(0, COUNT_MAX)?).unwrap_or(usize::MAX);
        Ok(Self::Count(
            counted,
            match bound {
                "exactly" => Bound::Exactly(number),
                "at_least" => Bound::AtLeast(number),
                _ => Bound::AtMost(number),
            },
        ))
    }

    pub(super) fn attribute(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let object = cursor.object(&["of", "name", "is", "at_least", "at_most", "present"])?;
        let of = read_target(&object.need("of")?, scope)?;
        let name = object.need("name")?;
        let name = scope.attribute(&name, name.text()?)?;
        let (test, value) = only(cursor, &object, &["is", "at_least", "at_most", "present"])?;
        let test = match test {
            "is" => Test::Is(scope.value(&name, &value)?),
            "at_least" => Test::AtLeast(value.number()?),
            "at_most" => Test::AtMost(value.number()?),
            _ => Test::Present(value.flag()?),
        };
        Ok(Self::Attribute { of, name, test })
    }

    pub(super) fn placement(cursor: &Cursor<'_>, scope: &Scope) -> Read<Self> {
        let object = cursor.object(&["of", "is", "parent"])?;
        let of = scope.vertex(&object.need("of")?)?;
        let is = object.need("is")?.word(PLACES)?;
        let parent = object.get("parent").map(|parent| scope.vertex(&parent)).transpose()?;
        if parent.is_some() && is != Place::Child {
            return cursor.fault(Fault::Needs { field: "parent", needed: "`is`: \"child\"" });
        }
        Ok(Self::Placement { of, is, parent })
    }

    /// The answer.
    pub(super) fn holds(&self, view: &View<'_>) -> bool {
        match self {
            Self::Count(counted, bound) => bound.admits(counted.count(view)),
            Self::Attribute { of, name, test } => {
                let write = target(view, of).and_then(|dot| view.attribute(dot, name));
                test.passes(write.map(|(_, write)| &write.value))
            }
            Self::Placement { of, is, parent } => stands(view, of, *is, parent.as_ref()),
        }
    }
}

fn target(view: &View<'_>, of: &NamedTarget) -> Option<Dot> {
    match of {
        NamedTarget::Vertex(name) => view.vertex_by_name(name).map(Into::into),
        NamedTarget::Edge(pattern) => pattern.the_one(view).ok().map(|shown| shown.id.into()),
    }
}

fn stands(view: &View<'_>, of: &Name, is: Place, parent: Option<&Name>) -> bool {
    let Some(vertex) = view.vertex_by_name(of) else { return is == Place::Absent };
    match view.placement(vertex) {
        None => is == Place::Absent,
        Some(Placement::Root) => is == Place::Root,
        Some(Placement::Detached) => is == Place::Detached,
        Some(Placement::Outside) => is == Place::Outside,
        Some(Placement::Child { parent: above, .. }) => {
            is == Place::Child && parent.is_none_or(|name| view.vertex_by_name(name) == Some(above))
        }
    }
}

impl Countable {
    fn count(&self, view: &View<'_>) -> usize {
        match self {
            Self::Vertices(pattern) => pattern.count(view),
            Self::Edges(pattern) => pattern.matches(view).count(),
            Self::Writes(of, name) => {
                target(view, of).map_or(0, |dot| view.attribute_writes(dot, name).len())
            }
            Self::Repairs(kind) => {
                view.repairs().iter().filter(|repair| kind.is_none_or(|kind| repair.kind() == kind)).count()
            }
        }
    }
}

impl Bound {
    fn admits(self, count: usize) -> bool {
        match self {
            Self::Exactly(number) => count == number,
            Self::AtLeast(number) => count >= number,
            Self::AtMost(number) => count <= number,
        }
    }
}

impl Test {
    fn passes(&self, value: Option<&Value>) -> bool {
        match self {
            Self::Is(wanted) => value == Some(wanted),
            Self::AtLeast(least) => value.and_then(as_number).is_some_and(|number| number >= *least),
            Self::AtMost(most) => value.and_then(as_number).is_some_and(|number| number <= *most),
            Self::Present(wanted) => value.is_some() == *wanted,
        }
    }
}

/// The number in a scalar; 64-bit integers beyond 2⁵³ are rounded, which comparing bounds can bear.
fn as_number(value: &Value) -> Option<f64> {
    Some(match value {
        Value::Int(number) => f64::from(*number),
        Value::UInt(number) => f64::from(*number),
        Value::Float(number) => f64::from(*number),
        Value::Double(number) => *number,
        #[allow(clippy::cast_precision_loss, reason = "a bound on a large count is meant roughly")]
        Value::UInt64(number) => *number as f64,
        _ => return None,
    })
}
