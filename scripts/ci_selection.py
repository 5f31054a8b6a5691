#!/usr/bin/env python3
"""What .ci/run looks at: what is due, what changed since its last green run, and as much of the rest as there is time for.

A run may leave out what it has no time for, but not for long: what two runs in a row have left out is due. Due items come
first, and a run that does not reach all of them fails. So nothing stays unseen for more than two runs. Who was left out how
often stands in build/ci-unseen.json. A fresh clone has no such file; there, the number n of commits in the history of HEAD
takes its place: the items fall into three parts by a checksum of their names, and part n mod 3 is due. So three fresh
clones of successive commits see everything between them. (Fresh clones of every third commit only would see the same part
each time: keep build/ci-unseen.json between runs there.) Nothing depends on the clock but how much fits.

The last green run is, in this order: the commit in NEF_CI_BASE, the commit that a green run left in build/ci-green, or,
in a fresh clone, which knows no runs, the state before the last commits (HISTORY of them).

Usage: ci_selection.py base     the commit, and how it was found
       ci_selection.py green    records that HEAD is green
"""
import concurrent.futures
import json
import os
import subprocess
import sys
import time
import zlib
from collections.abc import Callable

HISTORY = 25
RECORD = "build/ci-green"
UNSEEN = "build/ci-unseen.json"  # item: how many runs in a row have left it out
DUE = 2  # so many, and the next run does not


def git(*arguments: str) -> str:
    return subprocess.run(["git", *arguments], capture_output=True, text=True, check=False).stdout.strip()


def is_ancestor(commit: str) -> bool:
    command = ["git", "merge-base", "--is-ancestor", commit, "HEAD"]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def base() -> tuple[str, str]:
    """The commit that changes are counted from (empty: nothing is known), and why that one."""
    given = os.environ.get("NEF_CI_BASE", "")
    if given and is_ancestor(given):
        return git("rev-parse", given), "NEF_CI_BASE"
    if os.path.exists(RECORD):
        with open(RECORD, encoding="utf-8") as file:
            recorded = file.read().strip()
        if recorded and is_ancestor(recorded):
            return recorded, "the last green run here"
    history = git("rev-list", f"--max-count={HISTORY + 1}", "HEAD").split()
    if len(history) > 1:
        return history[-1], f"no run is recorded here: the last {len(history) - 1} commits"
    return "", "no history: nothing is known to have changed"


def changed() -> list[str]:
    commit, _ = base()
    # Untracked and uncommitted files count, too.
    files = git("diff", "--name-only", commit).splitlines() if commit else []
    return files + git("ls-files", "--others", "--exclude-standard").splitlines()


def recorded() -> dict[str, int]:
    try:
        with open(UNSEEN, encoding="utf-8") as file:
            return {str(item): int(runs) for item, runs in json.load(file).items()}
    except (OSError, ValueError, AttributeError, TypeError):
        return {}


def record(runs: dict[str, int]) -> None:
    os.makedirs(os.path.dirname(UNSEEN), exist_ok=True)
    with open(UNSEEN, "w", encoding="utf-8") as file:
        json.dump(dict(sorted(runs.items())), file, indent=0)


def unseen(items: dict[str, list[str]]) -> dict[str, int]:
    """How many runs have left out each item, or that of its parts which was left out most often; where no run is known of,
    by the number of commits (see above)."""
    known = recorded()
    commits = int(git("rev-list", "--count", "HEAD") or 0)
    result = {}
    for item, parts in items.items():
        runs = [known[part] for part in parts if part in known]
        result[item] = max(runs) if runs else (zlib.crc32(min(parts).encode()) - commits) % 3
    return result


def in_order(items: dict[str, list[str]], first: set[str]) -> tuple[list[str], set[str]]:
    """The items: all that are due, then those of `first`, then the others, each group from what was left out most often;
    and those that are due."""
    age = unseen(items)
    due = {item for item in items if age[item] >= DUE}
    return sorted(items, key=lambda item: (item not in due, item not in first, -age[item], zlib.crc32(item.encode()))), due


def look_at(items: dict[str, list[str]], first: set[str], seconds: float, look: Callable[[str], bool]) -> bool:
    """Looks at items on all cores, in that order, and begins none when so many seconds are over. An item is known from run
    to run by its parts. `look(item)` tells whether it came to an end. Prints what was left out, and returns whether nothing
    is among it that was due."""
    order, due = in_order(items, first)
    record(recorded() | {part: runs + 1 for item, runs in unseen(items).items() for part in items[item]})
    end = time.monotonic() + seconds

    def begin(item: str) -> bool:
        return time.monotonic() < end and look(item)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        done = {item for item, ended in zip(order, pool.map(begin, order)) if ended}
    record(recorded() | {part: 0 for item in done for part in items[item]})
    for item in order:
        if item not in done:
            print(f"{'LEFT OUT THOUGH DUE' if item in due else 'left out today'}: {item}", flush=True)
    print(f"looked at {len(done)} of {len(items)}", flush=True)
    return due <= done


def main() -> int:
    command = sys.argv[1] if len(sys.argv) > 1 else ""
    if command == "base":
        commit, why = base()
        print(f"{commit[:12] or '-'} ({why}); {len(changed())} files changed")
    elif command == "green":
        os.makedirs("build", exist_ok=True)
        with open(RECORD, "w", encoding="utf-8") as file:
            file.write(git("rev-parse", "HEAD") + "\n")
    else:
        print(__doc__, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
