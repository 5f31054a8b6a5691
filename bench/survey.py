#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What becomes of the meshes of a folder: taken as they are, resolved, repaired, closed by lids, or refused, and why.

  bench/survey.py FOLDER [--nef build/release/bin/nef] [--close PERCENT] [--seconds 60] [--gigabytes 4] [--json FILE]

Each mesh below the folder is read by `nef info --crossings refuse` (taken), then by `nef info --crossings union` (resolved: winding
numbers decide, nothing is guessed), then by `nef repair --crossings union --close=100` (repaired; lids: holes were closed, which
is a guess). What none of them takes, or only with lids of more than PERCENT of the area, is refused. Seconds are CPU time of the run
that decided. A run above the limits of time or memory, or that ends by a signal, is a failure, and so are volumes for each winding
number that do not add up to the signed volume; the exit code is 1 then. Files that hold no faces (points, lines, nothing) are counted
by themselves. The summary has the causes of refusals, and how many meshes become solids with lids of at most 10, 30 and 100 %, of all
and of those that enclose something under some lid.
"""
import argparse
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

VERDICTS = ["taken", "resolved", "repaired", "lids", "refused", "failed"]
LIMITS = [10, 30, 100]
# Causes of refusals by what the program says; the first that fits.
CAUSES = [
    ("no faces", "it has no faces", ["but no faces", "the file is empty", "declares no element"]),
    ("flat", "it encloses nothing under any lid", ["enclose nothing", "lie in one plane"]),
    ("lids", "lids are above the limit", ["the surface is open there"]),
    ("damaged", "it is no legal file of its format", [""]),
]


class Run:
    """One run of a program within limits: its exit code, its report, and what it cost."""

    def __init__(self, arguments, seconds, gigabytes):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 2**30),) * 2)
            resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 1))

        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            done = subprocess.run(arguments, capture_output=True, text=True, errors="replace", timeout=20 * seconds,
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


def endings(options):
    """The endings of files of meshes, as the program names them for a file that it does not know."""
    with tempfile.NamedTemporaryFile(suffix=".unknown") as file:
        file.write(b"?")
        file.flush()
        complaint = Run([options.nef, "info", file.name], options.seconds, options.gigabytes).complaint()
    listed = re.search(r"use the extension (.*)", complaint)
    if not listed:
        sys.exit(f"{options.nef}: {complaint}")
    return {"." + word for word in re.split(r", | or ", listed[1])}


def identity(report):
    """What is wrong with the volumes for each winding number in a report of `nef repair`; an empty text if nothing is."""
    crossings = report.get("crossings")
    if not crossings:
        return ""
    total = sum(v["winding_number"] * v["volume"] for v in crossings["volumes"])
    error = sum(abs(v["winding_number"]) * v["volume_error"] for v in crossings["volumes"])
    error += crossings["signed_volume_error"] + 1e-15 * sum(abs(v["winding_number"] * v["volume"]) for v in crossings["volumes"])
    if abs(total - crossings["signed_volume"]) <= error:
        return ""
    return f"the sum of winding numbers times volumes is {total}, the signed volume {crossings['signed_volume']}, within {error}"


def cause_of(why):
    return next(cause for cause, _, texts in CAUSES if any(text in why for text in texts))


def survey(mesh, options, folder):
    """A row: the verdict, why, the CPU seconds of the run that gave it, and the share of lids in percent if there are any."""
    def run(*arguments):
        return Run([options.nef, *arguments, "--threads", "1"], options.seconds, options.gigabytes)

    def row(verdict, why, seconds, lids=None):
        cause = cause_of(why) if verdict == "refused" else None
        return {"file": str(mesh), "verdict": verdict, "why": why, "cause": cause, "lids": lids, "seconds": round(seconds, 3)}

    why = ""
    target = os.path.join(folder, "repaired.nef")
    for verdict, rule in (("taken", "refuse"), ("resolved", "union")):
        read = run("info", str(mesh), "--json", "--crossings", rule)
        if read.crashed():
            return row("failed", f"nef info ended with {read.code}", read.seconds)
        if read.code == 0:
            wrong = identity(run("repair", str(mesh), "--json", "-o", target).report()) if verdict == "resolved" else ""
            return row("failed", wrong, read.seconds) if wrong else row(verdict, why, read.seconds)
        why = why or read.complaint()
    repair = run("repair", str(mesh), "--json", "--crossings", "union", "--close=100", "-o", target)
    if repair.crashed():
        return row("failed", f"nef repair ended with {repair.code}", repair.seconds)
    report = repair.report()
    if repair.code != 0:
        return row("refused", report.get("problem") or repair.complaint(), repair.seconds)
    wrong = identity(report)
    if wrong:
        return row("failed", wrong, repair.seconds)
    done = "; ".join(report.get("done", []))
    if not report["holes"]["closed"]:
        return row("repaired", done or why, repair.seconds)
    lids = 100 * report["holes"]["lid_share"]
    if lids <= options.close:
        return row("lids", done or why, repair.seconds, lids)
    return row("refused", f"{why}; lids for {report['holes']['count']} hole(s) are {lids:.2g} % of the area", repair.seconds, lids)


def summarize(rows, close):
    """How many rows have each verdict, why meshes are refused, and how many become solids by the limit for lids."""
    meshes = [row for row in rows if row["cause"] != "no faces"]
    if not meshes:
        return print("no file has faces")

    def line(text, count):
        print(f"{text:64}{count:6}  {100 * count / len(meshes):5.1f} %")

    print(f"\n{len(rows)} files, {len(meshes)} meshes")
    for verdict in VERDICTS:
        line(verdict, sum(row["verdict"] == verdict for row in meshes))
    for cause, text, _ in CAUSES[1:]:
        line("refused, as " + text, sum(row["cause"] == cause for row in meshes))
    solid = [row for row in meshes if row["cause"] not in ("flat", "damaged")]
    for limit in sorted({*LIMITS, close}):
        count = sum(row["verdict"] in VERDICTS[:3] or row["lids"] is not None and row["lids"] <= limit for row in meshes)
        line(f"solids with --close={limit:g}", count)
        if solid:
            print(f"{'  of the ' + str(len(solid)) + ' that enclose something':64}{'':6}  {100 * count / len(solid):5.1f} %")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--nef", default="build/release/bin/nef", help="the program")
    parser.add_argument("--close", type=float, default=10, help="largest share of lids in the area, in percent")
    parser.add_argument("--seconds", type=float, default=60, help="CPU time of a run")
    parser.add_argument("--gigabytes", type=float, default=4, help="memory of a run")
    parser.add_argument("--json", type=pathlib.Path, help="write the rows there, too")
    options = parser.parse_args()
    known = endings(options)
    meshes = sorted(path for path in options.folder.rglob("*") if path.suffix.lower() in known and path.is_file())
    if not meshes:
        sys.exit(f"{options.folder}: holds no meshes ({', '.join(sorted(known))})")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for mesh in meshes:
            rows.append(survey(mesh, options, folder))
            row = rows[-1]
            print(f"{row['verdict']:9}{row['seconds']:9.2f} s  {mesh.relative_to(options.folder)}  {row['why'][:150]}", flush=True)
    summarize(rows, options.close)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")
    return 1 if any(row["verdict"] == "failed" for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
