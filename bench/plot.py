#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the tables of benchmarks as figures (SVG), by what their columns are called.

  bench/plot.py bench/results/*.md -o docs/pictures     the plots of docs/benchmarks.md
  bench/run.py --sweep --plot FOLDER                    the same as a benchmark ends
  nef_bench_minkowski | bench/plot.py - -o FOLDER       tables from a pipe

Tables are those that the benchmarks print: columns with two or more spaces between them, or with bars. Needs matplotlib
(Debian: python3-matplotlib).
"""
import argparse
import os
import re
import sys
from typing import Callable, NamedTuple, Optional

INK = {"ours": "#2f6f9f", "CGAL": "#b5533c", "Manifold": "#c98a2b", "other": "#6b8f5e", "bound": "#222222"}


class Table(NamedTuple):
    header: list[str]
    rows: list[list[str]]

    def column(self, name: str, after: str = "") -> list[str]:
        """The cells of a column; of several with one name, the first that comes after another column."""
        begin = self.header.index(after) + 1 if after else 0
        index = self.header.index(name, begin)
        return [row[index] for row in self.rows]


def tables_in(text: str) -> list[Table]:
    """All tables of a text, in its order."""
    result: list[Table] = []
    current: Optional[Table] = None
    for line in text.splitlines():
        cells = cells_of(line)
        if cells is None:
            current = None
        elif current is None:
            current = Table(cells, [])
            result.append(current)
        elif len(cells) == len(current.header) and not all(set(cell) <= set("-: ") for cell in cells):
            current.rows.append(cells)
    return [table for table in result if table.rows]


def cells_of(line: str) -> Optional[list[str]]:
    if line.startswith("|"):
        return [cell.strip() for cell in line.strip().strip("|").split("|")]
    cells = re.split(r"\s{2,}", line.strip())
    return cells if len(cells) >= 4 else None


def number(cell: str) -> Optional[float]:
    """The first number of a cell that is a time or a ratio; nothing for "-", "X" and bounds."""
    found = re.match(r"(?:[a-z ]+: )?(\d+(?:\.\d+)?(?:e-?\d+)?)\b", cell)
    return float(found.group(1)) if found else None


def bars(axes, names: list[str], series: dict[str, list[Optional[float]]], colors: list[str], unit: str) -> None:
    """Horizontal bars, the first name on top, on a logarithmic axis where they differ much; no bar without a number."""
    height = 0.8 / len(series)
    for k, (label, values) in enumerate(series.items()):
        places = [i + (k - (len(series) - 1) / 2) * height for i, v in enumerate(values) if v]
        shown = [v for v in values if v]
        axes.barh(places, shown, height=height * 0.92, color=colors[k], label=label)
        for y, v in zip(places, shown):
            axes.text(v, y, f" {v:.0f}" if v >= 100 else f" {v:.3g}", va="center", fontsize=7)
    axes.set_yticks(range(len(names)), names, fontsize=8)
    axes.set_ylim(len(names) - 0.5, -0.5)
    present = [v for values in series.values() for v in values if v]
    if max(present) > 20 * min(present):
        axes.set_xscale("log")
    axes.set_xlabel(unit)
    axes.margins(x=0.12)
    axes.spines[["top", "right"]].set_visible(False)
    if len(series) > 1:
        axes.legend(fontsize=8, frameon=False)


def booleans(plot, table: Table):
    """CGAL's time and memory over ours, with the promised ratios."""
    names = table.column("case")
    figure, (left, right) = plot.subplots(1, 2, figsize=(9, 0.33 * len(names) + 1.2), sharey=True)
    bars(left, names, {"": [number(c) for c in table.column("ratio", "CGAL s")]}, [INK["ours"]],
         "operation: CGAL's time over ours")
    for i, cell in enumerate(table.column("wanted")):
        wanted = number(cell)
        if wanted:
            left.plot([wanted, wanted], [i - 0.45, i + 0.45], color=INK["bound"], linewidth=1.5)
    bars(right, names, {"": [number(c) for c in table.column("ratio", "MB")]}, [INK["CGAL"]],
         "peak memory: CGAL's over ours")
    left.set_title("bars beyond the black marks: promise kept", fontsize=9)
    return figure


def growth(plot, table: Table):
    """Time per vertex over the number of vertices, a line for each family of cases."""
    families: dict[str, list[tuple[float, float]]] = {}
    for name, vertices, time in zip(table.column("case"), table.column("vertices"), table.column("us/vertex")):
        families.setdefault(name.split("-")[0], []).append((float(vertices), float(time)))
    figure, axes = plot.subplots(figsize=(7, 4))
    for name, points in families.items():
        axes.plot(*zip(*points), marker="o", markersize=3, label=name)
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.set_xlabel("vertices of the result")
    axes.set_ylabel("microseconds a vertex")
    axes.legend(fontsize=8, frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    return figure


def manifold(plot, table: Table):
    """Ours over Manifold, phase by phase."""
    names = table.column("case")
    phases = ["build", "operation", "export", "peak MB"]
    figure, axes = plot.subplots(1, 4, figsize=(11, 0.33 * len(names) + 1.2), sharey=True)
    for panel, phase in zip(axes, phases):
        bars(panel, names, {"": [number(c) for c in table.column("ratio", phase)]}, [INK["Manifold"]],
             f"{phase.replace('peak MB', 'peak memory')}: ours / Manifold")
        panel.axvline(1, color=INK["bound"], linewidth=1)
    return figure


def sums(plot, table: Table):
    """Seconds of Minkowski sums beside CGAL's."""
    rows = [i for i, cell in enumerate(table.column("CGAL")) if number(cell)]
    names = [table.column("sum")[i] for i in rows]
    figure, axes = plot.subplots(figsize=(8, 0.5 * len(names) + 1.2))
    series = {"ours": [number(table.column("ours, B closed")[i]) for i in rows],
              "CGAL": [number(table.column("CGAL")[i]) for i in rows]}
    bars(axes, names, series, [INK["ours"], INK["CGAL"]], "seconds")
    return figure


def stress(plot, table: Table):
    """Seconds of sums that make unions explode, by cells alone and with convolutions."""
    names = table.column("sum")
    figure, axes = plot.subplots(figsize=(8, 0.5 * len(names) + 1.2))
    series = {name: [number(cell) for cell in table.column(name)] for name in ("cells: auto", "now: auto")}
    bars(axes, names, series, [INK["ours"], INK["other"]], "seconds")
    return figure


def sum_growth(plot, table: Table):
    """Seconds of sums over the number of pairs of cells, a line for each family."""
    families: dict[str, list[tuple[float, float]]] = {}
    for name, pairs, time in zip(table.column("family of sums"), table.column("pairs"), table.column("CPU s")):
        families.setdefault(name, []).append((float(pairs), float(time)))
    figure, axes = plot.subplots(figsize=(7, 4))
    for (name, points), ink in zip(families.items(), ("ours", "CGAL", "other")):
        axes.plot(*zip(*points), marker="o", markersize=3, label=name, color=INK[ink])
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("pairs of convex cells")
    axes.set_ylabel("seconds")
    axes.legend(fontsize=8, frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    return figure


def hulls(plot, table: Table):
    """Seconds of visual hulls by the number of views, and by that of the outlines' vertices."""
    figure, panels = plot.subplots(1, 2, figsize=(9, 3.6), sharey=True)
    for panel, pattern, label in ((panels[0], r"(\d+) views of 100$", "views of 100 vertices"),
                                  (panels[1], r"8 views of (\d+)$", "vertices of each of 8 outlines")):
        rows = [(int(found.group(1)), i) for i, name in enumerate(table.column("case"))
                if (found := re.match(pattern, name))]
        for name, column, ink in (("ours", "hull s", "ours"), ("voxels, 256^3", "voxels s", "other"),
                                  ("CGAL, the same cones", "CGAL s", "CGAL")):
            points = [(x, number(table.column(column)[i])) for x, i in sorted(set(rows))]
            points = [(x, y) for x, y in points if y]
            panel.plot([x for x, _ in points], [y for _, y in points], marker="o", markersize=4, color=INK[ink], label=name)
            if name == "ours":
                x0, y0 = points[0]
                xs = [x for x, _ in points]
                panel.plot(xs, [y0 * (x / x0) ** 1.2 for x in xs], color=INK["bound"], linewidth=1, linestyle=":",
                           label="n^1.2")
        panel.set_xscale("log")
        panel.set_yscale("log")
        panel.set_xlabel(label)
        panel.spines[["top", "right"]].set_visible(False)
    panels[0].set_ylabel("processor seconds")
    panels[0].legend(fontsize=7, frameon=False)
    return figure


def passages(plot, table: Table):
    """First solution of each planner by the width of the opening; a cross at the limit where none was found."""
    planners = table.header[table.header.index("next query") + 1:]
    kinds = sorted(set(table.column("opening")))
    figure, panels = plot.subplots(1, len(kinds), figsize=(4.5 * len(kinds), 3.6), sharey=True, squeeze=False)
    for panel, kind in zip(panels[0], kinds):
        rows = [i for i, opening in enumerate(table.column("opening")) if opening == kind]
        widths = [table.column("w")[i] for i in rows]
        for name in ["TightPlanner", *planners]:
            cells = [table.column(name)[i] for i in rows]
            solved = [cell for cell in cells if number_of_run(cell) is not None]
            panel.plot([k for k, c in enumerate(cells) if number_of_run(c) is not None],
                       [number_of_run(c) for c in solved], marker="o", markersize=4,
                       linewidth=2 if name == "TightPlanner" else 1, label=name)
            panel.plot([k for k, c in enumerate(cells) if number_of_run(c) is None],
                       [10.0] * (len(cells) - len(solved)), "x", color="gray", markersize=5)
        panel.set_xticks(range(len(widths)), widths)
        panel.set_yscale("log")
        panel.set_xlabel("width beyond the robot's")
        panel.set_title(kind, fontsize=9)
        panel.spines[["top", "right"]].set_visible(False)
    panels[0][0].set_ylabel("seconds (crosses: none in 10 s)")
    panels[0][-1].legend(fontsize=7, frameon=False)
    return figure


def number_of_run(cell: str) -> Optional[float]:
    """The seconds of a run that found a path or a proof."""
    found = re.search(r"(\d+\.\d+) s\b", cell)
    return float(found.group(1)) if found else None


# Which columns make which figure.
FIGURES: list[tuple[str, set[str], Callable]] = [
    ("booleans", {"CGAL s", "wanted"}, booleans),
    ("growth", {"us/vertex"}, growth),
    ("manifold", {"Manifold", "export"}, manifold),
    ("sums", {"ours, B closed", "CGAL"}, sums),
    ("stress", {"cells: auto", "now: auto"}, stress),
    ("sum_growth", {"family of sums", "pairs"}, sum_growth),
    ("hulls", {"hull s", "voxels s", "CGAL s"}, hulls),
    ("passages", {"opening", "TightPlanner"}, passages),
]


def draw(text: str, folder: str) -> list[str]:
    """Draws every table that is known; returns the files. A later table of a kind takes the place of an earlier one."""
    import matplotlib
    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "nef", "font.size": 9})
    import matplotlib.pyplot as plot
    os.makedirs(folder, exist_ok=True)
    files: dict[str, None] = {}
    for table in tables_in(text):
        for name, columns, make in FIGURES:
            if not columns <= set(table.header):
                continue
            figure = make(plot, table)
            path = os.path.join(folder, f"bench_{name}.svg")
            figure.savefig(path, bbox_inches="tight", facecolor="white", metadata={"Date": None})
            plot.close(figure)
            files[path] = None
    return list(files)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", nargs="+", help="files with tables, - for standard input")
    parser.add_argument("-o", "--output", required=True, metavar="FOLDER", help="where the figures go")
    args = parser.parse_args()
    text = ""
    for name in args.input:
        if name == "-":
            text += sys.stdin.read() + "\n"
            continue
        with open(name, encoding="utf-8") as file:
            text += file.read() + "\n"
    files = draw(text, args.output)
    if not files:
        print(f"bench/plot.py: {' '.join(args.input)}: there is no table of a benchmark in it", file=sys.stderr)
        return 2
    for path in files:
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
