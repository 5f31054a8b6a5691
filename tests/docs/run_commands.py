#!/usr/bin/env python3
"""Runs every command line of the documentation, and compares what is printed there.

Usage: run_commands.py SOURCE_DIRECTORY PROGRAM_DIRECTORY WORK_DIRECTORY [DOCUMENT...]

A fenced block with title="NAME" is written to that file of the folder in which the commands run.

A command line is an indented line, or a line of a fenced block of shell, that begins with one of the suite's programs.
After "$ " the lines below it, up to the next command or the end of the block, are what it must print, in stdout or
stderr; "..." there stands for any lines. All others must end with exit code 0, or 1 where that is an answer (no way, not
equal). The commands of a document run in its order in a folder of its own, in which data/ and python/ are the suite's. Lines with
placeholders (FILE, [--option], ...) are synopses and left out.
"""
import os
import re
import shutil
import subprocess
import sys

PROGRAMS = ("printf", "cat", "mkdir", "cp", "nef", "minkowski", "visual_hull", "planner", "render_silhouettes",
            "build/release/bin/sum_peer")
# Commands of tutorials that need more than the programs: run only if the document is named on the command line.
BUILDERS = ("cmake", "./build/bracket", "./build/part", "./build/plan")
CHECKER = "python3 python/proofs/check.py "  # of proofs; needs nothing else
TITLE = re.compile(r'title="([\w.]+)"')
DOCUMENTS = ("README.md", "docs", "apps/planner/README.md")
PLACEHOLDER = re.compile(r"(?:^|[\s|=])(?:[A-Z][A-Z_]*\d?(?:\.[a-z]+)?|\.\.\.)(?=$|[\s|\]])|[\[\]]")
SECONDS = 300
NO_URDF = "this build does not read URDF files"  # urdfdom is optional


class Command:
    def __init__(self, where: str, block: int, text: str, compared: bool) -> None:
        self.where = where
        self.block = block  # lines of one block count on each other
        self.text = text
        self.compared = compared
        self.printed: list[str] = []


def without_quotes(text: str) -> str:
    return re.sub(r"'[^']*'|\"[^\"]*\"|\s#.*", "", text)


def files(path: str) -> dict[str, str]:
    """The fenced blocks that have a title, by it."""
    result: dict[str, str] = {}
    name = None
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("```"):
                title = TITLE.search(line)
                name = title.group(1) if title else None
                if name is not None:
                    result[name] = ""
            elif name is not None:
                result[name] += line
    return result


def commands(path: str, programs: tuple[str, ...] = PROGRAMS) -> list[Command]:
    result: list[Command] = []
    fence = None
    printing = False
    block = 0
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    for number, line in enumerate(lines, 1):
        if line.startswith("```"):
            fence = None if fence is not None else line[3:].strip()
            printing = False
            block += 1
            continue
        if fence is None and not line.startswith("    "):
            printing = False
            block += 1
            continue
        if fence not in (None, "sh", "bash", "console"):
            continue
        text = line[4:] if fence is None else line
        compared = text.startswith("$ ")
        command = text[2:] if compared else text
        if (command.split(" ")[0] in programs or command.startswith(CHECKER)) and (compared or not printing):
            printing = compared
            result.append(Command(f"{os.path.basename(path)}:{number}", block, command, compared))
        elif compared:
            printing = False  # a program of somebody else
        elif printing:
            result[-1].printed.append(text)
    return result


def same_line(expected: str, printed: str) -> bool:
    """Whether the lines agree; "..." in a line stands for any characters."""
    pattern = ".*".join(re.escape(part) for part in expected.rstrip().split("..."))
    return re.fullmatch(pattern, printed.rstrip()) is not None


def matches(expected: list[str], printed: list[str]) -> bool:
    """Whether the lines agree; a line "..." stands for any number of lines."""
    if not expected:
        return not printed
    if expected[0].strip() == "...":
        return any(matches(expected[1:], printed[skip:]) for skip in range(len(printed) + 1))
    return bool(printed) and same_line(expected[0], printed[0]) and matches(expected[1:], printed[1:])


def check(command: Command, folder: str, programs: str) -> str:
    """What is wrong; empty if nothing is."""
    environment = dict(os.environ, PATH=programs + os.pathsep + os.environ["PATH"])
    text = command.text.replace("build/release/bin/", "")
    try:
        run = subprocess.run(["bash", "-c", text], cwd=folder, env=environment, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return f"takes more than {SECONDS} s"
    printed = run.stdout.decode("utf-8", "replace")
    if NO_URDF in printed:
        print(f"{command.where}: left out, the planner was built without urdfdom: {command.text}")
        return ""
    if run.returncode not in ((0,) if text.split(" ")[0] in BUILDERS else (0, 1)):
        return f"exit code {run.returncode}\n{printed}"
    if command.compared and not matches(command.printed, printed.splitlines()):
        return "prints something else:\n" + printed
    return ""


def documents(source: str) -> list[str]:
    result = []
    for name in DOCUMENTS:
        path = os.path.join(source, name)
        if os.path.isdir(path):
            result += sorted(os.path.join(folder, file) for folder, _, names in os.walk(path) for file in names
                             if file.endswith(".md"))
        elif os.path.exists(path):
            result.append(path)
    return result


def main() -> int:
    if len(sys.argv) < 4 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        return 0 if sys.argv[1:2] in (["-h"], ["--help"]) else 2
    source, programs, work = (os.path.abspath(path) for path in sys.argv[1:4])
    failures = 0
    ran = compared = 0
    for document in sys.argv[4:] or documents(source):
        folder = os.path.join(work, os.path.relpath(document, source).replace("/", "_"))
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        for name in ("data", "python"):
            os.symlink(os.path.join(source, name), os.path.join(folder, name))
        for name, text in files(document).items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        skipped = -1
        for command in commands(document, PROGRAMS + (BUILDERS if sys.argv[4:] else ())):
            command.text = command.text.replace("=PREFIX", "=" + os.environ.get("NEF_PREFIX", "PREFIX"))
            if PLACEHOLDER.search(without_quotes(command.text)):
                print(f"{command.where}: a synopsis: {command.text}")
                continue
            program = os.path.basename(command.text.split(" ")[0])
            if program == "sum_peer" and not os.path.exists(os.path.join(programs, program)):
                skipped = command.block
            if command.block == skipped:
                print(f"{command.where}: left out, CGAL's sum_peer is not built: {command.text}")
                continue
            ran += 1
            compared += command.compared
            wrong = check(command, folder, programs)
            if wrong:
                failures += 1
                print(f"{command.where}: FAILED: {command.text}\n{wrong}")
    print(f"{ran} command lines run, {compared} of them compared with what the documents print: {failures} failures")
    return 1 if failures or ran == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
