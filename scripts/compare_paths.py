#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether two builds of the programs, one with NEF_SLOW_PATHS, compute the same: exit codes, messages and the bytes of
all files that they write, each on 1, 2 and 4 threads, over the data of the repository and over generated input. Prints
every difference, and every crash or refusal of legal input; exits 1 if there is one. What is generated depends on the
seed alone.

Usage: scripts/compare_paths.py FAST SLOW [--seed N] [--program NAME] [--only WORD] [--keep FOLDER] [--times]
       FAST and SLOW are folders of programs, as build/ci/bin and build/slow/bin; with a program's NAME, only cases that
       are about it (`nef` helps in those of others)
"""
import argparse
import collections
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import paths_corpus  # noqa: E402

DATA = pathlib.Path(__file__).resolve().parent.parent / "data"
THREADS = ("1", "2", "4")
LIMIT = 300  # seconds for one command; one that takes longer has failed
SECONDS = re.compile(rb"\b[0-9.]+(e-?[0-9]+)? s\b")  # programs print how long they took


def outcome(case: paths_corpus.Case, programs: pathlib.Path, threads: str, folder: pathlib.Path) -> dict[str, bytes]:
    """What the commands of a case print and write: by name, the bytes."""
    folder.mkdir(parents=True)
    result: dict[str, bytes] = {}
    for number, command in enumerate(case.commands):
        arguments = [str(programs / command[0]), *command[1:], "--threads", threads]
        try:
            run = subprocess.run(arguments, cwd=folder, capture_output=True, timeout=LIMIT, check=False)
            code, out, err = run.returncode, run.stdout, run.stderr
        except subprocess.TimeoutExpired:
            code, out, err = -1, b"", b"out of time"
        result[f"{number} exit code"] = str(code).encode()
        result[f"{number} stdout"] = SECONDS.sub(b"# s", out)
        result[f"{number} stderr"] = SECONDS.sub(b"# s", err)
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            result[f"file {path.relative_to(folder)}"] = path.read_bytes()
    return result


def compare(
    case: paths_corpus.Case, builds: dict[str, pathlib.Path], work: pathlib.Path
) -> tuple[list[str], str, dict[str, bytes]]:
    """The differences between all runs of a case, how long each build took, and what came of the first run."""
    differences = []
    first: dict[str, bytes] = {}
    took = dict.fromkeys(builds, 0.0)
    for build, programs in builds.items():
        for threads in THREADS:
            begin = time.monotonic()
            result = outcome(case, programs, threads, work / case.name / f"{build}{threads}")
            took[build] += time.monotonic() - begin
            first = first or result
            for key in sorted(first.keys() | result.keys()):
                if first.get(key) != result.get(key):
                    differences.append(f"{case.name}, {key}: {build} on {threads} threads differs from fast on 1")
            for key, value in result.items():
                if key.endswith("exit code") and (value.startswith(b"-") or (case.legal and value == b"2")):
                    error = result[key.replace("exit code", "stderr")].decode(errors="replace").strip()
                    differences.append(f"{case.name}, {key} of {build} on {threads} threads: {value.decode()}, {error}")
    return differences, " ".join(f"{build} {seconds:.1f} s" for build, seconds in took.items()), first


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("fast", type=pathlib.Path)
    parser.add_argument("slow", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program", help="only cases about this program")
    parser.add_argument("--only", default="", help="cases with this in their names")
    parser.add_argument("--keep", type=pathlib.Path, help="an empty folder for what is made, which then stays")
    parser.add_argument("--times", action="store_true", help="print how long each case took")
    options = parser.parse_args()
    builds = {"fast": options.fast.resolve(), "slow": options.slow.resolve()}
    work = options.keep.resolve() if options.keep else pathlib.Path(tempfile.mkdtemp(prefix="nef-paths-"))
    work.mkdir(parents=True, exist_ok=True)
    try:
        cases = paths_corpus.cases(DATA, work / "input", options.seed)
        cases = [case for case in cases if options.only in case.name and options.program in (None, case.program)]
        differences = []
        codes: collections.Counter[str] = collections.Counter()
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for case, (found, took, first) in zip(cases, pool.map(lambda case: compare(case, builds, work), cases)):
                differences += found
                of_case = [value.decode() for key, value in first.items() if key.endswith("exit code")]
                codes.update(of_case)
                if options.times:
                    print(f"{case.name}: {took}; exit codes {' '.join(of_case)}")
    finally:
        if not options.keep:
            shutil.rmtree(work)
    for difference in differences:
        print(difference)
    count = sum(len(case.commands) for case in cases)
    print(f"{len(cases)} cases, {count} commands (exit codes: {dict(sorted(codes.items()))}), seed {options.seed}: "
          f"{len(differences)} differences")
    return 1 if differences or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
