//! The modules of the core import in one direction only, and no two files import each other.

#![expect(clippy::unwrap_used, reason = "a judge that fails may panic")]

mod source_tree;

use std::fs;
use std::path::Path;

use source_tree::{SourceTree, circles};

/// Modules that must know neither arm nor grid: they take closures or traits.
const GENERAL: [&str; 2] = ["search", "swarm"];

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The line `a < b < c` of `lib.rs`, where it says what may import what.
fn order() -> String {
    let text = fs::read_to_string(folder().join("src/lib.rs")).unwrap();
    let line = text.lines().find(|line| line.starts_with("//!") && line.contains(" < ")).unwrap();
    line.split('`').nth(1).unwrap().to_owned()
}

#[test]
fn modules_import_from_those_before_them() {
    let order = order();
    let ranks: Vec<&str> = order.split(" < ").collect();
    let module = |file: &str| file.split(['/', '.']).next().unwrap().to_owned();
    let rank = |file: &str| ranks.iter().position(|known| *known == module(file));
    let tree = SourceTree::load(&folder().join("src"));
    let mut looked_at = 0;
    for (file, imports) in tree.imports() {
        if file == "lib.rs" {
            continue;
        }
        let own = rank(file).unwrap_or_else(|| panic!("{file} has no place in the order of imports"));
        for import in imports {
            assert!(rank(import).is_some_and(|other| other <= own), "{file} imports {import}: {order}");
            let (from, to) = (module(file), module(import));
            assert!(
                !GENERAL.contains(&&*from) || to == from || ["search", "random"].contains(&&*to),
                "{file} imports {import}"
            );
            looked_at += 1;
        }
    }
    assert!(looked_at > 300, "only {looked_at} imports seen");
}

#[test]
fn the_order_is_the_same_wherever_it_is_stated() {
    let page = fs::read_to_string(folder().join("../../ARCHITECTURE.md")).unwrap();
    assert!(page.contains(&format!("`{}`", order())), "ARCHITECTURE.md states another order than lib.rs");
}

#[test]
fn files_do_not_import_each_other() {
    let found = circles(&SourceTree::load(&folder().join("src")).imports());
    assert!(found.is_empty(), "{found:?}");
}

/// What a `use` or a path may look like, each in a file of its own.
#[test]
fn every_way_to_import_is_seen() {
    let door = "mod a;\nmod b;\npub mod deep;\npub use a::{A, Other as Renamed};\npub(crate) use b::B;";
    for (code, import) in [
        ("use crate::m::A;", "m/a.rs"),
        ("use crate::m::{\n    A,\n};", "m/a.rs"),
        ("use crate::{m::{self, A}};", "m/a.rs"),
        ("use crate::m::Renamed;", "m/a.rs"),
        ("use super::A;", "m/a.rs"),
        ("use super::a::Hidden as _;", "m/a.rs"),
        ("use super::super::m::a;", "m/a.rs"),
        ("pub use super::A; fn f(a: A) {}", "m/a.rs"),
        ("fn f() { use super::A; }", "m/a.rs"),
        ("fn f() -> crate::m::A { todo!() }", "m/a.rs"),
        ("fn f() { let x = vec![super::a::made(1)]; }", "m/a.rs"),
        ("use crate::m; fn f() { m::A::new(); }", "m/a.rs"),
        ("mod tests { use super::super::a::X; }", "m/a.rs"),
        ("use super::deep::Deep;", "m/deep/mod.rs"),
        ("use super::deep::inner::Inner;", "m/deep/inner.rs"),
        ("use super::deep::*;", "m/deep/mod.rs"),
        ("use crate::Root;", "m/a.rs"),
        ("pub struct B; fn f() -> super::B { B }", ""),
        ("pub use super::A;", ""),
        ("use std::{fmt, a::A};", ""),
        ("/// [`super::A`]\npub(in crate::m) fn f() -> &'static str { \"super::A\" }", ""),
        ("mod tests { use super::*; }", ""),
        ("fn f() -> impl Fn() + use<> { ::m::a::A }", ""),
    ] {
        let tree = SourceTree::new([
            ("lib.rs", "mod m;\npub use m::A as Root;"),
            ("m/mod.rs", door),
            ("m/a.rs", ""),
            ("m/b.rs", code),
            ("m/deep/mod.rs", "pub mod inner;"),
            ("m/deep/inner.rs", ""),
        ]);
        let imports = tree.imports();
        let found: Vec<&str> = imports["m/b.rs"].iter().copied().collect();
        assert!(found.contains(&import) || (import.is_empty() && found.is_empty()), "{code}: {found:?}");
        assert!(imports["m/mod.rs"].is_empty() && imports["lib.rs"].is_empty(), "{code}");
    }
}

#[test]
fn a_circle_is_found_whatever_its_length() {
    let tree = SourceTree::new([
        ("lib.rs", "mod a; mod b; mod c; mod d; mod e;"),
        ("a.rs", "use crate::b::B;"),
        ("b.rs", "use super::c::C;"),
        ("c.rs", "fn f(a: crate::a::A) {}"),
        ("d.rs", "use crate::a::A;"),
        ("e.rs", "use crate::d::D;"),
    ]);
    assert_eq!(circles(&tree.imports()), [["a.rs", "b.rs", "c.rs"]]);
}
