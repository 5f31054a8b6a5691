#!/usr/bin/env python3
"""What .ci/run looks at: what is due, what changed since its last green run, and as much of the rest as there is time for.

A run may leave out what it has no time for, but not for long: what three runs in a row have left out is due. Due items come
first, and a run that does not reach all of them fails. So nothing stays unseen for more than three runs. Who was left out
how often stands in build/ci-unseen.json. A fresh clone has no such file; there, the number of commits in the history of HEAD
takes its place: the items fall into four quarters, and one is due, the next one with each commit. So four fresh clones of
successive commits see everything between them. (Fresh clones of every fourth commit only would see the same quarter each
time: keep build/ci-unseen.json between runs there.) Nothing depends on the clock but how much fits.

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
DUE = 3  # so many, and the next run does not
QUARTERS = DUE + 1


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


class Choice:
    """The items of a run in their order, all of which count as left out until `end` is called. An item is known from run to
    run by its parts. Where no run is known of, `quarter` of its first part, modulo 4, tells in which quarter it is."""

    def __init__(self, items: dict[str, list[str]], first: set[str], quarter: Callable[[str], int]) -> None:
        self.items = items
        known = recorded()
        commits = int(git("rev-list", "--count", "HEAD") or 0)
        age = {}
        for item, parts in items.items():
            runs = [known[part] for part in parts if part in known]
            age[item] = max(runs) if runs else (quarter(min(parts)) - commits) % QUARTERS
        self.due = {item for item in items if age[item] >= DUE}
        # All that are due, then those of `first`, then the others, each group from what was left out most often.
        self.order = sorted(items, key=lambda item: (item not in self.due, item not in first, -age[item],
                                                     zlib.crc32(item.encode())))
        record(known | {part: age[item] + 1 for item in items for part in items[item]})

    def end(self, done: set[str]) -> bool:
        """What was looked at to its end; prints what was left out, and returns whether nothing of that was due."""
        record(recorded() | {part: 0 for item in done for part in self.items[item]})
        for item in self.order:
            if item not in done:
                print(f"{'LEFT OUT THOUGH DUE' if item in self.due else 'left out today'}: {item}", flush=True)
        print(f"looked at {len(done)} of {len(self.items)}", flush=True)
        return self.due <= done


def look_at(items: dict[str, list[str]], first: set[str], seconds: float, look: Callable[[str, bool], bool],
            at_once: int | None = None, quarters: dict[str, int] | None = None) -> bool:
    """Looks at items in the order of a Choice, so many at once (None: as there are cores). When so many seconds are over, it
    begins only those that are due; whoever calls sees to the end of all. `look(item, is_due)` tells whether it came to an
    end. Returns whether nothing was left out that was due. `quarters` tells in which quarter each item is; without it, these
    have equally many."""
    given = quarters or {item: number for number, item in enumerate(sorted(items))}
    quarter_of = {min(items[item]): quarter for item, quarter in given.items()}
    choice = Choice(items, first, quarter_of.__getitem__)
    end = time.monotonic() + seconds

    def begin(item: str) -> bool:
        is_due = item in choice.due
        return (is_due or time.monotonic() < end) and look(item, is_due)

    with concurrent.futures.ThreadPoolExecutor(at_once or os.cpu_count()) as pool:
        return choice.end({item for item, ended in zip(choice.order, pool.map(begin, choice.order)) if ended})


def built(folder: str, target: str) -> bool:
    """Builds a target in a folder that is configured; shows the end of what that printed if it fails."""
    run = subprocess.run(["cmake", "--build", folder, "--target", target], capture_output=True, text=True, errors="replace",
                         check=False)
    if run.returncode != 0:
        print(run.stdout[-4000:], flush=True)
    return run.returncode == 0


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
