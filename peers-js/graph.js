// The graph on delta-crdts: the layout, what is shown, the six mutations. The README explains the mapping.
//
// A replica is a set of registers, each a `mvreg` of the library, as a C++ user of the same family keeps a map of `mvreg`s:
//   ["vertex", id]                  {type, name}
//   ["parent", child]               an edge of label RT: a child has one parent
//   ["one", from, label]            an edge of a functional label: a source has one
//   ["edge", from, label, to]       any other edge
//   ["attribute", element, name]    a value; the element is ["vertex", id] or ["edge", the id of the edge's instance]
// What is written is {at, by, …}: a Lamport stamp and the author, by which readers choose among concurrent values. Removed is
// {gone: true}: it supersedes what its author saw, and a concurrent value stands beside it and is shown.
'use strict'

const CRDT = require('delta-crdts')
const { encode, decode } = require('delta-crdts-msgpack-codec')
const json = require('./json')

const Register = CRDT('mvreg')
const join = CRDT.type('mvreg').join

/** Mutations that must not be made. */
class Refused extends Error {}

function check (holds, message) {
  if (!holds) throw new Refused(message)
}

const bytes = (text) => Buffer.byteLength(text)
const fits = (text) => bytes(text) >= 1 && bytes(text) <= 255
const before = (a, b) => a.at - b.at || a.by[0] - b.by[0] || a.by[1] - b.by[1] || a.made - b.made

/** Deltas made one, register by register, by the library's join. */
function joined (deltas) {
  const whole = new Map()
  for (const delta of deltas) {
    for (const [key, bits] of delta) {
      const one = decode(bits)
      whole.set(key, whole.has(key) ? encode(join(decode(whole.get(key)), one)) : bits)
    }
  }
  return whole
}

class Replica {
  /** `by` is [the replica's place among all, its incarnation]; no two replicas ever have the same. */
  constructor (by, dictionary) {
    this.by = by
    this.dictionary = dictionary
    this.registers = new Map()
    this.made = 0
  }

  /** Joins a delta, or a whole state. */
  apply (delta) {
    for (const [key, bits] of delta) this.register(key).apply(decode(bits))
  }

  /** The whole state, as a delta. */
  state () {
    return new Map([...this.registers].map(([key, register]) => [key, encode(register.state())]))
  }

  /** Makes all mutations and returns one delta, or throws and changes nothing. */
  mutate (mutations) {
    const draft = new Replica(this.by, this.dictionary)
    draft.apply(this.state())
    draft.made = this.made
    draft.deltas = []
    for (const [name, given] of mutations) {
      const shown = draft.shown()
      draft[name](given, shown)
      if (/^(remove|move)/.test(name)) {
        const were = stranded(shown)
        check([...stranded(draft.shown())].every((vertex) => were.has(vertex)), 'a vertex would lose its last path or its parent')
      }
    }
    this.registers = draft.registers
    this.made = draft.made
    return joined(draft.deltas)
  }

  register (key) {
    if (!this.registers.has(key)) this.registers.set(key, Register(this.by.join('+')))
    return this.registers.get(key)
  }

  put (place, value) {
    const key = JSON.stringify(place)
    this.deltas.push(new Map([[key, encode(this.register(key).write(value))]]))
  }

  /** The head of what a mutation writes. */
  stamp (shown) {
    return { at: shown.clock + 1, by: this.by, made: ++this.made }
  }

  /** What a reader sees: of concurrent values the greatest, edges between vertices that exist, attributes of what is shown. */
  shown () {
    const vertices = new Map([['root', { attributes: new Map() }]])
    const [edges, claims, values] = [new Map(), [], []]
    let clock = 0
    for (const [key, register] of this.registers) {
      const held = [...register.value()].filter((value) => !value.gone).sort(before)
      for (const value of held) clock = Math.max(clock, value.at)
      const place = JSON.parse(key)
      if (held.length === 0) continue
      if (place[0] === 'vertex') vertices.set(place[1], { ...held.at(-1), attributes: new Map() })
      else if (place[0] === 'attribute') values.push([place, held.at(-1)])
      else claims.push(held)
    }
    const instances = new Map([...vertices].map(([id, vertex]) => [JSON.stringify(['vertex', id]), vertex]))
    for (const held of claims) {
      const edge = held.filter(({ from, to }) => vertices.has(from) && vertices.has(to)).at(-1)
      if (!edge) continue
      const shown = { ...edge, attributes: new Map() }
      edges.set(keyOf(edge), shown)
      instances.set(JSON.stringify(elementOf(edge)), shown)
    }
    for (const [[, element, name], { value }] of values) instances.get(JSON.stringify(element))?.attributes.set(name, value)
    const parents = new Map([...edges.values()].filter(({ label }) => label === 'RT').map(({ from, to }) => [to, from]))
    return { vertices, edges, parents, clock }
  }

  // The mutations; each gets what the protocol gives, and what the draft shows before.

  add_vertex ({ as: id, type, name, attributes = {}, link }, shown) {
    check(fits(type) && fits(name), 'type or name is empty or too long')
    check(!this.dictionary.closed || this.dictionary.vertex_types.includes(type), 'the type is not declared')
    check(name !== 'root' && name !== 'world', 'the name is reserved')
    check(![...shown.vertices.values()].some((vertex) => vertex.name === name), 'the name is taken')
    check('from' in link || link.label !== 'RT', 'a new vertex is nobody\'s parent')
    const stamp = this.stamp(shown)
    this.put(['vertex', id], { ...stamp, type, name })
    this.write(['vertex', id], attributes, stamp)
    shown.vertices.set(id, { type, name, attributes: new Map() })
    this.link({ from: link.from ?? id, label: link.label, to: link.to ?? id }, link.attributes ?? {}, shown, stamp)
  }

