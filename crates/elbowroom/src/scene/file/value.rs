use super::Location;
use super::error::{ParseProblem, SceneError};
use super::keys::Keys;
use super::node::{Entry, Kind, Node, shortened};
use crate::geometry::Point;
use crate::units::Units;

/// Greatest length or coordinate (m): beyond it the last digits of a position are no longer nanometres.
const GREATEST_LENGTH: f64 = 1e6;

/// A problem with its place, before the file's name is known.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) at: Option<Location>,
    pub(super) key: String,
    pub(super) problem: ParseProblem,
}

impl Fault {
    pub(super) fn in_file(self, file: &str, units: Units) -> SceneError {
        let problem = self.problem.in_units(units);
        SceneError { file: file.to_owned(), location: self.at, key: self.key, problem }
    }
}

/// The path to `name` in the mapping at `parent`; fit for a message, whatever the user's names look like.
pub(super) fn child(parent: &str, name: &str) -> String {
    let name = shortened(name);
    if parent.is_empty() { name } else { format!("{parent}.{name}") }
}

/// A node and the path of keys to it.
pub(super) struct Value<'a> {
    node: &'a Node,
    key: String,
}

/// A mapping whose keys are known to be sound.
pub(super) struct Map<'a> {
    value: &'a Value<'a>,
    entries: &'a [Entry],
}

impl<'a> Value<'a> {
    pub(super) fn root(node: &'a Node) -> Self {
        Self { node, key: String::new() }
    }

    pub(super) fn at(&self) -> Location {
        self.node.at
    }

    pub(super) fn fault(&self, problem: ParseProblem) -> Fault {
        Fault { at: Some(self.node.at), key: self.key.clone(), problem }
    }

    pub(super) fn in_words(&self) -> String {
        self.node.in_words()
    }

    pub(super) fn shape(&self, allowed: impl Into<String>) -> Fault {
        self.fault(ParseProblem::Shape { found: self.node.in_words(), allowed: allowed.into() })
    }

    pub(super) fn out_of_range(&self, allowed: impl Into<Box<str>>) -> Fault {
        self.fault(ParseProblem::OutOfRange { found: self.node.in_words(), allowed: allowed.into() })
    }

