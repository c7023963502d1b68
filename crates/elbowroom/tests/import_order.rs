//! The modules of the core import in one direction only.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

use std::fs;
use std::path::{Path, PathBuf};

/// Each may import from those before it, and from none after it.
const ORDER: [&str; 13] = [
    "geometry",
    "surface",
    "grid",
    "search",
    "swarm",
    "arm",
    "scene",
    "free_space",
    "path",
    "trajectory",
    "verify",
    "planners",
    "online",
];

/// Modules that must know neither arm nor grid: they take closures or traits.
const GENERAL: [&str; 2] = ["search", "swarm"];

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files
}

/// The modules that `text` names after `crate::`.
fn imports(text: &str) -> Vec<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    code.flat_map(|line| {
        line.match_indices("crate::")
            .map(|(at, found)| {
                let name: String = line[at + found.len()..]
                    .chars()
                    .take_while(|c| c.is_alphanumeric() || *c == '_')
                    .collect();
                name
            })
            .collect::<Vec<_>>()
    })
    .collect()
}

#[test]
fn modules_import_from_those_before_them() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut looked_at = 0;
    for entry in fs::read_dir(&source).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        if name == "lib" {
            continue;
        }
        let rank = ORDER.iter().position(|known| *known == name);
        let rank = rank.unwrap_or_else(|| panic!("{name} has no place in the order of imports"));
        let files = if path.is_dir() { rust_files(&path) } else { vec![path] };
        for file in files {
            for import in imports(&fs::read_to_string(&file).unwrap()) {
                let other = ORDER.iter().position(|known| *known == import);
                let other = other.unwrap_or_else(|| panic!("{} imports {import}", file.display()));
                assert!(other <= rank, "{}: {name} imports {import}", file.display());
                let general = GENERAL.contains(&name.as_str());
                assert!(
                    !general || other == rank || import == "search",
                    "{}: {name} imports {import}",
                    file.display()
                );
                looked_at += 1;
            }
        }
    }
    assert!(looked_at > 30, "only {looked_at} imports seen");
}