  add_edge ({ from, label, to, attributes = {} }, shown) {
    this.link({ from, label, to }, attributes, shown, this.stamp(shown))
  }

  link (edge, attributes, shown, stamp) {
    const { from, label, to } = edge
    check(fits(label), 'the label is empty or too long')
    check(!this.dictionary.closed || label === 'RT' || this.dictionary.edge_labels.includes(label), 'the label is not declared')
    check(shown.vertices.has(from) && shown.vertices.has(to), 'an end is not in the graph')
    check(from !== to, 'both ends are the same')
    check(!shown.edges.has(keyOf(edge)), 'the edge is there already')
    if (label === 'RT') {
      check(to !== 'root', 'the root has no parent')
      check(!shown.parents.has(to), 'the child has a parent')
      check(inTree(from, shown), 'the parent is not in the tree')
      check(!ancestors(from, shown).has(to), 'the child is above its parent')
    } else if (this.functional(label)) {
      check(![...shown.edges.values()].some((one) => one.from === from && one.label === label), 'the source has one already')
    }
    const value = { ...stamp, ...edge, id: [...this.by, stamp.made] }
    this.put(this.placeOf(edge), value)
    this.write(elementOf(value), attributes, stamp)
  }

  update_attributes ({ vertex, edge, attributes }, shown) {
    const target = edge ? shown.edges.get(keyOf(edge)) : shown.vertices.get(vertex)
    check(target, 'the target is not in the graph')
    check(Object.keys(attributes).length > 0, 'no attribute is given')
    check(Object.entries(attributes).every(([name, value]) => value || target.attributes.has(name)), 'what is to be unset is not set')
    this.write(edge ? elementOf(target) : ['vertex', vertex], attributes, this.stamp(shown))
  }

  write (element, attributes, stamp) {
    const names = Object.keys(attributes)
    check(names.length <= 1024 && names.every(fits), 'too many attributes, or the name of one is empty or too long')
    for (const name of names) {
      const declared = Object.hasOwn(this.dictionary.attributes, name) ? this.dictionary.attributes[name] : undefined
      check(declared || !this.dictionary.closed, 'the attribute is not declared')
      const value = attributes[name]
      check(!value || !declared || value.type === declared, 'the value has not the type declared')
      this.put(['attribute', element, name], value ? { ...stamp, value: json.write(value) } : { gone: true })
    }
  }

  remove_edge (edge, shown) {
    check(shown.edges.has(keyOf(edge)), 'the edge is not in the graph')
    this.put(this.placeOf(edge), { gone: true })
  }

  move_edge ({ old, new: next, attributes = {} }, shown) {
    check(shown.edges.has(keyOf(old)), 'the edge is not in the graph')
    check(keyOf(old) !== keyOf(next), 'the edge would stay where it is')
    const stamp = this.stamp(shown)
    this.put(this.placeOf(old), { gone: true })
    this.link({ from: next.from, label: next.label, to: next.to }, attributes, this.shown(), stamp)
  }

  remove_vertex ({ vertex }, shown) {
    check(shown.vertices.has(vertex) && vertex !== 'root', 'the vertex is the root, or not in the graph')
    this.put(['vertex', vertex], { gone: true })
  }

  functional (label) {
    return label !== 'RT' && this.dictionary.functional_labels.includes(label)
  }

  /** Where an edge is kept: edges that exclude each other share a register. */
  placeOf ({ from, label, to }) {
    if (label === 'RT') return ['parent', to]
    return this.functional(label) ? ['one', from, label] : ['edge', from, label, to]
  }
}

const keyOf = ({ from, label, to }) => JSON.stringify([from, label, to])
const elementOf = (edge) => ['edge', edge.id]

function inTree (vertex, { parents }) {
  return vertex === 'root' || parents.has(vertex) || [...parents.values()].includes(vertex)
}

function ancestors (vertex, { parents }) {
  const found = new Set()
  for (let one = vertex; one !== undefined && !found.has(one); one = parents.get(one)) found.add(one)
  return found
}

/** Each vertex with the set of those that edges join it to, whatever their direction. */
function components ({ vertices, edges }) {
  const of = new Map([...vertices.keys()].map((id) => [id, new Set([id])]))
  for (const { from, to } of edges.values()) {
    const [a, b] = [of.get(from), of.get(to)]
    if (a === b) continue
    for (const id of b) of.set(id, a.add(id))
  }
  return of
}

/** Who has children and no parent. */
function detached ({ vertices, parents }) {
  const above = new Set(parents.values())
  return [...vertices.keys()].filter((id) => id !== 'root' && above.has(id) && !parents.has(id))
}

/** Who is detached, or has no path to the root. */
function stranded (shown) {
  const of = components(shown)
  return new Set([...[...shown.vertices.keys()].filter((id) => !of.get(id).has('root')), ...detached(shown)])
}

/** Who is shown below the root without an edge: the detached, and the oldest of those that nothing joins to the root. */
function hung (shown) {
  const found = detached(shown)
  for (const component of new Set(components(shown).values())) {
    if (component.has('root') || found.some((id) => component.has(id))) continue
    found.push([...component].sort((a, b) => before(shown.vertices.get(a), shown.vertices.get(b)))[0])
  }
  return found
}

module.exports = { Replica, Refused, joined, hung, before }
