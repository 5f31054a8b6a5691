#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The plots of docs/benchmarks.md are drawn from the tables in bench/results: every plot of the page is made, and names every row. The
figures in README.md are those of the tables.

Usage: check_figures.py SOURCE_DIRECTORY WORK_DIRECTORY
"""
import glob
import html
import os
import re
import sys


# Plots of points by their numbers, without the names of rows.
BY_NUMBER = ("growth", "hulls")

# Rows of README's table: what the first column calls it, the column of names in the tables, the name there, and our column and CGAL's.
README_ROWS = [
    ("two spheres of 20,480 triangles", "case", "spheres-5", "ours s", "CGAL s"),
    ("12^3 tetrahedra with 11^3 cubes", "case", "tetgrid-12", "ours s", "CGAL s"),
    ("a cylinder of 1000 sides and itself, turned by 10^-6 degrees", "case", "cylinder-1000-1e-6", "ours s", "CGAL s"),
    ("those spheres, peak memory with import", "case", "spheres-5", "MB", "CGAL"),
    ("mushroom (226 vertices) + cube, Minkowski sum", "sum", "mushroom + cube", "ours, B closed", "CGAL"),
    ("8 silhouettes of 200 vertices to a hull", "case", "8 views of 200", "hull s", "CGAL s"),
]


def shown(value: float) -> str:
    """Two digits, as README rounds."""
    return f"{float(f'{value:.2g}'):g}"


def wrong_in_readme(plot, readme: str, tables: list) -> list[str]:
    """The rows of README's table that are not those of the results."""
    rows = {row[0]: row[1:] for table in plot.tables_in(readme) for row in table.rows}
    problems = []
    for text, names, name, ours, peer in README_ROWS:
        table = next((t for t in tables if names in t.header and ours in t.header and name in t.column(names)), None)
        if table is None or text not in rows:
            problems.append(f"README.md or bench/results lacks {text}")
            continue
        at = table.column(names).index(name)
        first = plot.number(table.column(ours)[at])
        after = ours if peer == "CGAL" and table.header.count("CGAL") > 1 else ""
        second = plot.number(table.column(peer, after)[at])
        expected = [shown(first), shown(second), shown(second / first)]
        found = [re.sub(r" (s|MB)$", "", cell) for cell in rows[text]]
        if found != expected:
            problems.append(f"README.md, {text}: {found} should be {expected}")
    return problems


def extremes(numbers) -> tuple[str, str]:
    """The least and the greatest number, with two digits."""
    numbers = list(numbers)
    return shown(min(numbers)), shown(max(numbers))


def expected_sentences(plot, tables: list) -> dict[str, list[str]]:
    """What README and docs/benchmarks.md say in sentences, from the tables: the pages' names, and phrases that they must have."""
    beside = next(t for t in tables if "B/vertex" in t.header)

    def numbers(name: str, after: str = "") -> list[float]:
        return [plot.number(cell) for cell in beside.column(name, after)]

    least, most = extremes(numbers("ratio", "operation"))
    slower, faster = extremes(1 / float(ratio) for ratio in (most, least))
    memory = " to ".join(extremes(numbers("ratio", "peak MB")))
    imports = " to ".join(f"{ratio:.1f}" for ratio in (min(numbers("ratio", "build")), max(numbers("ratio", "build"))))
    exports = f"{max(numbers('ratio', 'export')):.1f}"
    meshes = [plot.number(cell) for case, cell in zip(beside.column("case"), beside.column("B/vertex"))
              if case.startswith(("spheres", "bigsmall", "scans"))]
    threads = next(t for t in tables if "on two" in t.header)
    gains = [float(gain) for cell in threads.column("gain", "operation") for gain in cell.split()]
    two = f"{min(gains):.1f} to {max(gains):.1f}"
    return {
        "README.md": [f"about {round(max(meshes), -1):.0f} bytes per vertex", f"Booleans run {slower} to {faster} times as fast with {memory} of its memory",
                      f"importing a mesh takes {imports} times as long", f"is {two} times as fast on two cores"],
        "docs/benchmarks.md": [f"Booleans take {least} to {most} of its time and {memory} of its memory",
                               f"importing a mesh takes {imports} times as long", f"exports take up to {exports} times as long"],
    }


def main() -> int:
    source, work = sys.argv[1:]
    sys.path.insert(0, os.path.join(source, "bench"))
    import plot
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        print("skipped: matplotlib is not installed (apt-get install python3-matplotlib)")
        return 0
    with open(os.path.join(source, "docs", "benchmarks.md"), encoding="utf-8") as file:
        page = file.read()
    results = ""
    for path in sorted(glob.glob(os.path.join(source, "bench", "results", "*.md"))):
        with open(path, encoding="utf-8") as file:
            results += file.read() + "\n"
    made = {os.path.basename(path): path for path in plot.draw(results, work)}
    shown = set(re.findall(r"pictures/(bench_\w+\.svg)", page))
    problems = [f"{name} is shown but not drawn" for name in shown - set(made)]
    problems += [f"{name} is drawn but not shown" for name in set(made) - shown]
    for table in plot.tables_in(results):
        for name, columns, _ in plot.FIGURES:
            if not columns <= set(table.header) or "case" not in table.header or name in BY_NUMBER:
                continue
            for folder in (work, os.path.join(source, "docs", "pictures")):
                with open(os.path.join(folder, f"bench_{name}.svg"), encoding="utf-8") as file:
                    text = html.unescape(file.read())
                for case in table.column("case"):
                    if case not in text:
                        problems.append(f"{folder}: bench_{name}.svg has no {case}; draw it anew with bench/plot.py")
    with open(os.path.join(source, "README.md"), encoding="utf-8") as file:
        problems += wrong_in_readme(plot, file.read(), plot.tables_in(results))
    for name, phrases in expected_sentences(plot, plot.tables_in(results)).items():
        with open(os.path.join(source, name), encoding="utf-8") as file:
            text = " ".join(file.read().split())
        problems += [f"{name} does not say: {phrase}" for phrase in phrases if phrase not in text]
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
