use std::collections::HashMap;

use saphyr_parser::{Event, Marker, Parser, ScalarStyle, ScanError};

use super::Location;
use super::error::Problem;
use super::node::{Entry, Kind, Node};
use super::value::Fault;

/// Most bytes that are read.
const MOST_BYTES: usize = 4 << 20;

/// Most values that are read: what the largest scene allowed can need.
const MOST_VALUES: usize = 1 << 20;

/// Most lists and mappings in one another; the format needs six.
const MOST_DEPTH: usize = 16;

/// The one document of `text` as a tree of marked nodes.
pub(super) fn tree(text: &str) -> Result<Node, Fault> {
    if text.len() > MOST_BYTES {
        return Err(whole(Problem::TooLarge { bytes: text.len(), most: MOST_BYTES }));
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut builder = Builder::default();
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| syntax(&error))?;
        builder.take(event, location(&span.start))?;
    }
    match builder.document {
        Some(Node { kind: Kind::Scalar { ref text, quoted: false }, .. }) if text.is_empty() => {
            Err(whole(Problem::Empty))
        }
        Some(root) => Ok(root),
        None => Err(whole(Problem::Empty)),
    }
}

fn whole(problem: Problem) -> Fault {
    Fault { at: None, key: String::new(), problem }
}

fn syntax(error: &ScanError) -> Fault {
    let problem = Problem::Syntax { message: error.info().to_owned() };
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
        let fault = |problem| Err(Fault { at: Some(at), key: String::new(), problem });
        match event {
            Event::Nothing | Event::StreamStart | Event::StreamEnd | Event::DocumentEnd => Ok(()),
            Event::DocumentStart(_) if self.document.is_some() => fault(Problem::SecondDocument),
            Event::DocumentStart(_) => Ok(()),
            Event::Alias(_) => fault(Problem::NotPlain),
            Event::Scalar(_, _, anchor, ref tag) if anchor != 0 || tag.is_some() => fault(Problem::NotPlain),
            Event::SequenceStart(anchor, ref tag) | Event::MappingStart(anchor, ref tag)
                if anchor != 0 || tag.is_some() =>
            {
                fault(Problem::NotPlain)
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
            let problem = Problem::TooMany { what: "lists and mappings in one another", most: MOST_DEPTH };
            return Err(Fault { at: Some(at), key: String::new(), problem });
        }
        self.open.push(open);
        Ok(())
    }

    fn put(&mut self, node: Node) -> Result<(), Fault> {
        let at = node.at;
        let fault = |problem| Err(Fault { at: Some(at), key: String::new(), problem });
        self.values += 1;
        if self.values > MOST_VALUES {
            return fault(Problem::TooMany { what: "values", most: MOST_VALUES });
        }
        match self.open.last_mut() {
            None => self.document = Some(node),
            Some(Open::List { values, .. }) => values.push(node),
            Some(Open::Map { entries, seen, key, .. }) => match (key.take(), node.kind) {
                (Some((name, key_at)), kind) => {
                    entries.push(Entry { key: name, key_at, value: Node { at, kind } });
                }
                (None, Kind::Scalar { text, .. }) => {
                    if let Some(&first) = seen.get(&text) {
                        let problem = Problem::DuplicateKey { first };
                        return Err(Fault { at: Some(at), key: text, problem });
                    }
                    seen.insert(text.clone(), at);
                    *key = Some((text, at));
                }
                (None, Kind::List(_)) => return fault(Problem::KeyShape { found: "a list" }),
                (None, Kind::Map(_)) => return fault(Problem::KeyShape { found: "a mapping" }),
            },
        }
        Ok(())
    }
}
