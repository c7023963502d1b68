//! The files of a crate and what each imports from the others.

mod read;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Names of a module from the crate down; empty for the crate itself.
type Names = Vec<String>;

/// One leaf of a `use`: what it names, and what it is called here.
struct Use {
    path: Names,
    name: String,
    public: bool,
}

/// A module: a file, or braces in one.
#[derive(Default)]
struct Module {
    file: String,
    children: BTreeSet<String>,
    uses: Vec<Use>,
    /// Paths of two and more names in its code.
    paths: Vec<Names>,
    /// The first names of all paths in its code.
    words: BTreeSet<String>,
}

/// All modules of a crate.
#[derive(Default)]
pub(crate) struct SourceTree {
    modules: BTreeMap<Names, Module>,
}

impl SourceTree {
    /// Of the files below `folder`.
    pub(crate) fn load(folder: &Path) -> Self {
        let mut texts = Vec::new();
        load(folder, "", &mut texts);
        Self::new(texts.iter().map(|(file, text)| (file.as_str(), text.as_str())))
    }

    /// Of files by their names below the crate's folder of sources, such as `arm/mod.rs`.
    pub(crate) fn new<'a>(texts: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let mut tree = Self::default();
        for (file, text) in texts {
            let stem = file.trim_end_matches(".rs");
            let mut names: Names = stem.split('/').map(str::to_owned).collect();
            if matches!(names.last().map(String::as_str), Some("mod" | "lib")) {
                names.pop();
            }
            read::file(&mut tree.modules, file, names, text);
        }
        tree
    }

    /// The files that each file imports something from: a `use`, or a path written out. What is imported from a
    /// module that only hands it on is imported from the file that has it; handing on alone is no import.
    pub(crate) fn imports(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let mut imports: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for (names, module) in &self.modules {
            let uses = module.uses.iter().filter(|one| !one.public || module.words.contains(&one.name));
            let uses = uses.filter_map(|one| self.resolve(names, &one.path, false, 0));
            let paths = module.paths.iter().filter_map(|path| self.resolve(names, path, true, 0));
            let found: BTreeSet<&str> = uses.chain(paths).filter(|file| *file != module.file).collect();
            imports.entry(&module.file).or_default().extend(found);
        }
        imports
    }

    /// The file that has what `path` means in the module `from`; `None` for what is of another crate, or of `from`
    /// itself. The first name may be one that a `use` brought in only where `imported`.
    fn resolve(&self, from: &[String], path: &[String], imported: bool, depth: usize) -> Option<&str> {
        let here = self.modules.get(from)?;
        let mut at = from.to_vec();
        let mut rest = path;
        match path.first()?.as_str() {
            "crate" => {
                at.clear();
                rest = &path[1..];
            }
            "self" | "super" => {}
            name if here.children.contains(name) => {}
            name if imported && here.uses.iter().any(|one| one.name == name) => {}
            _ => return None,
        }
        for (i, name) in rest.iter().enumerate() {
            let module = &self.modules[&at];
            match name.as_str() {
                "self" => {}
                "super" => drop(at.pop()),
                name if module.children.contains(name) => at.push(name.to_owned()),
                name => {
                    let Some(handed_on) = module.uses.iter().find(|one| one.name == name) else { break };
                    let path = [&handed_on.path[..], &rest[i + 1..]].concat();
                    assert!(depth < 20, "{}: {} leads to itself", module.file, path.join("::"));
                    return self.resolve(&at, &path, false, depth + 1);
                }
            }
        }
        Some(&self.modules[&at].file)
    }
}

fn load(folder: &Path, prefix: &str, texts: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = format!("{prefix}{}", path.file_name().unwrap().to_str().unwrap());
        if path.is_dir() {
            load(&path, &format!("{name}/"), texts);
        } else if path.extension().is_some_and(|e| e == "rs") {
            texts.push((name, fs::read_to_string(&path).unwrap()));
        }
    }
}

/// The sets of files that import each other, by however many steps; each sorted, and so are they.
pub(crate) fn circles(imports: &BTreeMap<&str, BTreeSet<&str>>) -> Vec<Vec<String>> {
    let reached = |from: &str| {
        let mut seen = BTreeSet::new();
        let mut open = vec![from.to_owned()];
        while let Some(file) = open.pop() {
            for next in imports.get(file.as_str()).into_iter().flatten() {
                if seen.insert((*next).to_owned()) {
                    open.push((*next).to_owned());
                }
            }
        }
        seen
    };
    let reach: BTreeMap<String, BTreeSet<String>> =
        imports.keys().map(|file| ((*file).to_owned(), reached(file))).collect();
    let of = |file: &String| -> Vec<String> {
        reach[file].iter().filter(|other| reach[*other].contains(file)).cloned().collect()
    };
    let circles: BTreeSet<Vec<String>> = reach.keys().map(of).filter(|circle| !circle.is_empty()).collect();
    circles.into_iter().collect()
}
