#!/usr/bin/env python3
"""Runs clang-tidy over every source of ours in a build tree, one process a core.

Usage: lint.py BUILD_DIRECTORY. Exits 1 and prints the findings if there are any.
"""
import concurrent.futures
import json
import os
import subprocess
import sys


def main() -> int:
    build = sys.argv[1]
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    root = os.getcwd()
    sources = sorted(
        {
            entry["file"]
            for entry in commands
            if entry["file"].startswith((root + "/nef/", root + "/apps/"))
        }
    )

    def check(source: str) -> str:
        result = subprocess.run(
            ["clang-tidy", "--quiet", "--extra-arg=-Wno-unknown-warning-option", "-p", build, source],
            capture_output=True,
            text=True,
            check=False,
        )
        return result.stdout if "warning:" in result.stdout or "error:" in result.stdout else ""

    findings = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for output in pool.map(check, sources):
            if output:
                findings += 1
                print(output)
    print(f"clang-tidy: {len(sources)} sources, {findings} with findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
