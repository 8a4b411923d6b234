// Reads JSON strictly and writes it exactly: no key stands twice, and what is no number of JavaScript's printing stays (-0).
'use strict'

/** A text as a value. Every member of an object has one colon outside of texts; if one is left over, a key stood twice. */
function read (text) {
  const value = JSON.parse(text)
  const colons = text.replace(/"(?:[^"\\]|\\.)*"/g, '').split(':').length - 1
  return { value, twice: colons !== members(value) }
}

function members (value) {
  if (value === null || typeof value !== 'object') return 0
  const below = Object.values(value).reduce((sum, one) => sum + members(one), 0)
  return below + (Array.isArray(value) ? 0 : Object.keys(value).length)
}

/** A value as a text; a `Map` is an object, so that a key may be `__proto__`. */
function write (value) {
  if (Object.is(value, -0)) return '-0.0'
  if (value === null || typeof value !== 'object') return JSON.stringify(value)
  if (Array.isArray(value)) return `[${value.map(write).join(',')}]`
  const pairs = value instanceof Map ? [...value] : Object.entries(value)
  return `{${pairs.map(([key, one]) => `${JSON.stringify(key)}:${write(one)}`).join(',')}}`
}

module.exports = { read, write }
