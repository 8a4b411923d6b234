// What the README says of the library, so that a version in which it is different is noticed.
'use strict'

const test = require('node:test')
const assert = require('node:assert')
const CRDT = require('delta-crdts')
const { encode, decode } = require('delta-crdts-msgpack-codec')

const sent = (delta) => decode(encode(delta))

test('law: a removal from aworset does not reach another replica', () => {
  const [a, b] = ['a', 'b'].map(CRDT('aworset'))
  b.apply(sent(a.add('x')))
  b.apply(sent(a.remove('x')))
  assert.deepStrictEqual([a.value().size, b.value().size], [0, 1])
})

test('law: ormap drops a delta that comes late if its key has a value by then', () => {
  const [a, b] = ['a', 'b'].map(CRDT('ormap'))
  const late = sent(a.applySub('k', 'mvreg', 'write', 'late'))
  b.applySub('k', 'mvreg', 'write', 'early')
  b.apply(sent(a.applySub('l', 'mvreg', 'write', 'other')))
  b.apply(late)
  assert.deepStrictEqual([...b.value().k], ['early'])
})

test('law: registers of their own keep both, in whatever order', () => {
  const [a, b] = ['a', 'b'].map(CRDT('mvreg'))
  const late = sent(a.write('late'))
  b.write('early')
  b.apply(late)
  assert.deepStrictEqual([...b.value()].sort(), ['early', 'late'])
})
