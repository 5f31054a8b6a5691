#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Commands that are nearly right: those of compare_paths.py with a word changed, left out or added, an option more, a digit
less. Each has to end in time, with an exit code that the documentation knows and, where it is refused, with one line that
says why. Prints every one that does not; exits 1 if there is one. What is tried depends on the seed alone, the time says how
much of it.

Usage: scripts/odd_commands.py BIN [--seed N] [--seconds S] [--commands N] [--jobs N]
"""
import argparse
import collections
import concurrent.futures
import functools
import os
import pathlib
import random
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import paths_corpus  # noqa: E402

DATA = pathlib.Path(__file__).resolve().parent.parent / "data"
LIMIT = 120  # seconds for one command
# Options by which a command may be asked to take as long as one likes.
LONG = {"--benchmark", "--max-cells", "--precision", "--repeat", "--runs", "--samples", "--steps", "--time"}
MEMORY = 16 << 30  # bytes of address space
CODES = range(6)  # of exit: docs/nef.md, docs/planner.md
# What a program may not say of bad input: texts of the libraries below it.
FOREIGN_WORDS = re.compile(r"std::|terminate|bad_alloc|basic_string|vector::|stoi|stod|[Aa]ssert|json\.exception|nlohmann|filesystem error|Unable to cast|internal error")
VALUES = (
    "0 1 1 2 2 3 4 10 1/2 1/3 0.1 0.01 2.5 90 100 x y z -1 -0 1e-300 1e300 nan inf 1/0 0/1 4294967296 18446744073709551616 1,2,3 0,0,0 1,0,0 -1,-1,-1 "
    "0.5,0.5,0.5 5,5 a,b,c x é x,y [1] {} % 100% - -- . auto true /dev/null /nonexistent/x box(0,0,0,1,1,1)"
).split() + ["", "1 2 3", "9" * 40, "9" * 400]
ENDINGS = ".off .json .html .glb .png .tiles .nef3 .nef .stl .obj .ply .path .proof .3mf .svg .xyz".split() + [""]


@functools.cache
def options_of(program: str, subcommand: str) -> list[tuple[str, list[str] | None]]:
    """The options that --help names, but for those that start servers, and the values it names for them; none for flags."""
    command = [program, subcommand] if subcommand else [program]
    text = subprocess.run([*command, "--help"], capture_output=True, text=True, check=False).stdout
    found = re.findall(r"^ +(?:-\w,)?(--[a-z][a-z0-9-]+)(?: (\[?=?[A-Z]\S*))?", text, re.MULTILINE)
    named = [(name, re.findall(r"[a-z0-9][\w./+-]*", kind) if kind else None) for name, kind in found]
    return sorted((name, values) for name, values in named if name not in ("--help", "--version", "--serve"))


def changed_word(rng: random.Random, word: str) -> str:
    """The word with one character changed, or another word."""
    if not word or rng.random() < 0.4:
        return rng.choice(VALUES)
    at = rng.randrange(len(word))
    other = rng.choice(["", "0", "-", "9", "7", ",", " ", "/", ".", "1e9", word[at] * 2])
    return word[:at] + other + word[at + 1 :]


def nearly(rng: random.Random, command: list[str], options: list[tuple[str, list[str] | None]]) -> list[str]:
    """The command with a word or two changed, left out or added; its first words stay."""
    result = list(command)
    for _ in range(rng.choice([1, 1, 1, 2])):
        what = rng.random()
        if what < 0.3 and len(result) > 2:
            at = rng.randrange(2, len(result))
            result[at] = changed_word(rng, result[at])
        elif what < 0.35 and len(result) > 2:
            del result[rng.randrange(2, len(result))]
        elif options:
            name, values = rng.choice(options)
            result.append(name)
            if values is not None or rng.random() < 0.05:
                result.append(rng.choice([rng.choice(VALUES), rng.choice(values or VALUES), "out" + rng.choice(ENDINGS)]))
    return result


def complaint(code: int, error: str) -> str | None:
    """What is wrong with how a command ended; nothing if it is as it should be."""
    if code not in CODES:
        return f"exit code {code}"
    if code != 2:
        return None
    lines = [line for line in error.splitlines() if line.strip() and ": note" not in line and not line.startswith("note")]
    if not lines:
        return "refused without a word"
    if len(lines) > 2:  # a second one says where to read on
        return f"refused in {len(lines)} lines"
    if FOREIGN_WORDS.search(error):
        return "refused in words of a library"
    return None


def run(words: list[str], folder: pathlib.Path) -> tuple[int, str]:
    """The exit code and what a command says on stderr."""
    limited = ["bash", "-c", f'ulimit -v {MEMORY // 1024}; exec "$@"', "--", *words]
    done = subprocess.run(limited, cwd=folder, capture_output=True, timeout=LIMIT, stdin=subprocess.DEVNULL, check=False)
    return done.returncode, done.stderr.decode(errors="replace")


def attempt(number: int, seed: int, programs: pathlib.Path, cases: list[paths_corpus.Case], work: pathlib.Path):
    """The commands of a case up to one that is nearly right; its exit code, and what is wrong with how it ended, if anything is."""
    rng = random.Random(seed * 1_000_003 + number)
    program = rng.choice(sorted({case.program for case in cases}))
    case = rng.choice([case for case in cases if case.program == program])
    last = rng.randrange(len(case.commands))
    folder = work / str(number)
    folder.mkdir()
    words: list[str] = []
    try:
        for command in case.commands[:last]:
            run([str(programs / command[0]), *command[1:]], folder)
        command = case.commands[last]
        program = str(programs / command[0])
        subcommand = command[1] if command[0] == "nef" else ""
        words = nearly(rng, [program, *command[1:]], options_of(program, subcommand))
        code, error = run(words, folder)
        wrong = complaint(code, error)
        return code, wrong and f"{wrong}: {shlex.join(words)}\n    {error.strip()[:400]}"
    except subprocess.TimeoutExpired:
        if LONG & {word.split("=")[0] for word in words}:
            return -1, None
        return -1, f"not done in {LIMIT} s: {shlex.join(words) if words else case.name}"
    except ValueError:  # a word that no command line can hold
        return 2, None
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("programs", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--commands", type=int, default=1_000_000, help="so many at most")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    end = time.monotonic() + options.seconds
    work = pathlib.Path(tempfile.mkdtemp(prefix="nef-odd-"))
    codes: collections.Counter[int] = collections.Counter()
    wrong = []
    try:
        shutil.copytree(DATA, work / "data")  # commands that are nearly right may write over it
        cases = paths_corpus.cases(work / "data", work / "input", options.seed)
        programs = options.programs.resolve()
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            first = 0
            while first < options.commands and time.monotonic() < end:
                numbers = range(first, min(first + 16 * options.jobs, options.commands))
                first = numbers.stop
                for code, found in pool.map(lambda i: attempt(i, options.seed, programs, cases, work), numbers):
                    codes[code] += 1
                    if found:
                        print(found, flush=True)
                        wrong.append(found)
    finally:
        shutil.rmtree(work, ignore_errors=True)
    print(f"{codes.total()} commands that are nearly right (exit codes: {dict(sorted(codes.items()))}), seed {options.seed}: "
          f"{len(wrong)} ended badly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
