#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench/planner/certify_ompl.py makes the table of what the program prints. certify_ompl_test.py SCRIPT FOLDER

The program is one of the test's own, so that no planner and no build of the benchmarks is needed.
"""
import collections
import json
import pathlib
import subprocess
import sys


def run_of(check, status, raw, simplified, seconds):
    paths = {}
    if status == "Exact solution":
        for kind, what in (("raw", raw), ("simplified", simplified)):
            paths[kind] = {"status": what, "seconds": 0.001, "motions": 3}
            if what == "collides":
                paths[kind].update(motion=1, parameter=0.5, position=[1.5, 2.0, -0.25], quaternion=[1.0, 0.0, 0.0, 0.0])
        paths["simplify_seconds"] = 0.5
    return {"check": check, "planner": "RRT", "scene": "a", "seconds": seconds, "motions": 100, "status": status,
            "solved": status == "Exact solution", **paths}


def main():
    script, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("a.cfg", "b.cfg", "refused.cfg"):
        (folder / name).write_text("[problem]\n")
    runs = [
        run_of("fcl:0.01", "Exact solution", "free", "collides", 1.0),
        run_of("fcl:0.01", "Exact solution", "free", "free", 2.0),
        run_of("fcl:0.01", "Exact solution", "undecided", "free", 4.0),
        run_of("fcl:0.01", "Timeout", "", "", 5.0),
        run_of("certified", "Exact solution", "free", "free", 0.25),
    ]
    seen = collections.Counter()
    for run in runs:  # run number n of a check has seed n
        seen[run["check"]] += 1
        (folder / f"{run['check']}-{seen[run['check']]}.json").write_text(json.dumps(run) + "\n")
    program = folder / "bench_planner_certify_ompl"
    program.write_text("#!/bin/sh\ncase $1 in *refused*) echo 'no such mesh' >&2; exit 2;; esac\n"
                       '[ "$2 $3 $4" = "RRT 1 9.0" ] && cd "$(dirname "$0")" && cat "$6-$5.json" || true\n')
    program.chmod(0o755)
    result = subprocess.run([sys.executable, script, "--bin", folder, "--scenes", folder, "--only", "a,refused", "--planners", "RRT",
                             "--runs", "4", "--time", "9", "--checks", "fcl:0.01,continuous,certified", "--against", "fcl:0.01", "--poses"], capture_output=True, text=True, timeout=60)
    wanted = [
        "| a | RRT | fcl:0.01 | 3 of 4 | 2 | 1 (0) | 1 | 2 | 0.5 | 0.001 | 30000 |",
        "| a | RRT | certified | 1 of 1 | 1 | 0 (0) | 0 | 0.25 | 0.5 | 0.001 | 2500 |",
        "| a | RRT | certified | 0.02 | 0.33 | 0.06 | 0.17 | 0.08 |",  # .25, .5, .75, .75, .0025 by 12, 1.5, 13.5, 4.5, .03
        "a, RRT, fcl:0.01: x y z qw qx qy qz = 1.5 2.0 -0.25 1.0 0.0 0.0 0.0",
    ]
    rows = [line for line in result.stdout.splitlines() if line.startswith(("| a ", "| b ", "a, "))]
    if result.returncode != 0 or rows != wanted or "refused: no such mesh" not in result.stderr:
        print(result.stdout, result.stderr, sep="\n")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
