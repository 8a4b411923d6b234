//! JSON text to a tree that keeps what scenes need and common parsers lose: the place of every value, the
//! text of every number, and repeated keys. `[spec: SCENE-3]`

use crate::limits;
use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;

/// A value and where it starts, in bytes.
#[derive(Debug)]
pub(super) struct Node<'t> {
    pub(super) at: usize,
    pub(super) form: Form<'t>,
}

/// What a value is.
#[derive(Debug)]
pub(super) enum Form<'t> {
    Null,
    Bool(bool),
    /// Its text, which is a JSON number.
    Number(&'t str),
    Text(Cow<'t, str>),
    List(Vec<Node<'t>>),
    Object(Vec<Entry<'t>>),
}

/// One key of an object, in the order of the file; keys may repeat.
#[derive(Debug)]
pub(super) struct Entry<'t> {
    pub(super) at: usize,
    pub(super) key: Cow<'t, str>,
    pub(super) value: Node<'t>,
}

impl Node<'_> {
    /// What the value is, for people.
    pub(super) const fn describe(&self) -> &'static str {
        match self.form {
            Form::Null => "null",
            Form::Bool(_) => "true or false",
            Form::Number(_) => "a number",
            Form::Text(_) => "text",
            Form::List(_) => "a list",
            Form::Object(_) => "an object",
        }
    }
}

/// Why a text is no JSON. `[spec: SCENE-3]`
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SyntaxError {
    /// The text ends too early.
    #[error("the file ends in the middle: it is cut off")]
    Truncated,
    /// No value starts here.
    #[error("expected a value")]
    NoValue,
    /// No key starts here.
    #[error("expected a key in double quotes")]
    NoKey,
    /// A key is not followed by a colon.
    #[error("expected `:` after the key")]
    NoColon,
    /// An entry of an object is not followed by a comma or the object's end.
    #[error("expected `,` or `}}`")]
    NoObjectEnd,
    /// An item of a list is not followed by a comma or the list's end.
    #[error("expected `,` or `]`")]
    NoListEnd,
    /// A number in no form that JSON has.
    #[error(
        "not a JSON number (no leading zeros, no `+`, digits on both sides of the point; NaN goes in quotes)"
    )]
    Number,
    /// A backslash with no meaning, or half of a surrogate pair.
    #[error(
        "not a JSON escape (allowed: \\\" \\\\ \\/ \\b \\f \\n \\r \\t, \\u with four hex digits, surrogates in pairs)"
    )]
    Escape,
    /// A control character inside text.
    #[error("a control character inside text must be escaped")]
    Control,
    /// Over the limit of nesting.
    #[error("nested deeper than {} levels", limits::SCENE_DEPTH_MAX)]
    TooDeep,
}

/// The first value from `start` on, and where the next text after it starts; or the place and kind of the
/// first fault.
pub(super) fn parse(text: &str, start: usize) -> Result<(Node<'_>, usize), (usize, SyntaxError)> {
    let mut parser = Parser { text, at: start, depth: 0 };
    parser.skip_space();
    let node = parser.value().map_err(|error| (parser.at, error))?;
    parser.skip_space();
    Ok((node, parser.at))
}

struct Parser<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
}

impl<'t> Parser<'t> {
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// The fault here: `error`, unless the text has ended.
    fn fault<T>(&self, error: SyntaxError) -> Result<T, SyntaxError> {
        Err(if self.at >= self.text.len() { SyntaxError::Truncated } else { error })
    }

    fn take(&mut self, byte: u8, otherwise: SyntaxError) -> Result<(), SyntaxError> {
        if self.peek() != Some(byte) {
            return self.fault(otherwise);
        }
        self.at += 1;
        Ok(())
    }

    fn skip_space(&mut self) {
        while matches!(self.peek(), Some(b' ' | b'\t' | b'\n' | b'\r')) {
            self.at += 1;
        }
    }

