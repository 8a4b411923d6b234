// The npm package delta-crdts as an adapter: one request a line, one reply a line, as spec/conformance.md says.
// The mapping is in graph.js and explained in README.md; here is the protocol alone.
'use strict'

const json = require('./json')
const { Replica, Refused, joined, hung, before } = require('./graph')
const { version } = require('delta-crdts/package.json')

/** Why a request is not done. */
class Declined extends Error {
  constructor (code, message) {
    super(message)
    this.code = code
  }
}

const rejected = (message) => new Declined('rejected_input', message)

// What objects have: `?` may be missing, of `a|b` exactly one is there. All are texts but those of KINDS.
const EDGE = 'from label to'
const COMMANDS = {
  hello: 'protocols spec corpus',
  case_begin: 'case replicas dictionary?',
  mutate: 'replica mutations',
  deliver: 'replica delta',
  read: 'replica',
  group: 'deltas',
  lookup: 'replica name',
  restart: 'replica keeps',
  answer: 'from to'
}
const MUTATIONS = {
  add_vertex: 'as type name link attributes?',
  add_edge: 'from label to attributes?',
  update_attributes: 'vertex|edge attributes',
  remove_edge: EDGE,
  move_edge: 'old new attributes?',
  remove_vertex: 'vertex'
}
const PARTS = {
  link: 'from|to label attributes?',
  edge: EDGE,
  old: EDGE,
  new: EDGE,
  dictionary: 'closed? vertex_types? edge_labels? functional_labels? attributes?'
}
const isObject = (value) => value !== null && typeof value === 'object' && !Array.isArray(value)
const KINDS = { keeps: (value) => typeof value === 'boolean', closed: (value) => typeof value === 'boolean' }
for (const name of ['attributes', ...Object.keys(PARTS)]) KINDS[name] = isObject
for (const name of ['protocols', 'replicas', 'mutations', 'deltas', 'vertex_types', 'edge_labels', 'functional_labels']) KINDS[name] = Array.isArray
const isText = (value) => typeof value === 'string'

function shape (wanted, given) {
  const parts = wanted.split(' ').map((part) => ({ names: part.replace('?', '').split('|'), optional: part.endsWith('?') }))
  const known = parts.flatMap(({ names }) => names)
  if (!isObject(given) || !Object.keys(given).every((name) => known.includes(name))) throw rejected(`not {${wanted}}`)
  for (const { names, optional } of parts) {
    const count = names.filter((name) => Object.hasOwn(given, name)).length
    if (count > 1 || (count === 0 && !optional)) throw rejected(`not {${wanted}}`)
  }
  for (const [name, value] of Object.entries(given)) {
    if (!(KINDS[name] ?? isText)(value)) throw rejected(`${name} is of another kind`)
    if (Object.hasOwn(PARTS, name)) shape(PARTS[name], value)
  }
}

/** The name and the value of an object's one member. */
function only (shapes, given, code) {
  if (!isObject(given) || Object.keys(given).length !== 1) throw rejected('not an object with one member')
  const [[name, value]] = Object.entries(given)
  if (!Object.hasOwn(shapes, name)) throw new Declined(code, `${name} is not known`)
  shape(shapes[name], value)
  return [name, value]
}

function known (named, name) {
  if (!named.has(name)) throw new Declined('unknown', `nobody has named ${JSON.stringify(name)}`)
  return named.get(name)
}

class Adapter {
  constructor () {
    this.case_begin({ replicas: [] })
  }

  hello ({ protocols }) {
    if (!protocols.includes(1)) throw new Declined('unsupported', 'this adapter speaks protocol 1')
    return {
      protocol: 1,
      implementation: { name: 'delta-crdts', version, language: 'JavaScript', source: 'https://www.npmjs.com/package/delta-crdts' },
      profiles: ['observe'],
      features: ['dictionary', 'lookup', 'grouping', 'restart', 'resynchronisation'],
      limits: { line_bytes: 1 << 20, replicas: 64 }
    }
  }

  case_begin ({ replicas, dictionary = {} }) {
    this.dictionary = { closed: false, vertex_types: [], edge_labels: [], functional_labels: [], attributes: {}, ...dictionary }
    this.replicas = new Map(replicas.map((name, place) => [name, new Replica([place, 0], this.dictionary)]))
    this.deltas = new Map()
    this.handles = new Set(['root'])
    return {}
  }

