#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the C++ reference (docs/reference/Doxyfile) is complete: it has a main page, every public function and class has a
description, and the functions that people look for first are in it. Skipped where Doxygen is not installed.

Usage: scripts/checks/check_reference.py WORK_DIRECTORY
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
EXPECTED = {"unite", "subtract", "make_box", "from_mesh", "read_polyhedron", "write_polyhedron", "to_mesh", "volume", "locate",
            "minkowski_sum", "compute"}


def main() -> int:
    work = pathlib.Path(sys.argv[1]).resolve()
    if shutil.which("doxygen") is None:
        print("skipped: doxygen is not installed (apt-get install doxygen)")
        return 0
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    environment = dict(os.environ, NEF_REFERENCE=str(work))
    subprocess.run(["doxygen", "docs/reference/Doxyfile"], cwd=ROOT, env=environment, check=True)
    lines = (work / "undocumented.txt").read_text(encoding="utf-8").splitlines()
    problems = [line for line in lines if "(function)" in line or "Compound" in line or "is not documented" not in line]
    names = set(re.findall(r'kind="function"><name>([^<]*)', (work / "xml" / "index.xml").read_text(encoding="utf-8")))
    problems += [f"the reference lacks {name}" for name in sorted(EXPECTED - names)]
    if "immutable, exact" not in (work / "index.html").read_text(encoding="utf-8"):
        problems.append("the main page is empty")
    print("\n".join(problems), end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
