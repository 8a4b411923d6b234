// ================================================================================================
// YOUR IMPLEMENTATION GOES HERE. What main.rs uses of it is `Delta`, and of `Graph`: new, mutate, join, view.
// ================================================================================================

use serde_json::{json, Map, Value};
use std::collections::{BTreeMap, BTreeSet};

/// A vertex is its handle; an edge is from, label, to.
type Element = Vec<String>;
/// When and by whom: (clock, replica).
type Stamp = (u64, usize);
/// For each element its last version, behind that one's stamp; of what is removed it is null.
pub type Delta = BTreeMap<Element, (Stamp, Value)>;

/// A replica: the last version of each element wins.
pub struct Graph {
    number: usize,
    held: Delta,
    delta: Delta,
}

fn check(holds: bool, message: &str) -> Result<(), String> {
    if holds { Ok(()) } else { Err(message.into()) }
}

fn fits(text: &str) -> bool {
    (1..=255).contains(&text.len())
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

fn key(edge: &Value) -> Element {
    ["from", "label", "to"].map(|member| text(&edge[member]).to_owned()).into()
}

impl Graph {
    /// An empty replica.
    pub fn new(number: usize) -> Self {
        let root = (vec!["root".to_owned()], ((0, 0), json!({"attributes": {}})));
        Self { number, held: [root].into(), delta: Delta::new() }
    }

    /// Makes all mutations and returns their delta, or says why not and changes nothing.
    pub fn mutate(&mut self, mutations: &[(&str, &Value)]) -> Result<Delta, String> {
        let mut draft = Self { number: self.number, held: self.held.clone(), delta: Delta::new() };
        for (name, given) in mutations {
            let before = draft.stranded();
            draft.make(name, given)?;
            let removes = name.starts_with("remove") || name.starts_with("move");
            check(!removes || draft.stranded().is_subset(&before), "a vertex would lose path or parent")?;
        }
        self.held = draft.held;
        Ok(draft.delta)
    }

    /// Takes from a delta what is later than what is held.
    pub fn join(&mut self, delta: &Delta) {
        for (element, new) in delta {
            if self.held.get(element).map_or(true, |old| old.0 < new.0) {
                self.held.insert(element.clone(), new.clone());
            }
        }
    }

    /// What a reader sees.
    pub fn view(&self) -> Value {
        let version = |element: &Element| self.held.get(element).map(|(_, version)| version.clone());
        let mut vertices = Map::new();
        for vertex in self.vertices() {
            vertices.insert(vertex.clone(), version(&vec![vertex]).unwrap_or_default());
        }
        let root = vertices.remove("root");
        let edges = self.edges().into_iter().map(|edge| {
            let attributes = version(&edge).map(|version| version["attributes"].clone());
            json!({"from": edge[0], "label": edge[1], "to": edge[2], "attributes": attributes})
        });
        json!({"root": root, "vertices": vertices, "edges": edges.collect::<Vec<_>>()})
    }

    fn there(&self) -> impl Iterator<Item = &Element> {
        self.held.iter().filter(|(_, (_, version))| !version.is_null()).map(|(element, _)| element)
    }

    fn vertices(&self) -> BTreeSet<String> {
        self.there().filter(|element| element.len() == 1).map(|element| element[0].clone()).collect()
    }

    fn edges(&self) -> BTreeSet<Element> {
        let ends = self.vertices();
        let edges = self.there().filter(|element| element.len() == 3);
        edges.filter(|edge| ends.contains(&edge[0]) && ends.contains(&edge[2])).cloned().collect()
    }

    fn parents(&self) -> BTreeMap<String, String> {
        let tree = self.edges().into_iter().filter(|edge| edge[1] == "RT");
        tree.map(|edge| (edge[2].clone(), edge[0].clone())).collect()
    }

    /// Who has no path to the root, or a child but no parent.
    fn stranded(&self) -> BTreeSet<String> {
        let (edges, parents) = (self.edges(), self.parents());
        let mut reached = BTreeSet::from(["root".to_owned()]);
        loop {
            let before = reached.len();
            for edge in &edges {
                if reached.contains(&edge[0]) || reached.contains(&edge[2]) {
                    reached.extend([edge[0].clone(), edge[2].clone()]);
                }
            }
            if reached.len() == before {
                break;
            }
        }
        let is_detached = |vertex: &String| {
            vertex != "root" && !parents.contains_key(vertex) && parents.values().any(|one| one == vertex)
        };
        let vertices = self.vertices().into_iter();
        vertices.filter(|vertex| !reached.contains(vertex) || is_detached(vertex)).collect()
    }

    fn make(&mut self, name: &str, given: &Value) -> Result<(), String> {
        match name {
            "add_vertex" => self.add_vertex(given),
            "add_edge" => self.add_edge(key(given), &given["attributes"]),
            "update_attributes" => self.update_attributes(given),
            "remove_edge" => self.remove_edge(key(given)),
            "move_edge" => {
                check(given["old"] != given["new"], "the edge would stay where it is")?;
                self.remove_edge(key(&given["old"]))?;
                self.add_edge(key(&given["new"]), &given["attributes"])
            }
            _ => self.remove_vertex(text(&given["vertex"])),
        }
    }

    /// Writes a version with the attributes of `version`, updated.
    fn put(&mut self, element: Element, mut version: Value, updates: &Value) -> Result<(), String> {
        for (name, value) in updates.as_object().into_iter().flatten() {
            check(fits(name), "an attribute's name is empty or too long")?;
            let attributes = version["attributes"].as_object_mut().ok_or("nothing is there")?;
            if value.is_null() {
                check(attributes.remove(name).is_some(), "what is to be unset is not set")?;
            } else {
                attributes.insert(name.clone(), value.clone());
            }
        }
        check(updates.as_object().map_or(0, Map::len) <= 1024, "too many attributes")?;
        let clock = self.held.values().map(|((clock, _), _)| *clock).max().unwrap_or(0) + 1;
        let stamped = ((clock, self.number), version);
        self.held.insert(element.clone(), stamped.clone());
        self.delta.insert(element, stamped);
        Ok(())
    }

    fn add_vertex(&mut self, given: &Value) -> Result<(), String> {
        let (vertex, link) = (&given["as"], &given["link"]);
        let (kind, name) = (text(&given["type"]), text(&given["name"]));
        check(fits(kind) && fits(name), "type or name is empty or too long")?;
        check(name != "root" && name != "world", "the name is reserved")?;
        let taken = self.held.values().any(|(_, version)| version["name"] == name);
        check(!taken, "the name is taken")?;
        check(link.get("from").is_some() || link["label"] != "RT", "a new vertex is nobody's parent")?;
        let version = json!({"type": kind, "name": name, "attributes": {}});
        self.put(vec![text(vertex).to_owned()], version, &given["attributes"])?;
        let end = |member| text(link.get(member).unwrap_or(vertex)).to_owned();
        self.add_edge(vec![end("from"), text(&link["label"]).to_owned(), end("to")], &link["attributes"])
    }

    fn add_edge(&mut self, edge: Element, attributes: &Value) -> Result<(), String> {
        let (from, label, to) = (&edge[0], &edge[1], &edge[2]);
        check(fits(label), "the label is empty or too long")?;
        let vertices = self.vertices();
        check(vertices.contains(from) && vertices.contains(to), "an end is not in the graph")?;
        check(from != to, "both ends are the same")?;
        check(!self.edges().contains(&edge), "the edge is there already")?;
        if label == "RT" {
            let parents = self.parents();
            check(to != "root" && !parents.contains_key(to), "the child is the root, or has a parent")?;
            let has_child = parents.values().any(|one| one == from);
            check(from == "root" || parents.contains_key(from) || has_child, "the parent is not in the tree")?;
            let (mut above, mut at) = (BTreeSet::new(), Some(from));
            while let Some(vertex) = at.filter(|vertex| above.insert((*vertex).clone())) {
                at = parents.get(vertex);
            }
            check(!above.contains(to), "the child is above its parent")?;
        }
        self.put(edge, json!({"attributes": {}}), attributes)
    }

    fn update_attributes(&mut self, given: &Value) -> Result<(), String> {
        let vertex = given["vertex"].as_str();
        let element = vertex.map_or_else(|| key(&given["edge"]), |vertex| vec![vertex.to_owned()]);
        let is_there = vertex.is_some_and(|vertex| self.vertices().contains(vertex));
        check(is_there || self.edges().contains(&element), "the target is not in the graph")?;
        let updates = &given["attributes"];
        check(updates.as_object().is_some_and(|updates| !updates.is_empty()), "no attribute is given")?;
        let version = self.held.get(&element).map(|(_, version)| version.clone());
        self.put(element, version.unwrap_or_default(), updates)
    }

    fn remove_edge(&mut self, edge: Element) -> Result<(), String> {
        check(self.edges().contains(&edge), "the edge is not in the graph")?;
        self.put(edge, Value::Null, &Value::Null)
    }

    fn remove_vertex(&mut self, vertex: &str) -> Result<(), String> {
        check(vertex != "root", "the root stays")?;
        check(self.vertices().contains(vertex), "the vertex is not in the graph")?;
        for edge in self.edges().into_iter().filter(|edge| edge[0] == vertex || edge[2] == vertex) {
            self.put(edge, Value::Null, &Value::Null)?;
        }
        self.put(vec![vertex.to_owned()], Value::Null, &Value::Null)
    }
}
