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
    /// Whether it is YAML's null.
    pub(super) fn is_nothing(&self) -> bool {
        let Kind::Scalar { text, quoted: false } = &self.kind else { return false };
        matches!(text.as_str(), "" | "~" | "null" | "Null" | "NULL")
    }

    /// What it is, in words.
    pub(super) fn in_words(&self) -> String {
        match &self.kind {
            Kind::Scalar { .. } if self.is_nothing() => "nothing".to_owned(),
            Kind::Scalar { text, quoted: true } => format!("the text \"{}\"", shortened(text)),
            Kind::Scalar { text, .. } => shortened(text),
            Kind::List(values) => format!("a list of {}", values.len()),
            Kind::Map(_) => "a mapping".to_owned(),
        }
    }
}

/// The text as it can stand in a message of one line.
pub(super) fn shortened(text: &str) -> String {
    const MOST: usize = 40;
    let mut shown = String::new();
    for letter in text.chars().take(MOST) {
        match letter {
            '\'' => shown.push(letter),
            _ => shown.extend(letter.escape_debug()),
        }
    }
    if text.chars().nth(MOST).is_some() {
        shown.push_str("...");
    }
    shown
}
