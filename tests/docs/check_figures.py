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
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
