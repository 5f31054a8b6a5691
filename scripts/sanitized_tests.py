#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the cases of the test programs of a build with sanitizers, each in a process of its own, and prints what fails.

No case is begun after so many seconds. Those come first that runs have left out, then those of the core and of what
changed, then the others (see ci_selection.py). Exits 1 if a case fails, or was left out though it was due.

Usage: sanitized_tests.py BUILD --seconds N [--jobs N] [PROGRAM...]     for instance build/sanitize, test_core
"""
import argparse
import glob
import os
import subprocess
import sys
import threading
import time

import ci_selection

LIMIT = 900  # seconds; a case that takes longer has failed


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


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("--seconds", type=float, required=True)
    parser.add_argument("programs", nargs="*")
    arguments = parser.parse_intermixed_args()
    programs = arguments.programs or sorted(map(os.path.basename, glob.glob(f"{arguments.build}/bin/test_*")))
    every = {f"{program}: {case}": (program, case)
             for program in programs for case in cases(f"{arguments.build}/bin/{program}")}
    if not every:
        print("there are no test cases", file=sys.stderr)
        return 1
    files = ci_selection.changed()
    concerned = {program for program in programs
                 if "nef/" in folders(program) or any(file.startswith(folders(program)) for file in files)}
    failed = []
    printing = threading.Lock()

    def look(item: str) -> bool:
        program, case = every[item]
        begin = time.monotonic()
        result = run(f"{arguments.build}/bin/{program}", case)
        with printing:
            if os.environ.get("NEF_TEST_TIMES"):
                print(f"{time.monotonic() - begin:6.1f} s {item}", flush=True)
            if result.returncode != 0:
                failed.append(item)
                print(f"FAILED with {result.returncode}: {item}\n{result.stdout[-4000:]}{result.stderr[-4000:]}", flush=True)
        return True

    first = {item for item, (program, _) in every.items() if program in concerned}
    complete = ci_selection.look_at({item: [item] for item in every}, first, arguments.seconds, look)
    print(f"{len(failed)} cases failed")
    return 0 if complete and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
