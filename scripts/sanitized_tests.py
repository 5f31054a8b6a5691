#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds test programs with sanitizers and runs their cases, each in a process of its own; prints what fails.

Items are programs, and parts of those that take long. They come one after the other, those first that runs have left out,
then those of the core and of what changed, then the others (see ci_selection.py). After so many seconds no case is begun but
of items that are due. Exits 1 if a case fails, or if an item was left out that was due.

Usage: sanitized_tests.py BUILD --seconds N [--tags TAGS]     BUILD is configured, for instance build/sanitize; with TAGS, as
                                                              "[threads],[parallel]", only cases with one of them
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import threading
import time
import zlib

import ci_selection

LIMIT = 900  # seconds; a case that takes longer has failed
# In which quarters a program has parts. Two that take long to build have none in common; all quarters take about equally long.
QUARTERS = {
    "test_planner": [0, 2], "test_visual_hull": [1, 3],
    "test_core": [0], "test_query": [0], "test_nef_mpi": [0],
    "test_minkowski": [1], "test_command": [1],
    "test_tiles": [2], "test_view": [2], "test_remeshing": [2], "test_studio": [2],
    "test_io": [3], "test_laws": [3],
}


def cases(program: str, tags: str) -> list[str]:
    """The names of the test cases of a program."""
    listed = subprocess.run([program, "--list-test-names-only", *([tags] if tags else [])], capture_output=True, text=True,
                            check=False).stdout
    return [name for name in listed.splitlines() if name]


def folders(program: str) -> tuple[str, ...]:
    """What a program tests: a change there concerns it. Those that no folder of apps/ has the name of test the core."""
    name = program.removeprefix("test_")
    if name == "command":
        return "apps/nef/", "apps/program/", "tests/command/"
    return f"apps/{name}/" if os.path.isdir(f"apps/{name}") else "nef/", f"tests/{name}/"


def run(program: str, case: str) -> subprocess.CompletedProcess:
    pattern = "".join("\\" + c if c in '\\,["' else c for c in case)
    environment = dict(os.environ)
    if os.path.basename(program) == "test_nef_mpi":
        environment["ASAN_OPTIONS"] = "detect_leaks=0"  # Open MPI keeps what it allocates at its start
    command = ["timeout", str(LIMIT), program, "-w", "NoTests", pattern]
    return subprocess.run(command, capture_output=True, text=True, errors="replace", env=environment, check=False)


def quarters_of(program: str, tags: str) -> list[int]:
    """In which quarter each of its items is. Cases with tags are one item."""
    known = QUARTERS.get(program, [0])
    return known[-1:] if tags else known


def items(program: str, tags: str) -> list[str]:
    """Their names."""
    count = len(quarters_of(program, tags))
    if tags:
        return [f"{program} {tags}"]
    return [program] if count == 1 else [f"{program} {part + 1}/{count}" for part in range(count)]


def has_tags(program: str, tags: str) -> bool:
    """Whether a source of the program has a case with one of the tags."""
    words = tags.split(",")
    sources = pathlib.Path("tests", program.removeprefix("test_")).rglob("*.cpp")
    return not tags or any(word in source.read_text(encoding="utf-8") for source in sources for word in words)


def names(build: str, tags: str) -> list[str]:
    """The test programs that can be built, but for the comparison with CGAL, which takes long to compile and is not ours."""
    targets = subprocess.run(["cmake", "--build", build, "--target", "help"], capture_output=True, text=True, check=True).stdout
    found = set(re.findall(r"^(test_[a-z_]+)", targets, re.MULTILINE)) - {"test_main", "test_oracle"}
    return sorted(program for program in found if has_tags(program, tags))


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("--seconds", type=float, required=True)
    parser.add_argument("--tags", default="")
    arguments = parser.parse_args()
    tags = arguments.tags
    programs = names(arguments.build, tags)
    files = ci_selection.changed()
    program_of = {item: program for program in programs for item in items(program, tags)}
    concerned = {item for item, program in program_of.items()
                 if "nef/" in folders(program) or any(file.startswith(folders(program)) for file in files)}
    quarters = {item: quarter for program in programs
                for item, quarter in zip(items(program, tags), quarters_of(program, tags))}
    failed = []
    printing = threading.Lock()
    end = time.monotonic() + arguments.seconds

    def look_at_case(program: str, case: str, is_due: bool) -> bool:
        begin = time.monotonic()
        if begin > end and not is_due:
            return False
        result = run(f"{arguments.build}/bin/{program}", case)
        with printing:
            if os.environ.get("NEF_TEST_TIMES"):
                print(f"{time.monotonic() - begin:6.1f} s {program}: {case}", flush=True)
            if result.returncode != 0:
                failed.append(case)
                print(f"FAILED with {result.returncode}: {program}: {case}\n{result.stdout[-4000:]}{result.stderr[-4000:]}",
                      flush=True)
        return True

    def look(item: str, is_due: bool) -> bool:
        program = program_of[item]
        begin = time.monotonic()
        if not ci_selection.built(arguments.build, program):
            failed.append(f"{program} was not built")
            return False
        middle = time.monotonic()
        of_program = items(program, tags)
        chosen = [case for case in cases(f"{arguments.build}/bin/{program}", tags)
                  if zlib.crc32(case.encode()) % len(of_program) == of_program.index(item)]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            looked = list(pool.map(lambda case: look_at_case(program, case, is_due), chosen))
        print(f"-- {item}: {middle - begin:.0f} s to build, {time.monotonic() - middle:.0f} s for {sum(looked)} of "
              f"{len(looked)} cases", flush=True)
        return bool(looked) and all(looked)

    complete = ci_selection.look_at({item: [item] for item in program_of}, concerned, arguments.seconds, look, at_once=1,
                                    quarters=quarters)
    print(f"{len(failed)} cases failed")
    return 0 if complete and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
