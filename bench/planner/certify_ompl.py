#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Do paths that OMPL's planners report as exact collide?

Runs OMPL's planners on OMPL.app's problems in SE(3) (its folder resources/3D, given by --scenes; without it the suite's
own problems) and certifies every path that they find. Prints a table in Markdown: for each scene, planner and check of
motions how many runs were solved, how many of the paths collide, before simplification and after it, how many could not
be decided, CPU seconds of the planner (median over the solved runs), of the simplifier and of the certificate, and
microseconds of planning for each motion that was checked. With --poses a colliding pose for each row that has one; with
--against the times of the other checks, divided by those of that one.

    cmake --build --preset release --target bench_planner_certify_ompl
    bench/planner/certify_ompl.py --scenes omplapp/resources/3D --only Easy,cubicles --runs 10

Checks are those of bench_planner_certify_ompl; those of FCL need libfcl-dev.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CHECKS = "exact:0.01,fcl:0.01,fcl:0.001,continuous,certified"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=pathlib.Path, default=ROOT / "data/planner/omplapp", help="a folder of .cfg files")
    parser.add_argument("--only", default="", help="names of scenes, with commas between")
    parser.add_argument("--planners", default="RRTConnect", help="OMPL's planners, with commas between")
    parser.add_argument("--checks", default=CHECKS)
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--time", type=float, default=20, help="seconds for a run of a planner")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--poses", action="store_true", help="print a colliding pose for each row that has one")
    parser.add_argument("--against", default="", metavar="CHECK", help="divide the times of the others by those of this check")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin", help="where the program is")
    options = parser.parse_args()
    if options.against and options.against not in options.checks.split(","):
        parser.error(f"--against {options.against} is not one of the --checks")
    return options


def runs_of(options, scene, planner):
    """One object for each run. Each is a process with its own seed, the same ones for all checks, and checks take turns, so
    that a load of the machine is shared by all. A scene that the program refuses has no runs."""
    limit = 660 + options.time * 3
    result = []
    for run in range(options.runs):
        for check in options.checks.split(","):
            command = [options.bin / "bench_planner_certify_ompl", scene, planner, 1, options.time, options.seed + run, check]
            try:
                done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=limit)
            except subprocess.TimeoutExpired:
                print(f"{scene.stem}, {check}: not done in {limit:.0f} s", file=sys.stderr)
                continue
            if done.returncode != 0:
                lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
                print(f"{scene.stem}: {lines[-1]}", file=sys.stderr)
                return result
            result += [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    return result


def row_of(runs):
    """The cells of a row, and the first path that collides."""
    solved = [run for run in runs if run["solved"]]
    collides = {kind: [run for run in solved if run[kind]["status"] == "collides"] for kind in ("raw", "simplified")}
    undecided = sum(run[kind]["status"] == "undecided" for run in solved for kind in ("raw", "simplified"))
    free = sum(run["simplified"]["status"] == "free" for run in solved)
    motions = sum(run["motions"] for run in runs)

    def seconds(values):
        values = list(values)
        return f"{statistics.median(values):.3g}" if values else "-"

    cells = [
        f"{len(solved)} of {len(runs)}",
        str(free),
        f"{len(collides['simplified'])} ({len(collides['raw'])})",
        str(undecided),
        seconds(run["seconds"] for run in solved),
        seconds(run["simplify_seconds"] for run in solved),
        seconds(run["simplified"]["seconds"] for run in solved),
        f"{1e6 * sum(run['seconds'] for run in runs) / motions:.0f}" if motions else "-",
    ]
    witness = next((run[kind] for kind in ("simplified", "raw") for run in collides[kind]), None)
    return cells, witness


def totals_of(runs):
    """CPU seconds of all runs: of planning, of simplifying, of both, of both for each path, of planning for each motion."""
    planning = sum(run["seconds"] for run in runs)
    simplifying = sum(run.get("simplify_seconds", 0) for run in runs)
    solved, motions = sum(run["solved"] for run in runs), sum(run["motions"] for run in runs)
    both = planning + simplifying
    return planning, simplifying, both, both / solved if solved else 0, planning / motions if motions else 0


def ratios_of(runs, base):
    """The totals divided by those of other runs."""
    return [f"{ours / theirs:.2f}" if ours and theirs else "-" for ours, theirs in zip(totals_of(runs), totals_of(base))]


def main():
    options = parse_arguments()
    wanted = set(filter(None, options.only.split(",")))
    print("| scene | planner | check | solved | free | collide (raw) | undecided | plan, s | simplify, s | certify, s | us a motion |")
    print("|" + " --- |" * 11)
    poses, ratios = [], []
    for scene in sorted(options.scenes.glob("*.cfg")):
        if wanted and scene.stem not in wanted:
            continue
        for planner in options.planners.split(","):
            runs = runs_of(options, scene, planner)
            base = [run for run in runs if run["check"] == options.against]
            for check in options.checks.split(","):
                rows = [run for run in runs if run["check"] == check]
                if base and rows and check != options.against:
                    ratios.append(f"| {scene.stem} | {planner} | {check} | {' | '.join(ratios_of(rows, base))} |")
                if not rows:
                    continue
                cells, witness = row_of(rows)
                print(f"| {scene.stem} | {planner} | {check} | {' | '.join(cells)} |", flush=True)
                if witness:
                    numbers = " ".join(repr(x) for x in witness["position"] + witness["quaternion"])
                    poses.append(f"{scene.stem}, {planner}, {check}: x y z qw qx qy qz = {numbers}")
    if ratios:
        print(f"\nTimes divided by those of {options.against}, each added up over all runs:\n")
        print("| scene | planner | check | plan | simplify | both | both, a path | plan, a motion |")
        print("|" + " --- |" * 8)
        print("\n".join(ratios))
    if options.poses and poses:
        print("\nColliding poses, one for each row that has some:\n")
        print("\n".join(poses))
    return 0


if __name__ == "__main__":
    sys.exit(main())
