"""``report.md``: tables for people, with box plots; and ``pairs.csv``, every test."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Sequence
from dataclasses import fields
from pathlib import Path

from matplotlib.figure import Figure

from elbowroom._numbered import counted
from elbowroom._objectives import OBJECTIVES
from elbowroom._whole_files import write_whole
from elbowroom.compare._row import FAILURES, NOT_APPLICABLE, Row
from elbowroom.compare._statistics import Interval
from elbowroom.compare._summary import (
    METRICS,
    Cell,
    Metric,
    Overall,
    Pair,
    Summary,
    TaskSummary,
    summarised,
)
from elbowroom.figures import save
from elbowroom.figures._compare import Curve, Panel, Shares, convergence, side_by_side

MOST_TASKS = 24
"""With more tasks than this each gets a line instead of a section with a picture."""

NA = "not applicable"

ALWAYS = ("tip_length_m", "joint_travel_rad", "duration_s", "least_clearance_m", "time_s")
"""Columns shown even if nobody has a value; the others only if somebody has."""


def write_report(
    rows: Sequence[Row],
    folder: Path,
    *,
    planners: Sequence[str],
    command: str,
    show: Callable[[str], None] = lambda _words: None,
) -> list[Path]:
    """Write ``report.md``, ``pairs.csv`` and the pictures into ``folder``; return their paths, the report first.

    Args:
        rows: Of one comparison.
        folder: Where to.
        planners: In the order of the tables.
        command: What made them, to be shown.
        show: Called with the picture under way.
    """
    summary = summarised(rows, planners)
    parts = [_head(rows, summary, command)]
    pictures: list[Path] = []

    def picture(path: Path, words: str) -> str:
        pictures.append(path)
        return f"![{words}]({path.relative_to(folder).as_posix()})"

    if len(summary.tasks) > 1:
        parts += ["## Over all tasks", overall_table(summary), _pairs_of(summary.pairs, "tasks")]
        if any(of.success for of in summary.overall):
            parts.append(picture(save(overall_figure(summary), folder / "figures" / "overall.png"), "all tasks"))
    if len(summary.tasks) > MOST_TASKS:
        parts += ["## Task by task", _short_table(summary, rows[0].objective)]
    else:
        for number, task in enumerate(summary.tasks, 1):
            show(f"drawing {task.scene}, {task.task}")
            stem = folder / "figures" / f"{number:02d}_{_safe(task.scene)}_{_safe(task.task)}"
            words = f"{task.scene}, task {task.task}"
            parts += [f"## {_cell(task.scene)}, task {_cell(task.task)}", task_table(task, rows[0].objective)]
            if any(cell.rows for cell in task.cells):
                parts.append(picture(save(_boxes(task, words), stem.with_name(stem.name + ".png")), words))
            if curves := _curves(task):
                meaning = OBJECTIVES[rows[0].objective]
                figure = convergence(words, f"{meaning.quantity} ({meaning.unit})", curves)
                parts.append(
                    picture(save(figure, stem.with_name(stem.name + "_convergence.png")), f"{words}: convergence")
                )
            parts += [_pairs_of(task.pairs, "pairs of runs"), _failures(task)]
    parts.append(READING)
    folder.mkdir(parents=True, exist_ok=True)
    report = write_whole(folder / "report.md", "\n\n".join(part for part in parts if part) + "\n")
    every_pair = [*summary.pairs, *(pair for task in summary.tasks for pair in task.pairs)]
    return [report, write_whole(folder / "pairs.csv", _as_csv(every_pair)), *pictures]


READING = """## How to read it

- *Success*: the planner handed out a motion that does the task and that the verifier calls safe, with Wilson's 95 %
  interval. *Unsafe* counts motions handed out that are not.
- *Not applicable*: the planner does not serve this arm, task or setting. Such runs are no failures, and in no test.
- Medians are over the runs with success, in brackets their 95 % bootstrap interval; a value without brackets is the
  same in every run. The best median of what the objective asks for is bold.
- *Time* is from the question to the verified motion, on one core; it differs from machine to machine.
- Tests rank runs without success behind all others. On a task: Mann-Whitney over the seeds. Over all tasks: Wilcoxon's
  signed-rank test over the medians of the tasks that both planners serve. p-values are two-sided; *Holm* is adjusted
  for all pairs of the table.
  *Delta* is Cliff's: -1 if the first planner is always the smaller, 0 if neither, 1 if always the greater.
- Pictures: a box holds the middle half of the runs with success, the thick line is the median, whiskers reach to the
  farthest run within one and a half boxes, and every run is a point. A diamond stands for runs that are all the same.
