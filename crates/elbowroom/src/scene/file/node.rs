use super::Location;

/// A value of the text, with its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub(super) at: Location,
    pub(super) kind: Kind,
}

/// What a value is.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Kind {
    /// One word or number; `quoted` text is never a number.
    Scalar { text: String, quoted: bool },
    /// Values in order.
    List(Vec<Node>),
    /// Values by key, in the order of the text.
    Map(Vec<Entry>),
}

/// A key of a mapping and its value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) key_at: Location,
    pub(super) value: Node,
}

impl Node {
    /// What it is, in words.
    pub(super) fn in_words(&self) -> String {
        match &self.kind {
            Kind::Scalar { text, quoted: false } if text.is_empty() || text == "~" || text == "null" => {
                "nothing".to_owned()
            }
            Kind::Scalar { text, quoted: true } => format!("the text \"{}\"", shortened(text)),
            Kind::Scalar { text, .. } => shortened(text),
            Kind::List(values) => format!("a list of {}", values.len()),
            Kind::Map(_) => "a mapping".to_owned(),
        }
    }
}

fn shortened(text: &str) -> String {
    const MOST: usize = 40;
    if text.chars().count() <= MOST {
        return text.escape_debug().to_string();
    }
    let start: String = text.chars().take(MOST).collect();
    format!("{}...", start.escape_debug())
}
