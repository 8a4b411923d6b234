//! Reading datagrams: any bytes may be given. `[spec: LINK-3]`

use super::encode::{
    TAG_ACK, TAG_BEAT, TAG_BYE, TAG_GONE, TAG_HELLO, TAG_OBJECT, TAG_PART, TAG_WANT, TAG_WHOLE,
};
use super::reader::Reader;
use super::{
    Datagram, GROUP_STREAM, Item, MAGIC, MESSAGE_BYTES_MAX, Missing, NAME_BYTES_MAX, PARTS_MAX, Part,
    VERSION, WANTED_MAX, WireError, check_of, part_bounds,
};
use crate::origin::Origin;
use dsr_core::ReplicaId;

impl Datagram {
    /// Reads a datagram of a group. Never panics; allocates no more than a small multiple of the bytes given.
    pub fn decode(bytes: &[u8], group: u32) -> Result<Self, WireError> {
        let mut reader = Reader::new(bytes);
        if reader.array("the beginning").ok() != Some(MAGIC) {
            return Err(WireError::Magic);
        }
        let [found] = reader.array("the version")?;
        if found != VERSION {
            return Err(WireError::Version { found });
        }
        let check = reader.u64("the check")?;
        if check != check_of(group, reader.rest()) {
            return Err(WireError::Check);
        }
        let found = reader.u32("the group")?;
        if found != group {
            return Err(WireError::Group { found, expected: group });
        }
        let sender = origin(&mut reader)?;
        let mut items = Vec::new();
        while reader.left() > 0 {
            items.push(item(&mut reader)?);
        }
        Ok(Self { sender, items })
    }
}

fn item(reader: &mut Reader<'_>) -> Result<Item, WireError> {
    let offset = reader.offset();
    let [tag] = reader.array("a tag")?;
    Ok(match tag {
        TAG_WHOLE | TAG_PART => Item::Part(part(reader, tag == TAG_WHOLE)?),
        TAG_WANT => {
            Item::Want { origin: origin(reader)?, stream: stream(reader)?, missing: missing(reader)? }
        }
        TAG_GONE => Item::Gone { stream: stream(reader)?, below: reader.number("a number", 1, u64::MAX)? },
        TAG_ACK => Item::Ack {
            stream: reader.small("a stream", 1, u32::MAX)?,
            below: reader.number("a number", 1, u64::MAX)?,
            received: reader.number("a count of bytes", 0, u64::MAX)?,
        },
        TAG_BEAT => {
            let high = reader.number("a number", 0, u64::MAX - 1)?;
            let oldest = reader.number("a number", 1, u64::MAX)?;
            let known = reader.small("a flag", 0, 1)? == 1;
            let fingerprint =
                if known { Some(u128::from_le_bytes(reader.array("a fingerprint")?)) } else { None };
            Item::Beat { high, oldest, fingerprint, name: name(reader)? }
        }
        TAG_HELLO => Item::Hello { name: name(reader)? },
        TAG_OBJECT => Item::Object { to: origin(reader)?, name: name(reader)? },
        TAG_BYE => Item::Bye,
        found => return Err(WireError::Tag { offset, found }),
    })
}

fn part(reader: &mut Reader<'_>, whole: bool) -> Result<Part, WireError> {
    let stream = stream(reader)?;
    let to = if stream == GROUP_STREAM { 0 } else { reader.u64("a nonce")? };
    let number = reader.number("a number", 1, u64::MAX - 1)?;
    let max = u32::try_from(MESSAGE_BYTES_MAX).unwrap_or(u32::MAX);
    let (index, count, total) = if whole {
        (0, 1, None)
    } else {
        let index = reader.small("a part", 0, PARTS_MAX - 1)?;
        (index, reader.small("a number of parts", 2, PARTS_MAX)?, Some(reader.small("a size", 1, max)?))
    };
    let offset = reader.offset();
    let length = reader.small("a length", 1, max)?;
    let total = total.unwrap_or(length);
    let bytes = reader.take(usize::try_from(length).unwrap_or(usize::MAX), "a part")?.to_vec();
    let fits = part_bounds(total, count, index).is_some_and(|(first, end)| end - first == bytes.len());
    if !fits {
        return Err(WireError::PartLength { offset, index, count, total, found: bytes.len() });
    }
    Ok(Part { stream, to, number, index, count, total, bytes })
}

fn missing(reader: &mut Reader<'_>) -> Result<Vec<Missing>, WireError> {
    let count = reader.count("a number of runs", WANTED_MAX, 3)?;
    let mut missing = Vec::with_capacity(count);
    for _ in 0..count {
        let first = reader.number("a number", 1, u64::MAX - 1)?;
        let last = first + reader.number("a length", 0, u64::MAX - 1 - first)?;
        let runs = reader.count("a number of runs", WANTED_MAX, 2)?;
        let mut parts = Vec::with_capacity(runs);
        for _ in 0..runs {
            let first = reader.small("a part", 0, PARTS_MAX - 1)?;
            parts.push((first, first + reader.small("a length", 0, PARTS_MAX - 1 - first)?));
        }
        missing.push(Missing { first, last, parts });
    }
    Ok(missing)
}

fn stream(reader: &mut Reader<'_>) -> Result<u32, WireError> {
    reader.small("a stream", 0, u32::MAX)
}

fn origin(reader: &mut Reader<'_>) -> Result<Origin, WireError> {
    let replica = ReplicaId { agent: reader.u32("an agent")?, incarnation: reader.u32("an incarnation")? };
    Ok(Origin { replica, nonce: reader.u64("a nonce")? })
}

fn name(reader: &mut Reader<'_>) -> Result<String, WireError> {
    reader.text("a name", NAME_BYTES_MAX)
}