- `rows.jsonl` has every run with what is needed to make it again, `pairs.csv` every test."""


def _head(rows: Sequence[Row], summary: Summary, command: str) -> str:
    one = rows[0]
    seeds = len({row.seed for row in rows})
    providers = sorted({row.provider for row in rows})
    lines = [
        "# Planners side by side",
        "",
        f"{len(rows)} runs: {counted(len(summary.overall), 'planner')}, {counted(len(summary.tasks), 'task')} of "
        f"{counted(len({row.scene_sha256 for row in rows}), 'scene')}, {counted(seeds, 'seed')}. "
        f"Objective: {one.objective}. "
        f"Budget: {'each planner its own' if one.budget is None else f'{one.budget} evaluations'}. "
        f"Timeout: {'none' if one.timeout_s is None else f'{one.timeout_s:g} s'}. By {'; '.join(providers)}.",
        "",
        "```sh",
        command,
        "```",
    ]
    return "\n".join(lines)


def task_table(task: TaskSummary, objective: str) -> str:
    """Return what the planners came to on a task, a line each."""
    metrics = [m for m in METRICS if m.column in ALWAYS or any(cell.medians[m.column] for cell in task.cells)]
    header = ["planner", "success", "unsafe", *(f"{m.title} ({m.unit})" if m.unit else m.title for m in metrics)]
    best = task.best(OBJECTIVES[objective].column)
    lines = []
    for cell in task.cells:
        values = []
        for metric in metrics:
            interval = cell.medians[metric.column]
            shown = _interval(interval, metric)
            if (
                metric.column == OBJECTIVES[objective].column
                and interval is not None
                and shown == _at_best(task, metric, best)
            ):
                shown = f"**{shown}**"
            values.append(shown)
        lines.append([f"`{cell.planner}`", _success(cell), str(cell.unsafe), *values])
    return markdown_table(header, lines)


def _at_best(task: TaskSummary, metric: Metric, best: float | None) -> str | None:
    """How the best median is shown: planners that are equal to the last digit shown are equally good."""
    for cell in task.cells:
        interval = cell.medians[metric.column]
        if interval is not None and interval.value == best:
            return _interval(interval, metric)
    return None


def _success(cell: Cell) -> str:
    if cell.success is None:
        return NA
    return f"{len(cell.good)} of {len(cell.rows)} {_percent(cell.success)}"


def _percent(interval: Interval) -> str:
    return f"[{100 * interval.low:.0f}, {100 * interval.high:.0f}] %"


def _interval(interval: Interval | None, metric: Metric) -> str:
    if interval is None:
        return "-"
    digits = {"tip_length_m": ".2f", "joint_travel_rad": ".3f", "duration_s": ".2f", "evaluations": ".0f"}
    middle, low, high = (
        format(value, ".0f" if value >= 1000.0 else digits.get(metric.column, ".3g"))
        for value in (interval.value, interval.low, interval.high)
    )
    return middle if low == high == middle else f"{middle} [{low}, {high}]"


def overall_table(summary: Summary) -> str:
    """Return what the planners came to over all tasks, a line each."""
    header = ["planner", "runs with success (%)", "unsafe", "cost over the task's best", "best on", "time (ms)"]
    lines = []
    for of in summary.overall:
        if of.success is None:
            lines.append([f"`{of.planner}`", NA, *["-"] * 4])
            continue
        ratio, time = "-", "-"
        if of.ratio is not None:
            ratio = f"{of.ratio.value:.3f} [{of.ratio.low:.3f}, {of.ratio.high:.3f}]"
            ratio += "" if len(of.ratios) == of.tasks else f" on {len(of.ratios)} of {of.tasks}"
        if of.time is not None:
            time = _interval(of.time, METRICS[-1])
        success = f"{100 * of.success.value:.1f} [{100 * of.success.low:.1f}, {100 * of.success.high:.1f}]"
        lines.append([f"`{of.planner}`", success, str(of.unsafe), ratio, f"{of.best_on} of {of.tasks}", time])
    return markdown_table(header, lines) + (
        "\n\nCost over the best: on each task the planner's median over the least median of any, then the median over "
        "the tasks that it solved."
    )


def _short_table(summary: Summary, objective: str) -> str:
    metric = next(m for m in METRICS if m.column == OBJECTIVES[objective].column)
    planners = [of.planner for of in summary.overall]
    lines = []
    for task in summary.tasks:
        cells = {cell.planner: cell for cell in task.cells}
        values = []
        for planner in planners:
            cell = cells.get(planner)
            if cell is not None and cell.success is None:
                values.append("n/a")
                continue
            if cell is None or (interval := cell.medians[metric.column]) is None:
                values.append("-")
                continue
            some = "" if len(cell.good) == len(cell.rows) else f" ({len(cell.good)} of {len(cell.rows)})"
            shown = _interval(Interval(interval.value, interval.value, interval.value), metric)
            values.append((f"**{shown}**" if shown == _best_alone(task, metric) else shown) + some)
        lines.append([_cell(task.scene), _cell(task.task), *values])
    note = (
        f"Median {metric.title} ({metric.unit}) of the runs with success, and how many they are if not all; n/a: the "
        "planner does not serve the arm or task."
    )
    return note + "\n\n" + markdown_table(["scene", "task", *(f"`{planner}`" for planner in planners)], lines)


def _best_alone(task: TaskSummary, metric: Metric) -> str | None:
    best = task.best(metric.column)
    return None if best is None else _interval(Interval(best, best, best), metric)


def _pairs_of(pairs: Sequence[Pair], what: str) -> str:
    cost = [pair for pair in pairs if pair.metric == "cost"]
    if not cost:
        return ""
    header = ["first", "second", f"{what}: first cheaper / equal / costlier", "p", "Holm", "delta"]
    lines = [
        [
            f"`{pair.first}`",
            f"`{pair.second}`",
            f"{pair.less} / {pair.equal} / {pair.greater}",
            _p(pair.p),
            _p(pair.p_holm),
            f"{pair.delta:+.2f}",
        ]
        for pair in cost
    ]
    return f"Cost, planner against planner ({cost[0].test}):\n\n" + markdown_table(header, lines)


def _p(p: float) -> str:
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def _failures(task: TaskSummary) -> str:
    failed, apart = [], []
    for cell in task.cells:
        for failure, count in cell.failures.most_common():
            of = cell.refused if failure == NOT_APPLICABLE else cell.rows
            example = _cell(next(row.message for row in of if row.failure == failure) or "")
            if failure == NOT_APPLICABLE:
                apart.append(f"- `{cell.planner}`: {example}")
            else:
                failed.append(f"- `{cell.planner}`, {count} of {len(of)}: {FAILURES[failure]}, such as: {example}")
    parts = [("Without success:", failed), ("Not applicable, and in no count or test:", apart)]
    return "\n\n".join(f"{head}\n\n" + "\n".join(lines) for head, lines in parts if lines)


def _boxes(task: TaskSummary, title: str) -> Figure:
    cells = [cell for cell in task.cells if cell.rows]
    panels: list[Panel | Shares] = [
        Panel(f"{metric.title} ({metric.unit})", [metric.of(cell.good) for cell in cells], metric.column == "time_s")
        for metric in METRICS
        if metric.column in ALWAYS
    ]
    return side_by_side(title, [cell.planner for cell in cells], panels)


def overall_figure(summary: Summary) -> Figure:
    """Draw success, cost and time of the planners over all tasks."""

    def times(of: Overall) -> list[float]:
        cells = (cell for task in summary.tasks for cell in task.cells if cell.planner == of.planner)
        return [interval.value for cell in cells if (interval := cell.medians["time_s"]) is not None]

    shown = [(of, of.success) for of in summary.overall if of.success is not None]
    panels: list[Panel | Shares] = [
        Shares("success (%)", [(success.value, success.low, success.high) for _, success in shown]),
        Panel("cost over the task's best", [of.ratios for of, _ in shown]),
        Panel("median time (ms)", [times(of) for of, _ in shown], logarithmic=True),
    ]
    title = f"over {len(summary.tasks)} tasks, a point each"
    return side_by_side(title, [of.planner for of, _ in shown], panels)


def _curves(task: TaskSummary) -> dict[str, list[Curve]]:
    """The curves of convergence, where planners gave some."""
    found = {cell.planner: [row.convergence for row in cell.rows if row.convergence] for cell in task.cells}
    return {planner: curves for planner, curves in found.items() if curves}


def _as_csv(pairs: Sequence[Pair]) -> str:
    names = [part.name for part in fields(Pair)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*names, "a12"])
    for pair in pairs:
        writer.writerow([*("" if (x := getattr(pair, name)) is None else x for name in names), pair.a12])
    return text.getvalue()


def markdown_table(header: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """Return a table: names to the left, numbers to the right."""
    left = {"planner", "first", "second", "scene", "task"}
    rule = ["---" if name in left else "---:" for name in header]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (header, rule, *lines))


def _cell(text: str) -> str:
    """Foreign text that neither ends a cell nor marks anything up."""
    return "".join("\\" + letter if letter in "|*_`<>[]\\" else letter for letter in text)


def _safe(name: str) -> str:
    """``name`` as part of a file's name."""
    return re.sub(r"[^\w.-]+", "-", name)[:60]
