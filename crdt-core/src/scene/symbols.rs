//! From the tree of a file to symbols, links and attributes, each judged on its own. `[spec: SCENE-6]`

use super::collect::Faults;
use super::fault::FaultKind;
use super::fields::Reader;
use super::place::{LinkRef, Place, SymbolRef, clip};
use super::syntax::{Entry, Form, Node};
use super::values;
use crate::dictionary::Dictionary;
use crate::limits;
use crate::record::Name;
use crate::value::{Value, ValueType};
use alloc::borrow::ToOwned;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::collections::btree_map::Entry as Slot;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// A symbol that is sound by itself.
#[derive(Debug)]
pub(super) struct Symbol {
    pub(super) at: usize,
    pub(super) id: u64,
    pub(super) name: Name,
    pub(super) vertex_type: Name,
    pub(super) attributes: Attributes,
    pub(super) links: Vec<Link>,
}

/// A link that is sound by itself.
#[derive(Debug)]
pub(super) struct Link {
    pub(super) at: usize,
    /// Where it stands in the file's list.
    pub(super) index: usize,
    pub(super) target: u64,
    pub(super) label: Name,
    pub(super) attributes: Attributes,
}

/// By name: the value, and the time in nanoseconds.
pub(super) type Attributes = BTreeMap<Name, (Value, u64)>;

impl Symbol {
    pub(super) fn reference(&self) -> SymbolRef {
        SymbolRef { id: self.id.to_string(), name: Some(self.name.clone()) }
    }

    pub(super) fn place(&self) -> Place {
        Place { symbol: Some(self.reference()), ..Place::default() }
    }

    pub(super) fn link_place(&self, link: &Link) -> Place {
        let link = LinkRef { index: link.index, label: Some(link.label.clone()), target: Some(link.target) };
        Place { link: Some(link), ..self.place() }
    }
}

/// The sound symbols of a file, in its order, and the ids of those left out.
#[derive(Debug, Default)]
pub(super) struct Symbols {
    pub(super) sound: Vec<Symbol>,
    pub(super) broken: Vec<u64>,
}

/// Reads the symbols of a document; everything unsound is left out and becomes a fault.
pub(super) fn read(document: &Node<'_>, dictionary: &Dictionary, faults: &mut Faults) -> Option<Symbols> {
    let mut reader = Reader { dictionary, faults };
    let top = Place::default();
    let Form::Object(entries) = &document.form else {
        let fatal =
            if matches!(document.form, Form::List(_)) { FaultKind::ArrayForm } else { not_a_scene(document) };
        reader.faults.push(document.at, &top, fatal);
        return None;
    };
    let [model] = reader.fields(entries, ["DSRModel"], &top);
    let model = reader.required(document.at, model, "DSRModel", &top)?;
    let [symbols] = {
        let entries = reader.object(model, "`DSRModel`", &top)?;
        reader.fields(entries, ["symbols"], &top)
    };
    let symbols = reader.required(model.at, symbols, "symbols", &top)?;
    if matches!(symbols.form, Form::List(_)) {
        reader.faults.push(symbols.at, &top, FaultKind::ArrayForm);
        return None;
    }
    let mut read = Symbols::default();
    for entry in reader.object(symbols, "`symbols`", &top)? {
        match reader.symbol(entry) {
            Ok(symbol) => read.sound.push(symbol),
            Err(id) => read.broken.extend(id),
        }
    }
    Some(read)
}

fn not_a_scene(document: &Node<'_>) -> FaultKind {
    FaultKind::WrongForm {
        what: "a scene",
        expected: "an object with the key `DSRModel`",
        found: document.describe(),
    }
}

