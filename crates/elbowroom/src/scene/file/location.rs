use std::collections::BTreeMap;

/// A place in a text; both count from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Location {
    /// Line.
    pub line: usize,
    /// Column, in characters.
    pub column: usize,
}

/// Where in a file its tasks say where they begin and end.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Locations {
    pub(super) ends: BTreeMap<String, [Location; 2]>,
}

impl Locations {
    /// Of the start of the task called `task`.
    pub fn start(&self, task: &str) -> Option<Location> {
        self.ends.get(task).map(|ends| ends[0])
    }

    /// Of the goal of the task called `task`.
    pub fn goal(&self, task: &str) -> Option<Location> {
        self.ends.get(task).map(|ends| ends[1])
    }
}
