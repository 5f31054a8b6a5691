#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The figures of docs/benchmarks.md are drawn from its tables: every figure of the page is made, and names every row.

Usage: check_figures.py SOURCE_DIRECTORY WORK_DIRECTORY
"""
import html
import os
import re
import sys


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
    made = {os.path.basename(path): path for path in plot.draw(page, work)}
    shown = set(re.findall(r"pictures/(bench_\w+\.svg)", page))
    problems = [f"{name} is shown but not drawn" for name in shown - set(made)]
    problems += [f"{name} is drawn but not shown" for name in set(made) - shown]
    for table in plot.tables_in(page):
        for name, columns, _ in plot.FIGURES:
            if not columns <= set(table.header) or "case" not in table.header or name == "growth":
                continue
            for folder in (work, os.path.join(source, "docs", "pictures")):
                with open(os.path.join(folder, f"bench_{name}.svg"), encoding="utf-8") as file:
                    text = html.unescape(file.read())
                for case in table.column("case"):
                    if case not in text:
                        problems.append(f"{folder}: bench_{name}.svg has no {case}; draw it anew with bench/plot.py")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
