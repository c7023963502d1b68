"""A seeded sample of mutants, each against its own module's tests: ``make mutants``, docs/mutants.md.

Needs cargo-mutants, which lists them. Each is built and tested in a copy of the tree below ``target/mutants``.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import threading
import time
import tomllib
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parent.parent
WORK = ROOT / "target" / "mutants"
TREE = WORK / "tree"
SOURCES = "crates/elbowroom/src/"
KNOWN = ROOT / "bench" / "mutants_known.toml"
PAGE = ROOT / "docs" / "mutants.md"

FRAME_TESTS = ("plan", "custom_planner", "mechanisms", "swarm_planners", "chain_plan", "bound")
TESTS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    # Module as the page names it, beginning of its files, tests; the first row that fits counts. `lib:search` is the
    # tests that stand beside the code in `search`.
    ("verify", "verify/bound", ("lib:verify", "bound")),
    ("verify", "verify/progress", ("lib:verify", "bound")),
    ("verify", "verify/blocked", ("bound",)),
    ("verify", "verify/", ("lib:verify", "verify", "verify_chain", "verify_moving", "verify_dense")),
    ("trajectory", "trajectory/least_time", ("least_time",)),
    ("trajectory", "trajectory/peak", ("lib:trajectory", "trajectory", "departure")),
    ("trajectory", "trajectory/b_spline", ("lib:trajectory", "trajectory", "departure")),
    ("trajectory", "trajectory/", ("trajectory", "departure")),
    ("search", "search/open_list", ("lib:search", "dstar")),
    ("search", "search/", ("dstar",)),
    ("frame", "planning/", FRAME_TESTS),
    ("frame", "planners/shortlist", FRAME_TESTS),
)

# Quick to build: what is tested is whether a test fails, not how fast the code is.
SETTINGS = {
    "CARGO_TARGET_DIR": str(WORK / "target"),
    "CARGO_INCREMENTAL": "1",
    "CARGO_PROFILE_DEV_OPT_LEVEL": "1",
    "CARGO_PROFILE_DEV_DEBUG": "0",
    "CARGO_TERM_COLOR": "never",
    "RUST_BACKTRACE": "0",
}


@dataclass(frozen=True)
class Mutant:
    """One change to one file."""

    file: str
    name: str
    module: str
    tests: tuple[str, ...]
    diff: str

    @property
    def label(self) -> str:
        """Its name without line and column, so that it keeps it while other code changes."""
        what = re.sub(r"^[^ ]+: ", "", self.name)
        removed = [line[1:].strip() for line in self.diff.splitlines()[2:] if line.startswith("-")]
        return f"{self.file.removeprefix(SOURCES)}: {what}" + (f": `{removed[0]}`" if len(removed) == 1 else "")

    def rank(self, seed: int) -> str:
        """Where it comes in the sample; the same while neither it nor the seed changes."""
        return hashlib.sha256(f"{seed} {self.label} {self.diff.partition('@@')[2]}".encode()).hexdigest()


def listed() -> list[Mutant]:
    """All mutants of the modules in the table, by cargo-mutants."""
    run = subprocess.run(
        ["cargo", "mutants", "--list", "--json", "--diff", "--package", "elbowroom"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    if run.returncode:
        sys.exit(f"error: cargo mutants: {run.stderr.strip() or 'does not run'}")
    mutants = []
    for entry in json.loads(run.stdout):
        inside = entry["file"].removeprefix(SOURCES)
        row = next((row for row in TESTS if inside.startswith(row[1])), None)
        if row is not None:
            mutants.append(Mutant(entry["file"], entry["name"], row[0], row[2], entry["diff"]))
    if missing := {row[0] for row in TESTS} - {mutant.module for mutant in mutants}:
        sys.exit(
            f"error: no mutants of {', '.join(sorted(missing))}; the table in bench/mutants.py names no such files"
        )
    return mutants


def changed(text: str, diff: str) -> str:
    """The text with the change of a unified diff made in it."""
    lines, result, at = text.splitlines(keepends=True), [], 0
    for line in diff.splitlines(keepends=True)[2:]:
        if head := re.match(r"@@ -(\d+)(,0)?", line):
            start = int(head[1]) - 1 + (head[2] is not None)
            result += lines[at:start]
            at = start
        elif line[0] == "+":
            result.append(line[1:])
        elif line[0] in " -":
            if lines[at].rstrip("\n") != line[1:].rstrip("\n"):
                raise ValueError(f"line {at + 1} is not what the diff says")
            result += [lines[at]] * (line[0] == " ")
            at += 1
    return "".join(result + lines[at:])


def copy_tree() -> None:
    """A copy of what git knows of, or would add."""
    shutil.rmtree(TREE, ignore_errors=True)
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "-z"], cwd=ROOT, capture_output=True)
    for name in filter(None, names.stdout.decode().split("\0")):
        if (ROOT / name).is_file() and not name.startswith("docs/"):
            (TREE / name).parent.mkdir(parents=True, exist_ok=True)
            # As new files: what was last built here may have been a mutant.
            shutil.copyfile(ROOT / name, TREE / name)


def built(tests: tuple[str, ...]) -> dict[str, str] | None:
    """The programs of these tests, by name; None where the tree does not build."""
    named = [test for test in tests if not test.startswith("lib:")]
    chosen = ["--lib"] * (len(named) < len(tests)) + [word for test in named for word in ("--test", test)]
    run = subprocess.run(
        ["cargo", "test", "--quiet", "-p", "elbowroom", "--no-run", "--message-format", "json", *chosen],
        cwd=TREE,
        env={**os.environ, **SETTINGS},
        capture_output=True,
        text=True,
    )
    if run.returncode:
        return None
    messages = [json.loads(line) for line in run.stdout.splitlines() if line.startswith("{")]
    programs = [m for m in messages if m.get("executable") and m.get("profile", {}).get("test")]
    return {"lib" if "lib" in m["target"]["kind"] else m["target"]["name"]: m["executable"] for m in programs}


def passes(test: str, programs: dict[str, str], limit: float) -> bool | None:
    """Whether a test passes; None where they do not end within the limit (s)."""
    crate = TREE / "crates" / "elbowroom"
    name, _, only = test.partition(":")
    process = subprocess.Popen(
        [programs[name], *([f"{only}::"] if only else [])],
        cwd=crate,
        env={**os.environ, **SETTINGS, "CARGO_MANIFEST_DIR": str(crate)},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    timer = threading.Timer(limit, process.kill)
    timer.start()
    try:
        # One failure is enough: the tests after it need not run.
        if any(re.match(r"test .* \.\.\. FAILED$", line) for line in process.stdout or ()):
            return False
        code = process.wait()
        return None if code and not timer.is_alive() else code == 0
    finally:
        timer.cancel()
        process.kill()
        process.wait()


def judged(mutant: Mutant, limits: dict[str, float]) -> str:
    """What became of a mutant: killed, too slow (killed too), survived, or does not build."""
    path = TREE / mutant.file
    sound = path.read_text(encoding="utf-8")
    path.write_text(changed(sound, mutant.diff), encoding="utf-8")
    try:
        programs = built(mutant.tests)
        if programs is None:
            return "does not build"
        # The quick ones first.
        for test in sorted(mutant.tests, key=limits.__getitem__):
            result = passes(test, programs, limits[test])
            if result is not True:
                return "too slow" if result is None else "killed"
        return "survived"
    finally:
        path.write_text(sound, encoding="utf-8")


def baseline(mutants: list[Mutant]) -> dict[str, float]:
    """Time limits (s) by test: several times what the sound tree takes."""
    tests = tuple(dict.fromkeys(test for mutant in mutants for test in mutant.tests))
    programs = built(tests)
    if programs is None:
        sys.exit(f"error: the tree does not build: cargo test --no-run in {TREE} says why")
    limits = {}
    for test in tests:
        begun = time.monotonic()
        if not passes(test, programs, 600):
            sys.exit(f"error: {test} fails, or takes ten minutes, without any mutant")
        limits[test] = 20 + 8 * (time.monotonic() - begun)
        print(f"{test}: {time.monotonic() - begun:.1f} s", flush=True)
    return limits


def page(results: list[tuple[Mutant, str]], asked: int, seed: int, minutes: float) -> str:
    """docs/mutants.md."""
    known = tomllib.loads(KNOWN.read_text(encoding="utf-8")) if KNOWN.exists() else {}
    counts = Counter((mutant.module, result) for mutant, result in results)
    modules = list(dict.fromkeys(row[0] for row in TESTS))
    text = (
        "# Mutants\n\n"
        "`make mutants` changes one thing in the code at a time (cargo-mutants says what) and runs the tests of that "
        "module, and no others. A change that they pass is a survivor: either it changes nothing that matters, or a "
        "test is missing. One that does not end in several times the usual time counts as killed.\n\n"
        f"{len(results)} of {asked} mutants, seed {seed}, in {minutes:.0f} minutes"
        + ("." if len(results) == asked else "; **the rest was not run: time was up**.")
        + "\n\n| module | mutants | killed | too slow | survived | explained |\n|---|---|---|---|---|---|\n"
    )
    survivors = sorted((mutant for mutant, result in results if result == "survived"), key=lambda m: m.label)
    for module in modules:
        explained = sum(m.module == module and m.label in known for m in survivors)
        row = [counts[module, result] for result in ("killed", "too slow", "survived")]
        text += f"| {module} | {sum(row)} | {' | '.join(map(str, row))} | {explained} |\n"
    text += "\n## Survivors\n\n" + ("| mutant | why |\n|---|---|\n" if survivors else "None.\n")
    for mutant in survivors:
        text += f"| {mutant.label} | {known.get(mutant.label, 'not explained')} |\n".replace("||", r"\|\|")
    return text


def main() -> None:
    """Run the sample, write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=150, help="how many mutants that build")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=55.0, help="begin no other mutant after this time")
    parser.add_argument("--only", default="", help="only files that begin so, such as search/dstar")
    parser.add_argument("--page", type=Path, default=PAGE)
    chosen = parser.parse_args()
    begun = time.monotonic()
    mutants = sorted(listed(), key=lambda mutant: mutant.rank(chosen.seed))
    mutants = [m for m in mutants if m.file.removeprefix(SOURCES).startswith(chosen.only)]
    copy_tree()
    # Some will not build, so more are looked at than asked for.
    limits = baseline(mutants[: 2 * chosen.count])
    results: list[tuple[Mutant, str]] = []
    for mutant in mutants[: 2 * chosen.count]:
        if len(results) == chosen.count or time.monotonic() - begun > chosen.minutes * 60:
            break
        result = judged(mutant, limits)
        print(f"{(time.monotonic() - begun) / 60:5.1f} min  {result}  {mutant.name}", flush=True)
        if result != "does not build":
            results.append((mutant, result))
    minutes = (time.monotonic() - begun) / 60
    chosen.page.write_text(page(results, chosen.count, chosen.seed, minutes), encoding="utf-8")
    print(f"{chosen.page}: {sum(result == 'survived' for _, result in results)} of {len(results)} survived")


if __name__ == "__main__":
    main()
