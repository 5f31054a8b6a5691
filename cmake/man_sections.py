# SPDX-License-Identifier: Apache-2.0
"""Writes what help2man includes beside a program's --help: the help of each of its subcommands, and what to read besides.

Usage: man_sections.py PROGRAM NAME FILE
"""
import re
import subprocess
import sys

PROGRAMS = ("minkowski", "nef", "planner", "visual_hull")


def help_of(*command: str) -> str:
    return subprocess.run([*command, "--help"], stdout=subprocess.PIPE, check=True, text=True).stdout


def subcommands(text: str) -> list[str]:
    """The first words of the lines below "Subcommands:"."""
    names = []
    inside = False
    for line in text.splitlines():
        if line.startswith("Subcommands:"):
            inside = True
        elif inside and (found := re.match(r"  ([a-z][a-z0-9-]*)\b", line)):
            names.append(found.group(1))
        elif inside and line and not line.startswith(" "):
            break
    return names


def escaped(line: str) -> str:
    line = line.replace("\\", "\\\\").replace("-", "\\-")
    return "\\&" + line if line.startswith((".", "'")) else line


def main() -> None:
    program, name, path = sys.argv[1:4]
    lines = []
    for subcommand in subcommands(help_of(program)):
        lines += [f'.SS "{name} {subcommand}"', ".nf"]
        lines += [escaped(line.rstrip()) for line in help_of(program, subcommand).strip().splitlines()]
        lines.append(".fi")
    with open(path, "w", encoding="utf-8") as file:
        if lines:
            file.write("\n".join(["[SUBCOMMANDS]", *lines, "", ""]))
        others = [f".BR {other} (1)" for other in PROGRAMS if other != name]
        file.write("[SEE ALSO]\n" + ",\n".join(others) + ";\nthe documents in /usr/share/doc/nef\\-programs\n")


if __name__ == "__main__":
    main()
