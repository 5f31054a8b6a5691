#!/usr/bin/env python3
"""Runs clang-tidy over all sources of ours in a build tree, one process a core, and prints each finding once.

Usage: lint.py BUILD_DIRECTORY [--seconds N] [PART...]

The build tree is best one of NEF_COMPILE_TOGETHER: what headers cost is paid once for some forty sources, so that all of
them are looked at in the time that a tenth would take one by one. With PARTs, only translation units whose paths have
one of them. With --seconds, no unit is begun after so many: those come first that runs have left out, then those that
changes concern, then the others (see ci_selection.py). Exits 1 if there are findings, where clang-tidy did not come to its
end, and where a unit was left out that was due.
"""
import argparse
import concurrent.futures
import json
import os
import re
import subprocess
import sys
import threading
import time

import ci_selection

FOLDERS = ("nef", "apps", "fuzz", "python", "tests", "bench")
WARNING = re.compile(r"^(/\S+:\d+:\d+): (?:warning|error): ", re.MULTILINE)
# What stands in a unit is no slip: it includes sources.
OPTIONS = ["--quiet", "--extra-arg=-Wno-unknown-warning-option", "--checks=-bugprone-suspicious-include"]


def units(build: str) -> dict[str, list[str]]:
    """What is compiled, with the sources of ours in it."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        names = {os.path.relpath(entry["file"]) for entry in json.load(file)}
    result = {}
    for name in sorted(names):
        if name.startswith(tuple(folder + "/" for folder in FOLDERS)):
            result[name] = [name]
        elif os.path.exists(name):
            with open(name, encoding="utf-8") as file:
                included = re.findall(r'^#include "(.*\.cpp)"$', file.read(), re.MULTILINE)
                result[name] = [os.path.relpath(source) for source in included]  # as git names them
    return {name: sources for name, sources in result.items() if sources}


def concerned(every: dict[str, list[str]], files: list[str]) -> set[str]:
    """The units that hold one of these files, or include it; one of those for each header."""
    unit_of = {source: unit for unit, sources in every.items() for source in sources}
    includers: dict[str, set[str]] = {}
    for source, unit in unit_of.items():
        if os.path.exists(source):
            with open(source, encoding="utf-8") as text:
                for header in re.findall(r'^#include "(.*\.h)"$', text.read(), re.MULTILINE):
                    includers.setdefault(header, set()).add(unit)
    result = {unit_of[file] for file in files if file in unit_of}
    for file in files:
        units_of_header = includers.get(file, set())
        if units_of_header and not units_of_header & result:
            result.add(min(units_of_header))
    return result


def stand_in_for_made_sources(chosen: dict[str, list[str]]) -> None:
    """What is made while building is no source of ours, but is included."""
    for sources in chosen.values():
        for source in sources:
            if not os.path.exists(source):
                os.makedirs(os.path.dirname(source), exist_ok=True)
                open(source, "w", encoding="utf-8").close()


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("--seconds", type=int)
    parser.add_argument("parts", nargs="*")
    arguments = parser.parse_args()
    build, parts = arguments.build, arguments.parts
    chosen = {name: sources for name, sources in units(build).items()
              if not parts or any(part in name for part in parts)}
    stand_in_for_made_sources(chosen)
    headers = f"--header-filter=^{re.escape(os.getcwd())}/({'|'.join(FOLDERS)})/.*\\.(h|cpp)$"

    places = set()
    printing = threading.Lock()

    def check(unit: str) -> bool:
        """Whether clang-tidy came to its end; prints its findings."""
        begin = time.monotonic()
        command = ["clang-tidy", *OPTIONS, headers, "-p", build, unit]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        starts = [match.start() for match in WARNING.finditer(result.stdout)]
        with printing:
            if os.environ.get("NEF_LINT_TIMES"):
                print(f"{time.monotonic() - begin:6.1f} s {unit}", flush=True)
            for start, end in zip(starts, starts[1:] + [len(result.stdout)]):
                finding = result.stdout[start:end]
                place = finding.splitlines()[0]
                ours = place.startswith(os.getcwd() + "/") or ": error: " in place
                if ours and place not in places:
                    places.add(place)
                    print(finding.rstrip(), flush=True)
            if result.returncode == 0 or starts:
                return True
            broken.append(unit)
            print(f"clang-tidy ended with {result.returncode} at {unit}\n{result.stderr[-2000:]}", flush=True)
            return False

    broken: list[str] = []
    complete = True
    if arguments.seconds is None:
        largest_first = sorted(chosen, key=lambda unit: -len(chosen[unit]))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(check, largest_first))
    else:
        complete = ci_selection.look_at(chosen, concerned(chosen, ci_selection.changed()), arguments.seconds,
                                        lambda unit, _: check(unit))
    print(f"clang-tidy: {len(chosen)} units, {len(places)} findings")
    return 0 if complete and not places and not broken else 1


if __name__ == "__main__":
    sys.exit(main())
