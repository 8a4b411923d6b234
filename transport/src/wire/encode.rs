//! Writing datagrams. `[spec: LINK-3]`

use super::{
    Datagram, GROUP_STREAM, Item, MAGIC, Missing, NAME_BYTES_MAX, Part, VERSION, WANTED_MAX, check_of,
};
use crate::origin::Origin;

/// Where the check stands.
const CHECK: std::ops::Range<usize> = 3..11;

impl Datagram {
    /// The bytes of the datagram, for a group.
    pub fn encode(&self, group: u32) -> Vec<u8> {
        let mut out = begin(self.sender, group);
        for item in &self.items {
            item.write(&mut out);
        }
        finish(out, group)
    }
}

/// A datagram without items; [`Item::write`] adds them.
pub(crate) fn begin(sender: Origin, group: u32) -> Vec<u8> {
    let mut out = Vec::with_capacity(256);
    out.extend(MAGIC);
    out.push(VERSION);
    out.extend([0; 8]);
    out.extend(group.to_le_bytes());
    origin(&mut out, sender);
    out
}

/// Fills in the check.
pub(crate) fn finish(mut out: Vec<u8>, group: u32) -> Vec<u8> {
    let check = check_of(group, &out[CHECK.end..]);
    out[CHECK].copy_from_slice(&check.to_le_bytes());
    out
}

pub(super) const TAG_WHOLE: u8 = 1;
pub(super) const TAG_PART: u8 = 2;
pub(super) const TAG_WANT: u8 = 3;
pub(super) const TAG_GONE: u8 = 4;
pub(super) const TAG_ACK: u8 = 5;
pub(super) const TAG_BEAT: u8 = 6;
pub(super) const TAG_HELLO: u8 = 7;
pub(super) const TAG_OBJECT: u8 = 8;
pub(super) const TAG_BYE: u8 = 9;

impl Item {
    /// Adds the item to a datagram that has begun.
    pub(crate) fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Part(part) => write_part(out, part),
            Self::Want { origin: whose, stream, missing } => {
                out.push(TAG_WANT);
                origin(out, *whose);
                number(out, u64::from(*stream));
                write_missing(out, missing);
            }
            Self::Gone { stream, below } => {
                out.push(TAG_GONE);
                number(out, u64::from(*stream));
                number(out, *below);
            }
            Self::Ack { stream, below, received } => {
                out.push(TAG_ACK);
                number(out, u64::from(*stream));
                number(out, *below);
                number(out, *received);
            }
            Self::Beat { high, oldest, fingerprint, name } => {
                out.push(TAG_BEAT);
                number(out, *high);
                number(out, *oldest);
                out.push(u8::from(fingerprint.is_some()));
                if let Some(fingerprint) = fingerprint {
                    out.extend(fingerprint.to_le_bytes());
                }
                text(out, name);
            }
            Self::Hello { name } => {
                out.push(TAG_HELLO);
                text(out, name);
            }
            Self::Object { to, name } => {
                out.push(TAG_OBJECT);
                origin(out, *to);
                text(out, name);
            }
            Self::Bye => out.push(TAG_BYE),
        }
    }
}

fn write_part(out: &mut Vec<u8>, part: &Part) {
    out.push(if part.count == 1 { TAG_WHOLE } else { TAG_PART });
    number(out, u64::from(part.stream));
    if part.stream != GROUP_STREAM {
        out.extend(part.to.to_le_bytes());
    }
    number(out, part.number);
    if part.count != 1 {
        number(out, u64::from(part.index));
        number(out, u64::from(part.count));
        number(out, u64::from(part.total));
    }
    number(out, part.bytes.len() as u64);
    out.extend(&part.bytes);
}

/// At most [`WANTED_MAX`] runs; the rest is asked for later.
fn write_missing(out: &mut Vec<u8>, missing: &[Missing]) {
    let missing = &missing[..missing.len().min(WANTED_MAX)];
    number(out, missing.len() as u64);
    for Missing { first, last, parts } in missing {
        number(out, *first);
        number(out, last - first);
        let parts = &parts[..parts.len().min(WANTED_MAX)];
        number(out, parts.len() as u64);
        for (first, last) in parts {
            number(out, u64::from(*first));
            number(out, u64::from(last - first));
        }
    }
}

fn origin(out: &mut Vec<u8>, origin: Origin) {
    out.extend(origin.replica.agent.to_le_bytes());
    out.extend(origin.replica.incarnation.to_le_bytes());
    out.extend(origin.nonce.to_le_bytes());
}

fn number(out: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        out.push(value.to_le_bytes()[0] | 0x80);
        value >>= 7;
    }
    out.push(value.to_le_bytes()[0]);
}

fn text(out: &mut Vec<u8>, text: &str) {
    let mut end = text.len().min(NAME_BYTES_MAX);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    number(out, end as u64);
    out.extend(&text.as_bytes()[..end]);
}
