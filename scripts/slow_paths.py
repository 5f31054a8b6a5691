#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Builds the programs with all fast paths off and compares what they compute with those of another build, one program after
the other (compare_paths.py): `nef` always, and of the others those first that runs have left out (see ci_selection.py). After
so many seconds only those are begun that are due. Exits 1 if there is a difference, or if one was left out that was due.

Usage: slow_paths.py FAST BUILD --seed N --seconds N     FAST: a folder of programs; BUILD: configured, as build/slow
"""
import argparse
import os
import subprocess
import sys

import ci_selection

QUARTERS = {"minkowski": 0, "visual_hull": 1, "planner": 2}


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("fast")
    parser.add_argument("build")
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--seconds", type=float, required=True)
    arguments = parser.parse_args()
    failed = []

    def look(item: str, _: bool = True) -> bool:
        program = item.split()[0]
        if not ci_selection.built(arguments.build, "nef_command" if program == "nef" else program):
            failed.append(program)
            return False
        scripts = os.path.dirname(os.path.abspath(__file__))
        print(f"-- {program}", flush=True)
        compared = subprocess.run([sys.executable, os.path.join(scripts, "compare_paths.py"), arguments.fast,
                                   os.path.join(arguments.build, "bin"), "--seed", str(arguments.seed), "--program", program],
                                  check=False)
        if compared.returncode != 0:
            failed.append(program)
        return True

    look("nef")
    # Named apart from what else is recorded of a program.
    items = {f"{program} on slow paths": quarter for program, quarter in QUARTERS.items()}
    complete = ci_selection.look_at({item: [item] for item in items}, set(), arguments.seconds, look, at_once=1, quarters=items)
    return 0 if complete and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
