#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds test programs with sanitizers and runs their cases, each in a process of its own; prints what fails.

Items are programs, and parts of those that take long. They come one after the other, those first that runs have left out,
then those of the core and of what changed, then the others (see ci_selection.py). No case is begun, and no program built,
after so many seconds. Exits 1 if a case fails, or if an item was left out that was due.

Usage: sanitized_tests.py BUILD --seconds N     for instance build/sanitize, which is configured
"""
import argparse
import concurrent.futures
import os
import re
import subprocess
import sys
import threading
import time
import zlib

import ci_selection

LIMIT = 900  # seconds; a case that takes longer has failed
PARTS = ci_selection.QUARTERS
LONG = {"test_planner", "test_visual_hull"}  # in parts, one in each quarter
# The other programs, so that quarters take about equally long.
QUARTERS = [{"test_nef_mpi", "test_command", "test_query", "test_laws"}, {"test_minkowski"}, {"test_core"},
            {"test_tiles", "test_io", "test_view", "test_remeshing"}]


def cases(program: str) -> list[str]:
    """The names of the test cases of a program."""
    listed = subprocess.run([program, "--list-test-names-only"], capture_output=True, text=True, check=False).stdout
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


def items(program: str) -> list[str]:
    return [f"{program} {part + 1}/{PARTS}" for part in range(PARTS)] if program in LONG else [program]


def program_of(item: str) -> str:
    return item.split()[0]


def quarter(item: str) -> int:
    """In which quarter of the items one is."""
    program = program_of(item)
    if program in LONG:
        return items(program).index(item)
    return next((i for i, group in enumerate(QUARTERS) if program in group), 0)


def cases_of(item: str, build: str) -> list[str]:
    program = program_of(item)
    listed = cases(f"{build}/bin/{program}")
    if program not in LONG:
        return listed
    return [case for case in listed if zlib.crc32(case.encode()) % PARTS == quarter(item)]


def names(build: str) -> list[str]:
    """The test programs that can be built, but for the comparison with CGAL, which takes long to compile and is not ours."""
    targets = subprocess.run(["cmake", "--build", build, "--target", "help"], capture_output=True, text=True, check=True).stdout
    return sorted(set(re.findall(r"^(test_[a-z_]+)", targets, re.MULTILINE)) - {"test_main", "test_oracle"})


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("--seconds", type=float, required=True)
    arguments = parser.parse_args()
    end = time.monotonic() + arguments.seconds
    programs = names(arguments.build)
    files = ci_selection.changed()
    concerned = {program for program in programs
                 if "nef/" in folders(program) or any(file.startswith(folders(program)) for file in files)}
    every = [item for program in programs for item in items(program)]
    choice = ci_selection.Choice({item: [item] for item in every}, {item for item in every if program_of(item) in concerned},
                                 quarter)
    failed = []
    printing = threading.Lock()

    def look(program: str, case: str) -> bool:
        begin = time.monotonic()
        if begin > end:
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

    done = set()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for item in choice.order:
            program = program_of(item)
            begin = time.monotonic()
            if begin > end:
                break
            built = subprocess.run(["cmake", "--build", arguments.build, "--target", program], capture_output=True, text=True,
                                   errors="replace", check=False)
            if built.returncode != 0:
                print(built.stdout[-4000:])
                return 1
            middle = time.monotonic()
            chosen = cases_of(item, arguments.build)
            looked = list(pool.map(look, [program] * len(chosen), chosen))
            print(f"-- {item}: {middle - begin:.0f} s to build, {time.monotonic() - middle:.0f} s for {sum(looked)} of "
                  f"{len(looked)} cases", flush=True)
            if looked and all(looked):
                done.add(item)
    complete = choice.end(done)
    print(f"{len(failed)} cases failed")
    return 0 if complete and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
