#!/usr/bin/env python3
"""Runs clang-tidy over sources of ours in a build tree, one process a core: the libraries, programs, fuzzers and the
Python binding, and headers that these include. Not tests and benchmarks.

Usage: lint.py BUILD_DIRECTORY [BUDGET]

With a budget (CPU seconds, by what sources of nef/ and of apps/ take), only sources that changed and one that includes
each header that changed, then a share of the rest that rotates from day to day (see ci_selection.py). Says what it
leaves out. Exits 1 and prints the findings if there are any.
"""
import concurrent.futures
import json
import os
import re
import subprocess
import sys

import ci_selection

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


def cost(source: str) -> int:
    """CPU seconds that clang-tidy took for a source of this kind, measured: GMP and little else, or OMPL, OpenCV, JSON."""
    return 5 if source.startswith("nef/") else 15


def all_sources(build: str) -> list[str]:
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    root = os.getcwd() + "/"
    names = {entry["file"][len(root) :] for entry in commands if entry["file"].startswith(root)}
    return sorted(name for name in names if name.startswith(("nef/", "apps/", "fuzz/", "python/")))


def concerned(sources: list[str]) -> list[str]:
    """The sources that changed, and for each header that changed its own source or else the first that includes it."""
    changed = set(ci_selection.changed())
    result = [source for source in sources if source in changed]
    headers = {file for file in changed if file.endswith(".h") and os.path.exists(file)}
    for header in sorted(headers):
        own = header[:-2] + ".cpp"
        if own in sources:
            result.append(own)
            continue
        for source in sources:
            with open(source, encoding="utf-8") as file:
                if header in INCLUDE.findall(file.read()):
                    result.append(source)
                    break
    return list(dict.fromkeys(result))


def affordable(sources: list[str], budget: int) -> list[str]:
    chosen = []
    for source in sources:
        budget -= cost(source)
        if budget < 0:
            break
        chosen.append(source)
    return chosen


def within(sources: list[str], budget: int) -> list[str]:
    first = concerned(sources)
    chosen = affordable(ci_selection.rotated(first), budget * 3 // 4)
    budget -= sum(cost(source) for source in chosen)
    rest = [source for source in ci_selection.rotated(sources) if source not in first]
    turn = affordable(rest, budget)
    print(f"lint: {len(chosen)} of {len(first)} sources that changes concern, {len(turn)} of the {len(rest)} others, whose "
          f"turn it is today; left out {len(sources) - len(chosen) - len(turn)}", flush=True)
    return chosen + turn


def main() -> int:
    build = sys.argv[1]
    sources = all_sources(build)
    if len(sys.argv) > 2:
        sources = within(sources, int(sys.argv[2]))

    def check(source: str) -> str:
        result = subprocess.run(
            ["clang-tidy", "--quiet", "--extra-arg=-Wno-unknown-warning-option", "-p", build, source],
            capture_output=True,
            text=True,
            check=False,
        )
        return result.stdout if "warning:" in result.stdout or "error:" in result.stdout else ""

    findings = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for output in pool.map(check, sources):
            if output:
                findings += 1
                print(output)
    print(f"clang-tidy: {len(sources)} sources, {findings} with findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