  mutate ({ replica, mutations }) {
    const bound = new Set(this.handles)
    const group = mutations.map((mutation) => only(MUTATIONS, mutation, 'rejected_input'))
    for (const [, given] of group) {
      for (const part of [given, given.link, given.edge, given.old, given.new]) {
        for (const handle of [part?.from, part?.to, part?.vertex]) {
          if (handle !== undefined && !bound.has(handle)) throw new Declined('unknown', `no vertex has the handle ${JSON.stringify(handle)}`)
        }
      }
      if (given.as === undefined) continue
      if (bound.has(given.as)) throw rejected('the handle is bound already')
      bound.add(given.as)
    }
    const delta = known(this.replicas, replica).mutate(group)
    this.handles = bound
    return this.keep(delta)
  }

  keep (delta) {
    const name = `d${this.deltas.size}`
    this.deltas.set(name, delta)
    return { delta: name }
  }

  deliver ({ replica, delta }) {
    known(this.replicas, replica).apply(known(this.deltas, delta))
    return {}
  }

  read ({ replica }) {
    const shown = known(this.replicas, replica).shown()
    const attributes = (element) => new Map([...element.attributes].map(([name, text]) => [name, JSON.parse(text)]))
    const vertices = new Map()
    for (const [id, vertex] of shown.vertices) {
      if (id !== 'root') vertices.set(id, { type: vertex.type, name: vertex.name, attributes: attributes(vertex) })
    }
    const edges = [...shown.edges.values()].map((edge) => ({ from: edge.from, label: edge.label, to: edge.to, attributes: attributes(edge) }))
    return { view: { vertices, edges, root: { attributes: attributes(shown.vertices.get('root')) }, hung: hung(shown) } }
  }

  lookup ({ replica, name }) {
    const { vertices } = known(this.replicas, replica).shown()
    if (name === 'root' || name === 'world') return { vertex: 'root' }
    const found = [...vertices].filter(([, vertex]) => vertex.name === name).sort(([, a], [, b]) => before(a, b))
    return { vertex: found[0]?.[0] ?? null }
  }

  group ({ deltas }) {
    return this.keep(joined(deltas.map((delta) => known(this.deltas, delta))))
  }

  restart ({ replica, keeps }) {
    const old = known(this.replicas, replica)
    const fresh = new Replica([old.by[0], old.by[1] + 1], this.dictionary)
    if (keeps) fresh.apply(old.state())
    this.replicas.set(replica, fresh)
    return {}
  }

  answer ({ from, to }) {
    known(this.replicas, to)
    return this.keep(known(this.replicas, from).state())
  }
}

function reply (adapter, line) {
  const { value: request, twice } = json.read(line)
  if (!Number.isSafeInteger(request?.id)) throw new Error('a request without id')
  try {
    if (twice || Object.keys(request).length !== 2 || !Object.hasOwn(request, 'do')) throw rejected('not {id, do}, or a key stands twice')
    const [name, given] = only(COMMANDS, request.do, 'unsupported')
    return { id: request.id, ok: adapter[name](given) }
  } catch (error) {
    const code = error instanceof Refused ? 'refused' : error instanceof Declined ? error.code : 'internal'
    return { id: request.id, error: { code, message: error.message } }
  }
}

/** Lines end with a line feed and with nothing else: `readline` would also end them within texts, at U+2028. */
async function * lines (input) {
  const utf8 = new TextDecoder('utf-8', { fatal: true })
  let rest = Buffer.alloc(0)
  for await (const piece of input) {
    rest = Buffer.concat([rest, piece])
    for (let end = rest.indexOf(10); end >= 0; end = rest.indexOf(10)) {
      yield utf8.decode(rest.subarray(0, end))
      rest = rest.subarray(end + 1)
    }
  }
}

async function main () {
  const adapter = new Adapter()
  for await (const line of lines(process.stdin)) process.stdout.write(json.write(reply(adapter, line)) + '\n')
}

main().catch((error) => {
  console.error(`the conversation ends: ${error.message}`)
  process.exitCode = 1
})
