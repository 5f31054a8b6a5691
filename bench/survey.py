#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What becomes of the meshes of a folder: taken as they are, resolved, repaired, closed by lids, or refused, and why.

  bench/survey.py FOLDER [--nef build/release/bin/nef] [--close PERCENT] [--seconds 60] [--gigabytes 4] [--json FILE]

Each mesh below the folder is read by `nef info --crossings refuse` (taken), then by `nef info --crossings union` (resolved: winding
numbers decide, nothing is guessed), then by `nef repair --crossings union --close=PERCENT` (repaired; lids: holes were closed, which
is a guess). What none of them takes is refused. Seconds are CPU time of the run that decided. A run above the limits of time or
memory, or that ends by a signal, is a failure, and the exit code is 1 then.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

ENDINGS = {".off", ".obj", ".stl", ".ply", ".glb", ".3mf"}
VERDICTS = ["taken", "resolved", "repaired", "lids", "refused", "failed"]


class Run:
    """One run of a program within limits: its exit code, its report, and what it cost."""

    def __init__(self, arguments, seconds, gigabytes):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 2**30),) * 2)
            resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 1))

        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            done = subprocess.run(arguments, capture_output=True, text=True, errors="replace", timeout=4 * seconds,
                                  preexec_fn=limit, check=False)
            self.code, self.out, self.err = done.returncode, done.stdout, done.stderr
        except subprocess.TimeoutExpired:
            self.code, self.out, self.err = -9, "", ""
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def crashed(self):
        return self.code not in (0, 1, 2)

    def report(self):
        try:
            return json.loads(self.out)
        except json.JSONDecodeError:
            return {}

    def complaint(self):
        lines = [line for line in self.err.splitlines() if "note: " not in line]
        return lines[-1].split(": ", 2)[-1] if lines else f"exit code {self.code}"


def survey(mesh, options, folder):
    """A row: the verdict, why, and the CPU seconds of the run that gave it."""
    def run(*arguments):
        return Run([options.nef, *arguments, "--threads", "1"], options.seconds, options.gigabytes)

    def row(verdict, why, seconds):
        return {"file": str(mesh), "verdict": verdict, "why": why, "seconds": round(seconds, 3)}

    why = ""
    for verdict, rule in (("taken", "refuse"), ("resolved", "union")):
        read = run("info", str(mesh), "--json", "--crossings", rule)
        if read.crashed():
            return row("failed", f"nef info ended with {read.code}", read.seconds)
        if read.code == 0:
            return row(verdict, why, read.seconds)
        why = why or read.complaint()
    target = os.path.join(folder, "repaired.nef")
    repair = run("repair", str(mesh), "--json", "--crossings", "union", f"--close={options.close}", "-o", target)
    if repair.crashed():
        return row("failed", f"nef repair ended with {repair.code}", repair.seconds)
    report = repair.report()
    if repair.code == 0:
        verdict = "lids" if report.get("holes", {}).get("closed") else "repaired"
        return row(verdict, "; ".join(report.get("done", [])) or why, repair.seconds)
    why = report.get("problem") or repair.complaint()
    holes = report.get("holes", {})
    if holes.get("count"):
        why += f"; lids for {holes['count']} hole(s) would be {100 * (holes['lid_share'] or 0):.2g} % of the area"
    return row("refused", why, repair.seconds)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--nef", default="build/release/bin/nef", help="the program")
    parser.add_argument("--close", type=float, default=10, help="largest share of lids in the area, in percent")
    parser.add_argument("--seconds", type=float, default=60, help="CPU time of a run")
    parser.add_argument("--gigabytes", type=float, default=4, help="memory of a run")
    parser.add_argument("--json", type=pathlib.Path, help="write the rows there, too")
    options = parser.parse_args()
    meshes = sorted(path for path in options.folder.rglob("*") if path.suffix.lower() in ENDINGS and path.is_file())
    if not meshes:
        sys.exit(f"{options.folder}: holds no meshes ({', '.join(sorted(ENDINGS))})")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for mesh in meshes:
            rows.append(survey(mesh, options, folder))
            row = rows[-1]
            print(f"{row['verdict']:9}{row['seconds']:9.2f} s  {mesh.relative_to(options.folder)}  {row['why'][:150]}", flush=True)
    print()
    for verdict in VERDICTS:
        count = sum(row["verdict"] == verdict for row in rows)
        print(f"{verdict:9}{count:6}  {100 * count / len(rows):5.1f} %")
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")
    return 1 if any(row["verdict"] == "failed" for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