    /// The value of `key`, if this is a mapping that has it, sound or not.
    pub(super) fn peek(&self, key: &str) -> Option<Value<'a>> {
        let Kind::Map(entries) = &self.node.kind else { return None };
        let entry = entries.iter().find(|entry| entry.key == key)?;
        Some(Value { node: &entry.value, key: child(&self.key, key) })
    }

    /// The mapping, with no keys but those of `keys`, and all it needs.
    pub(super) fn map(&'a self, keys: &Keys) -> Result<Map<'a>, Fault> {
        let entries = self.entries(|| format!("a mapping with {}", list(keys.known())))?;
        for entry in entries {
            if !keys.known().any(|known| known == entry.key) {
                let suggestion = nearest(&entry.key, keys.known());
                let problem = ParseProblem::UnknownKey { known: keys.known().collect(), suggestion };
                return Err(Fault { at: Some(entry.key_at), key: child(&self.key, &entry.key), problem });
            }
        }
        match keys.required.iter().find(|key| entries.iter().all(|entry| entry.key != **key)) {
            Some(key) => Err(self.fault(ParseProblem::MissingKey { key })),
            None => Ok(Map { value: self, entries }),
        }
    }

    /// The mapping with names of the user's choice.
    pub(super) fn named(&'a self) -> Result<Vec<(&'a str, Value<'a>)>, Fault> {
        let entries = self.entries(|| "a mapping of names".to_owned())?;
        if let Some(unnamed) = entries.iter().find(|entry| entry.key.is_empty()) {
            let (found, allowed) = ("an empty name".to_owned(), "a name".to_owned());
            let problem = ParseProblem::Shape { found, allowed };
            return Err(Fault { at: Some(unnamed.key_at), key: self.key.clone(), problem });
        }
        let value = |entry: &'a Entry| Value { node: &entry.value, key: child(&self.key, &entry.key) };
        Ok(entries.iter().map(|entry| (entry.key.as_str(), value(entry))).collect())
    }

    fn entries(&self, allowed: impl FnOnce() -> String) -> Result<&'a [Entry], Fault> {
        match &self.node.kind {
            Kind::Map(entries) => Ok(entries),
            _ => Err(self.shape(allowed())),
        }
    }

    pub(super) fn is_map(&self) -> bool {
        matches!(self.node.kind, Kind::Map(_))
    }

    /// The list, each value with its place.
    pub(super) fn list(&self, allowed: &str) -> Result<Vec<Value<'a>>, Fault> {
        let Kind::List(nodes) = &self.node.kind else { return Err(self.shape(allowed)) };
        let value = |(i, node): (usize, &'a Node)| Value { node, key: format!("{}[{i}]", self.key) };
        Ok(nodes.iter().enumerate().map(value).collect())
    }

    /// The list, if it has two values.
    pub(super) fn pair(&self, allowed: &str) -> Result<[Value<'a>; 2], Fault> {
        <[Value<'a>; 2]>::try_from(self.list(allowed)?).map_err(|_| self.shape(allowed))
    }

    /// A plain word out of a few.
    pub(super) fn word(&self, allowed: &[&'static str]) -> Result<&'static str, Fault> {
        let found = match &self.node.kind {
            Kind::Scalar { text, quoted: false } => allowed.iter().find(|word| *word == text),
            _ => None,
        };
        found.copied().ok_or_else(|| self.shape(allowed.join(", ")))
    }

    /// Text that is not empty.
    pub(super) fn name(&self) -> Result<&'a str, Fault> {
        match &self.node.kind {
            Kind::Scalar { text, .. } if !(text.is_empty() || self.node.is_nothing()) => Ok(text),
            _ => Err(self.shape("a name")),
        }
    }

    /// A finite number, in whatever unit.
    pub(super) fn number(&self) -> Result<f64, Fault> {
        let text = match &self.node.kind {
            Kind::Scalar { text, quoted: false } => text,
            _ => return Err(self.no_number()),
        };
        let not_finite = || self.fault(ParseProblem::NotFinite { found: self.node.in_words() });
        if matches!(
            text.trim_start_matches(['+', '-']).to_ascii_lowercase().as_str(),
            ".inf" | ".nan" | "inf" | "nan"
        ) {
            return Err(not_finite());
        }
        // Rust reads words such as "infinity" too.
        let plain = text.chars().all(|c| c.is_ascii_digit() || "+-.eE".contains(c));
        match text.parse::<f64>() {
            Ok(number) if plain && number.is_finite() => Ok(number),
            Ok(_) if plain => Err(not_finite()),
            _ => Err(self.no_number()),
        }
    }

    /// Neither a number nor, as it is likely to be, one with its unit.
    fn no_number(&self) -> Fault {
        let with_unit = match &self.node.kind {
            Kind::Scalar { text, .. } => {
                text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
                    && text.ends_with(|c: char| c.is_alphabetic())
            }
            _ => false,
        };
        self.shape(if with_unit { "a number alone, its unit stands under units" } else { "a number" })
    }

    /// A coordinate or length (m).
    pub(super) fn length(&self, units: Units) -> Result<f64, Fault> {
        let length = units.metres(self.number()?);
        if length.abs() > GREATEST_LENGTH {
            return Err(
                self.out_of_range(format!("at most {} in size", units.stated_length(GREATEST_LENGTH)))
            );
        }
        Ok(length)
    }

    /// Two coordinates (m).
    pub(super) fn point(&self, units: Units) -> Result<Point, Fault> {
        let [x, y] = self.pair("[x, y]")?;
        Ok(Point::new(x.length(units)?, y.length(units)?))
    }
}

impl<'a> Map<'a> {
    pub(super) fn optional(&self, key: &str) -> Option<Value<'a>> {
        let entry = self.entries.iter().find(|entry| entry.key == key)?;
        Some(Value { node: &entry.value, key: child(&self.value.key, key) })
    }

    pub(super) fn required(&self, key: &'static str) -> Result<Value<'a>, Fault> {
        self.optional(key).ok_or_else(|| self.value.fault(ParseProblem::MissingKey { key }))
    }
}

fn list(keys: impl Iterator<Item = &'static str>) -> String {
    keys.collect::<Vec<_>>().join(", ")
}

/// What people call that by another name.
const OTHER_WORDS: [(&str, &[&str]); 3] = [
    ("circle", &["disc", "disk", "round"]),
    ("polygon", &["rectangle", "rect", "box", "square", "triangle"]),
    ("segment", &["line", "wall", "capsule"]),
];

/// The known key that `key` is another word for, or a slip of the pen away from.
fn nearest(key: &str, known: impl Iterator<Item = &'static str> + Clone) -> Option<&'static str> {
    const SLIP: usize = 2;
    let meant = OTHER_WORDS.iter().find(|(_, words)| words.contains(&key)).map(|(word, _)| *word);
    if let Some(word) = known.clone().find(|word| Some(*word) == meant) {
        return Some(word);
    }
    known
        .map(|candidate| (edits(key, candidate), candidate))
        .filter(|&(edits, candidate)| edits <= SLIP && edits < candidate.len())
        .min()
        .map(|(_, candidate)| candidate)
}

/// How many letters have to be put in, taken out or changed (Levenshtein's distance); large for long words.
fn edits(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().take(64).collect(), b.chars().collect());
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let change = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
