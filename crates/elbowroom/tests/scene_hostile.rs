//! Scene files that are damaged or meant to do harm are refused, at little cost.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use elbowroom::scene::{Location, ParseProblem, parse};
use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

const SOUND: &str = "\
elbowroom: 1
units: {length: cm, angle: deg}
arm:
  links: [25, 20]
  joints:
    - {continuous: true, velocity: 90}
    - {min: -150, max: 150}
  half_width: 2
  base: [1, -2]
grid: {x: [-50, 50], y: [-40, 40], step: 1}
obstacles:
  - circle: {center: [22, 22], radius: 5}
    name: post
  - polygon: [[0, 30], [5, 30], [0, 35]]
tasks:
  first: {start: [40, 10], goal: {q: [90, -30]}, posture: keep}
";

fn message(text: &str) -> String {
    parse(text, "s.yaml").map(|_| "sound".to_owned()).unwrap_or_else(|error| error.to_string())
}

/// The texts of all example scenes, in the order of their names.
fn examples() -> std::io::Result<Vec<String>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../python/elbowroom/scenes");
    let paths: std::io::Result<Vec<_>> =
        fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path())).collect();
    let mut paths = paths?;
    paths.retain(|path| path.extension().is_some_and(|e| e == "yaml"));
    paths.sort();
    paths.iter().map(fs::read_to_string).collect()
}

#[test]
fn bombs_are_refused_before_they_go_off() {
    let huge = format!("{SOUND}#{}", "x".repeat(4 << 20));
    assert!(matches!(parse(&huge, "s").unwrap_err().problem, ParseProblem::TooLarge { .. }));
    let mut aliases = "a: &a [x, x, x, x, x, x, x, x, x]\n".to_owned();
    for i in 1..30 {
        writeln!(aliases, "b{i}: &b{i} [*a, *a, *a, *a, *a, *a, *a, *a]").unwrap();
    }
    assert_eq!(parse(&aliases, "s").unwrap_err().problem, ParseProblem::NotPlain);
    for level in ["[", "{", "{a: ", "- ", "? ", "a: {"] {
        let error = parse(&level.repeat(100_000), "s").unwrap_err();
        assert!(matches!(error.problem, ParseProblem::TooMany { most: 16, .. }), "{level}: {error}");
    }
    let many = format!("{SOUND}#").replace(
        "  - polygon",
        &format!("{}  - polygon", "  - circle: {center: [1, 1], radius: 1}\n".repeat(65_535)),
    );
    assert_eq!(message(&many), "s.yaml:12:3: obstacles: 65537 obstacles, at most 65536 are allowed");
    let tasks: String = (0..1000).map(|i| format!("  t{i}: {{start: [1, 1], goal: [1, 2]}}\n")).collect();
    assert_eq!(
        message(&format!("{SOUND}{tasks}")),
        "s.yaml:16:3: tasks: 1001 tasks, at most 1000 are allowed"
    );
    let many = format!("obstacles: [{}]", "1,".repeat(2_000_000));
    assert!(matches!(parse(&many, "s").unwrap_err().problem, ParseProblem::TooMany { .. }));
}

/// Two obstacles may share nothing, whatever their names hold: the message stays on its line.
#[test]
fn names_of_any_content_make_messages_of_one_line() {
    let part = "  - {name: \"a\\nb\\0\", circle: {center: [1, 1], radius: 1}}\n";
    let twice = SOUND.replace("tasks:", &format!("{part}{part}tasks:"));
    assert_eq!(message(&twice), "s.yaml:16:12: obstacles[3].name: two obstacles are called 'a\\nb\\0'");
    let long = SOUND.replace("half_width", &"w".repeat(1 << 20));
    assert!(message(&long).len() < 200);
}

#[test]
fn damaged_files_never_do_worse_than_be_refused() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let mut below = |count: usize| (rng.next_u64() % count as u64) as usize;
    let pieces = [
        "[", "]", "{", "}", ":", "-", "\n", " ", "&a", "*a", "!!t", "\"", "'", "#", ".nan", "1e400", "é",
        "\0", "|", ">", "?", "%", "@", "\t", "\r", "---\n", "\u{feff}", "<<: ",
    ];
    let mut texts = examples().unwrap();
    assert!(texts.len() > 10, "only {} example scenes", texts.len());
    texts.push(SOUND.to_owned());
    let wall = "  - segment: {from: [0, -30], to: [5, -35], radius: 1}\ntasks:";
    texts.push(SOUND.replace("tasks:", wall));
    let (mut refused, mut sound) = (0, 0);
    for round in 0..20_000 {
        let mut text = texts[round % texts.len()].clone().into_bytes();
        for _ in 0..=below(4) {
            if text.is_empty() {
                break;
            }
            let at = below(text.len());
            match below(7) {
                0 => drop(text.remove(at)),
                1 => text.splice(at..at, pieces[below(pieces.len())].bytes()).for_each(drop),
                2 => text[at] = below(256) as u8,
                3 => text[at] = b"0123456789-.,:[]{}"[below(18)],
                4 if below(8) == 0 => text.truncate(at),
                4 | 5 => {
                    let to = (at + below(20)).min(text.len());
                    let copy = text[at..to].to_vec();
                    let there = below(text.len());
                    text.splice(there..there, copy).for_each(drop);
                }
                _ => {
                    let mut lines: Vec<&[u8]> = text.split(|&byte| byte == b'\n').collect();
                    let (from, to) = (below(lines.len()), below(lines.len()));
                    match below(3) {
                        0 => drop(lines.remove(from)),
                        1 => lines.insert(to, lines[from]),
                        _ => lines.swap(from, to),
                    }
                    text = lines.join(&b'\n');
                }
            }
        }
        let text = String::from_utf8_lossy(&text);
        match parse(&text, "s.yaml") {
            Ok(_) => sound += 1,
            Err(error) => {
                refused += 1;
                assert!(error.to_string().lines().count() == 1, "{error}");
                // To YAML a carriage return alone ends a line too.
                let lines = text.lines().count() + text.matches('\r').count() + 1;
                match error.location {
                    Some(Location { line, column }) => {
                        assert!((1..=lines).contains(&line) && column >= 1, "{error} of {lines} lines");
                    }
                    None => assert_eq!(error.problem, ParseProblem::Empty, "{error}"),
                }
            }
        }
    }
    assert!(refused > 10_000 && sound > 1000, "{refused} refused, {sound} sound");
}
