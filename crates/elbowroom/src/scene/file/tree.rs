use std::collections::HashMap;

use saphyr_parser::{Event, Marker, Parser, ScalarStyle, ScanError};

use super::Location;
use super::error::ParseProblem;
use super::node::{Entry, Kind, Node};
use super::syntax::in_words;
use super::value::{Fault, child};

/// Most bytes that are read.
const MOST_BYTES: usize = 4 << 20;

/// Most values that are read: what the largest scene allowed can need.
const MOST_VALUES: usize = 1 << 20;

/// Most lists and mappings in one another; the format needs six.
const MOST_DEPTH: usize = 16;

const TOO_DEEP: ParseProblem =
    ParseProblem::TooMany { what: "lists and mappings in one another", most: MOST_DEPTH };

/// The one document of `text` as a tree of marked nodes.
pub(super) fn tree(text: &str) -> Result<Node, Fault> {
    if text.len() > MOST_BYTES {
        return Err(whole(ParseProblem::TooLarge { bytes: text.len(), most: MOST_BYTES }));
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut builder = Builder::default();
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| syntax(&error))?;
        builder.take(event, location(&span.start))?;
    }
    match builder.document {
        Some(Node { kind: Kind::Scalar { ref text, quoted: false }, .. }) if text.is_empty() => {
            Err(whole(ParseProblem::Empty))
        }
        Some(root) => Ok(root),
        None => Err(whole(ParseProblem::Empty)),
    }
}

fn whole(problem: ParseProblem) -> Fault {
    Fault { at: None, key: String::new(), problem }
}

fn syntax(error: &ScanError) -> Fault {
    let problem = match error.info() {
        // The parser looks some way ahead and meets these before the builder does.
        "recursion limit exceeded" => TOO_DEEP,
        "while parsing node, found unknown anchor" => ParseProblem::NotPlain,
        message => ParseProblem::Syntax { message: in_words(message) },
    };
    Fault { at: Some(location(error.marker())), key: String::new(), problem }
}

fn location(mark: &Marker) -> Location {
    Location { line: mark.line(), column: mark.col() + 1 }
}

/// Puts the events together; keeps its own stack, so that depth costs no recursion.
#[derive(Default)]
struct Builder {
    open: Vec<Open>,
    values: usize,
    document: Option<Node>,
}

/// A list or mapping whose end has not come yet.
enum Open {
    List {
        at: Location,
        values: Vec<Node>,
    },
    Map {
        at: Location,
        entries: Vec<Entry>,
        seen: HashMap<String, Location>,
        key: Option<(String, Location)>,
    },
}

impl Builder {
    fn take(&mut self, event: Event<'_>, at: Location) -> Result<(), Fault> {
        let fault = |problem| Err(Fault { at: Some(at), key: self.path(), problem });
        match event {
            Event::Nothing | Event::StreamStart | Event::StreamEnd | Event::DocumentEnd => Ok(()),
            Event::DocumentStart(_) if self.document.is_some() => fault(ParseProblem::SecondDocument),
            Event::DocumentStart(_) => Ok(()),
            Event::Alias(_) => fault(ParseProblem::NotPlain),
            Event::Scalar(_, _, anchor, ref tag) if anchor != 0 || tag.is_some() => {
                fault(ParseProblem::NotPlain)
            }
            Event::SequenceStart(anchor, ref tag) | Event::MappingStart(anchor, ref tag)
                if anchor != 0 || tag.is_some() =>
            {
                fault(ParseProblem::NotPlain)
            }
            Event::Scalar(text, style, ..) => {
                let kind =
                    Kind::Scalar { text: text.into_owned(), quoted: !matches!(style, ScalarStyle::Plain) };
                self.put(Node { at, kind })
            }
            Event::SequenceStart(..) => self.begin(at, Open::List { at, values: Vec::new() }),
            Event::MappingStart(..) => {
                let (entries, seen) = (Vec::new(), HashMap::new());
                self.begin(at, Open::Map { at, entries, seen, key: None })
            }
            Event::SequenceEnd | Event::MappingEnd => match self.open.pop() {
                Some(Open::List { at, values }) => self.put(Node { at, kind: Kind::List(values) }),
                Some(Open::Map { at, entries, .. }) => self.put(Node { at, kind: Kind::Map(entries) }),
                None => Ok(()),
            },
        }
    }

    fn begin(&mut self, at: Location, open: Open) -> Result<(), Fault> {
        if self.open.len() == MOST_DEPTH {
            return Err(Fault { at: Some(at), key: self.path(), problem: TOO_DEEP });
        }
        self.open.push(open);
        Ok(())
    }

    fn put(&mut self, node: Node) -> Result<(), Fault> {
        let at = node.at;
        self.values += 1;
        if self.values > MOST_VALUES {
            let problem = ParseProblem::TooMany { what: "values", most: MOST_VALUES };
            return Err(Fault { at: Some(at), key: self.path(), problem });
        }
        match self.open.last_mut() {
            None => self.document = Some(node),
            Some(Open::List { values, .. }) => values.push(node),
            Some(Open::Map { entries, seen, key, .. }) => match key.take() {
                Some((key, key_at)) => entries.push(Entry { key, key_at, value: node }),
                None => match new_key(node, seen) {
                    Ok(name) => *key = Some((name, at)),
                    Err((name, problem)) => {
                        let key = name.map_or_else(|| self.path(), |name| child(&self.path(), &name));
                        return Err(Fault { at: Some(at), key, problem });
                    }
                },
            },
        }
        Ok(())
    }

    /// The path of keys to the value that comes next.
    fn path(&self) -> String {
        self.open.iter().fold(String::new(), |path, open| match open {
            Open::List { values, .. } => format!("{path}[{}]", values.len()),
            Open::Map { key: Some((name, _)), .. } => child(&path, name),
            Open::Map { key: None, .. } => path,
        })
    }
}

/// The text of a key that its mapping has not `seen`; otherwise what is wrong, with the text where there is one.
fn new_key(
    node: Node,
    seen: &mut HashMap<String, Location>,
) -> Result<String, (Option<String>, ParseProblem)> {
    match node.kind {
        Kind::Scalar { text, .. } => match seen.insert(text.clone(), node.at) {
            None => Ok(text),
            Some(first) => Err((Some(text), ParseProblem::DuplicateKey { first })),
        },
        Kind::List(_) => Err((None, ParseProblem::KeyShape { found: "a list" })),
        Kind::Map(_) => Err((None, ParseProblem::KeyShape { found: "a mapping" })),
    }
}