impl Reader<'_> {
    /// A symbol, or the id that a broken one has, if known.
    fn symbol(&mut self, entry: &Entry<'_>) -> Result<Symbol, Option<u64>> {
        let key_id = if values::canonical_digits(&entry.key) { entry.key.parse().ok() } else { None };
        let mut reference = SymbolRef { id: (*entry.key).to_owned(), name: None };
        let mut place = Place { symbol: Some(reference.clone()), ..Place::default() };
        let entries = self.object(&entry.value, "a symbol", &place).ok_or(key_id)?;
        // The name first, so that every fault of the symbol can carry it.
        if let Some(Form::Text(name)) =
            entries.iter().find(|field| field.key == "name").map(|field| &field.value.form)
        {
            reference.name = Some(clip(name).into());
            place.symbol = Some(reference);
        }
        let [id, name, vertex_type, attributes, links] =
            self.fields(entries, ["id", "name", "type", "attribute", "links"], &place);
        let id = self.required(entry.at, id, "id", &place).and_then(|node| self.id(node, &place));
        let name = self
            .required(entry.at, name, "name", &place)
            .and_then(|node| self.name(node, "the name", &place));
        let vertex_type = self.required(entry.at, vertex_type, "type", &place);
        let vertex_type = vertex_type.and_then(|node| self.vertex_type(node, &place));
        let attributes =
            attributes.map(|node| self.attributes(node, "`attribute`", &place)).unwrap_or_default();
        let links = links.map(|node| self.links(node, id, &place)).unwrap_or_default();
        if let Some(id) = id
            && id.to_string() != entry.key
        {
            self.faults.push(entry.at, &place, FaultKind::KeyMismatch { key: (*entry.key).to_owned(), id });
            return Err(Some(id));
        }
        match (id, name, vertex_type) {
            (Some(id), Some(name), Some(vertex_type)) => {
                Ok(Symbol { at: entry.at, id, name, vertex_type, attributes, links })
            }
            _ => Err(id.or(key_id)),
        }
    }

    fn vertex_type(&mut self, node: &Node<'_>, place: &Place) -> Option<Name> {
        let vertex_type = self.name(node, "the type", place)?;
        if crate::is_root_name(&vertex_type) || self.dictionary.allows_type(&vertex_type) {
            return Some(vertex_type);
        }
        self.faults.push(node.at, place, FaultKind::UndeclaredType { vertex_type });
        None
    }

    fn links(&mut self, node: &Node<'_>, source: Option<u64>, place: &Place) -> Vec<Link> {
        let Form::List(nodes) = &node.form else {
            self.wrong_form(node, "`links`", "a list", place);
            return Vec::new();
        };
        nodes.iter().enumerate().filter_map(|(index, node)| self.link(node, index, source, place)).collect()
    }

    fn link(&mut self, node: &Node<'_>, index: usize, source: Option<u64>, symbol: &Place) -> Option<Link> {
        let mut reference = LinkRef { index, label: None, target: None };
        let mut place = Place { link: Some(reference.clone()), ..symbol.clone() };
        let entries = self.object(node, "a link", &place)?;
        let [src, dst, label, attributes] =
            self.fields(entries, ["src", "dst", "label", "linkAttribute"], &place);
        let target = self.required(node.at, dst, "dst", &place).and_then(|node| self.id(node, &place));
        reference.target = target;
        place.link = Some(reference.clone());
        let label = self.required(node.at, label, "label", &place).and_then(|node| self.label(node, &place));
        reference.label.clone_from(&label);
        place.link = Some(reference);
        let stated = self.required(node.at, src, "src", &place).and_then(|node| self.id(node, &place));
        let attributes =
            attributes.map(|node| self.attributes(node, "`linkAttribute`", &place)).unwrap_or_default();
        if let (Some(source_id), Some(source)) = (stated, source)
            && source_id != source
        {
            self.faults.push(node.at, &place, FaultKind::SourceMismatch { source_id });
            return None;
        }
        stated?;
        Some(Link { at: node.at, index, target: target?, label: label?, attributes })
    }

    fn label(&mut self, node: &Node<'_>, place: &Place) -> Option<Name> {
        let label = self.name(node, "the label", place)?;
        if self.dictionary.allows_label(&label) {
            return Some(label);
        }
        self.faults.push(node.at, place, FaultKind::UndeclaredLabel { label });
        None
    }

    fn attributes(&mut self, node: &Node<'_>, what: &'static str, place: &Place) -> Attributes {
        let mut attributes = Attributes::new();
        for entry in self.object(node, what, place).unwrap_or_default() {
            let mut place = place.clone();
            place.attribute = Some(clip(&entry.key).into());
            let Some(name) = self.name_text(entry.at, &entry.key, "the attribute's name", &place) else {
                continue;
            };
            let Some(value) = self.attribute(entry, &name, &place) else { continue };
            match attributes.entry(name) {
                Slot::Vacant(slot) => {
                    slot.insert(value);
                }
                Slot::Occupied(slot) => {
                    self.faults.push(
                        entry.at,
                        &place,
                        FaultKind::RepeatedKey { key: slot.key().as_ref().to_owned() },
                    );
                }
            }
        }
        attributes
    }

    /// An attribute's value and time. `[spec: SCENE-8]` `[spec: SCENE-11]`
    fn attribute(&mut self, entry: &Entry<'_>, name: &Name, place: &Place) -> Option<(Value, u64)> {
        let node = &entry.value;
        let entries = self.object(node, "an attribute", place)?;
        let [tag, value, time] = self.fields(entries, ["type", "value", "timestamp_ns"], place);
        let value = self.required(node.at, value, "value", place);
        let value_type =
            self.required(node.at, tag, "type", place).and_then(|node| self.value_type(node, place))?;
        let timestamp_ns = match time {
            None => 0,
            Some(node) => self.unreadable(values::unsigned_64(node), place)?,
        };
        match self.dictionary.attribute_type(name) {
            None if self.dictionary.closed => {
                self.faults.push(entry.at, place, FaultKind::UndeclaredAttribute);
                return None;
            }
            Some(declared) if declared != value_type => {
                self.faults.push(
                    node.at,
                    place,
                    FaultKind::WrongAttributeType { declared, given: value_type },
                );
                return None;
            }
            _ => {}
        }
        let value = self.unreadable(values::read(value_type, value?), place)?;
        let bytes = value.payload_bytes();
        if bytes > limits::VALUE_BYTES_MAX {
            self.faults.push(node.at, place, FaultKind::ValueSize { bytes });
            return None;
        }
        Some((value, timestamp_ns))
    }

    fn value_type(&mut self, node: &Node<'_>, place: &Place) -> Option<ValueType> {
        let Form::Number(text) = node.form else {
            self.wrong_form(node, "`type`", "a number from 0 to 13", place);
            return None;
        };
        let value_type = text.parse().ok().and_then(ValueType::from_number);
        if value_type.is_none() {
            self.faults.push(node.at, place, FaultKind::UnknownType { text: String::from(text) });
        }
        value_type
    }

    fn unreadable<T>(&mut self, read: Result<T, Box<values::Unreadable>>, place: &Place) -> Option<T> {
        read.map_err(|error| {
            self.faults.push(error.at, &Place { item: error.item, ..place.clone() }, error.kind);
        })
        .ok()
    }
}