    fn value(&mut self) -> Result<Node<'t>, SyntaxError> {
        let at = self.at;
        let form = match self.peek() {
            Some(b'{') => self.nested(Self::object)?,
            Some(b'[') => self.nested(Self::list)?,
            Some(b'"') => Form::Text(self.string()?),
            Some(b'-' | b'0'..=b'9') => Form::Number(self.number()?),
            Some(b't') => self.word("true", Form::Bool(true))?,
            Some(b'f') => self.word("false", Form::Bool(false))?,
            Some(b'n') => self.word("null", Form::Null)?,
            _ => return self.fault(SyntaxError::NoValue),
        };
        Ok(Node { at, form })
    }

    fn word(&mut self, word: &str, form: Form<'t>) -> Result<Form<'t>, SyntaxError> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        if rest.starts_with(word) {
            self.at += word.len();
            return Ok(form);
        }
        Err(if word.starts_with(rest) { SyntaxError::Truncated } else { SyntaxError::NoValue })
    }

    fn nested(
        &mut self,
        inner: impl FnOnce(&mut Self) -> Result<Form<'t>, SyntaxError>,
    ) -> Result<Form<'t>, SyntaxError> {
        if self.depth >= limits::SCENE_DEPTH_MAX {
            return Err(SyntaxError::TooDeep);
        }
        self.depth += 1;
        self.at += 1;
        self.skip_space();
        let form = inner(self)?;
        self.depth -= 1;
        Ok(form)
    }

    fn list(&mut self) -> Result<Form<'t>, SyntaxError> {
        let mut items = Vec::new();
        if self.peek() == Some(b']') {
            self.at += 1;
            return Ok(Form::List(items));
        }
        loop {
            items.push(self.value()?);
            self.skip_space();
            if self.peek() == Some(b']') {
                self.at += 1;
                return Ok(Form::List(items));
            }
            self.take(b',', SyntaxError::NoListEnd)?;
            self.skip_space();
        }
    }

    fn object(&mut self) -> Result<Form<'t>, SyntaxError> {
        let mut entries = Vec::new();
        if self.peek() == Some(b'}') {
            self.at += 1;
            return Ok(Form::Object(entries));
        }
        loop {
            let at = self.at;
            if self.peek() != Some(b'"') {
                return self.fault(SyntaxError::NoKey);
            }
            let key = self.string()?;
            self.skip_space();
            self.take(b':', SyntaxError::NoColon)?;
            self.skip_space();
            let value = self.value()?;
            entries.push(Entry { at, key, value });
            self.skip_space();
            if self.peek() == Some(b'}') {
                self.at += 1;
                return Ok(Form::Object(entries));
            }
            self.take(b',', SyntaxError::NoObjectEnd)?;
            self.skip_space();
        }
    }

    fn digits(&mut self) -> Result<(), SyntaxError> {
        let start = self.at;
        while matches!(self.peek(), Some(b'0'..=b'9')) {
            self.at += 1;
        }
        if self.at == start { self.fault(SyntaxError::Number) } else { Ok(()) }
    }

    fn number(&mut self) -> Result<&'t str, SyntaxError> {
        let start = self.at;
        if self.peek() == Some(b'-') {
            self.at += 1;
        }
        if self.peek() == Some(b'0') {
            self.at += 1;
            if matches!(self.peek(), Some(b'0'..=b'9')) {
                return Err(SyntaxError::Number);
            }
        } else {
            self.digits()?;
        }
        if self.peek() == Some(b'.') {
            self.at += 1;
            self.digits()?;
        }
        if matches!(self.peek(), Some(b'e' | b'E')) {
            self.at += 1;
            if matches!(self.peek(), Some(b'+' | b'-')) {
                self.at += 1;
            }
            self.digits()?;
        }
        Ok(self.text.get(start..self.at).unwrap_or_default())
    }

    /// A string, borrowed unless it holds an escape.
    fn string(&mut self) -> Result<Cow<'t, str>, SyntaxError> {
        self.at += 1;
        let mut owned: Option<String> = None;
        loop {
            let start = self.at;
            while matches!(self.peek(), Some(byte) if byte != b'"' && byte != b'\\' && byte >= 0x20) {
                self.at += 1;
            }
            // Both ends lie beside an ASCII byte or the end, so on character boundaries.
            let piece = self.text.get(start..self.at).unwrap_or_default();
            match self.peek() {
                Some(b'"') => {
                    self.at += 1;
                    return Ok(match owned {
                        None => Cow::Borrowed(piece),
                        Some(text) => Cow::Owned(text + piece),
                    });
                }
                Some(b'\\') => {
                    let text = owned.get_or_insert_default();
                    text.push_str(piece);
                    let escaped = self.escape()?;
                    text.push(escaped);
                }
                _ => return self.fault(SyntaxError::Control),
            }
        }
    }

    fn escape(&mut self) -> Result<char, SyntaxError> {
        self.at += 1;
        let escaped = match self.peek() {
            Some(b'"') => '"',
            Some(b'\\') => '\\',
            Some(b'/') => '/',
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => return self.unicode_escape(),
            _ => return self.fault(SyntaxError::Escape),
        };
        self.at += 1;
        Ok(escaped)
    }

    fn unicode_escape(&mut self) -> Result<char, SyntaxError> {
        let first = self.hex4()?;
        let code = if (0xd800..0xdc00).contains(&first) {
            if self.peek() != Some(b'\\') {
                return self.fault(SyntaxError::Escape);
            }
            self.at += 1;
            if self.peek() != Some(b'u') {
                return self.fault(SyntaxError::Escape);
            }
            let second = self.hex4()?;
            if !(0xdc00..0xe000).contains(&second) {
                return Err(SyntaxError::Escape);
            }
            0x1_0000 + ((first - 0xd800) << 10) + (second - 0xdc00)
        } else {
            first
        };
        char::from_u32(code).ok_or(SyntaxError::Escape)
    }

    /// Past the `u` and its four digits.
    fn hex4(&mut self) -> Result<u32, SyntaxError> {
        self.at += 1;
        let mut code = 0;
        for _ in 0..4 {
            let digit = self.peek().and_then(|byte| char::from(byte).to_digit(16));
            let Some(digit) = digit else { return self.fault(SyntaxError::Escape) };
            code = code * 16 + digit;
            self.at += 1;
        }
        Ok(code)
    }
}
