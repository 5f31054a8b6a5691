#!/usr/bin/env python3
"""What .ci/run looks at: what is due, what changed since its last green run, and as much of the rest as there is time for.

A run may leave out what it has no time for, but not for long: what two runs in a row have left out is due, and a due
item is looked at whatever the time. So nothing stays unseen for more than two runs. Who was left out how often stands in
build/ci-unseen.json. A fresh clone has no such file; there, the number n of commits in the history of HEAD takes its
place: the items fall into three parts by a checksum of their names, and part n mod 3 is due. So three fresh clones of
successive commits see everything between them. (Fresh clones of every third commit only would see the same part each
time: keep build/ci-unseen.json between runs there.) Nothing depends on the clock but how much fits.

The last green run is, in this order: the commit in NEF_CI_BASE, the commit that a green run left in build/ci-green, or,
in a fresh clone, which knows no runs, the state before the last commits (HISTORY of them).

Usage: ci_selection.py base                     the commit, and how it was found
       ci_selection.py tests SECONDS            lines "run NAME" and "left NAME": test programs for the sanitizers, which
                                                take so many CPU seconds together to build and run
       ci_selection.py seen FILE                records that the items in FILE, a line each, were looked at to the end
       ci_selection.py green                    records that HEAD is green
"""
import json
import os
import subprocess
import sys
import zlib

HISTORY = 25
RECORD = "build/ci-green"
UNSEEN = "build/ci-unseen.json"  # item: how many runs in a row have left it out
DUE = 2  # so many, and the next run does not

# Test programs under the sanitizers: CPU seconds that it takes there to build what the stage before has not built, and to
# run them; and the folders that they are about. The core's are always looked at. The stage prints what a program took; what
# is said here is to be no less.
CORE = {
    "test_core": (60, 75),
    "test_laws": (20, 10),
    "test_query": (25, 40),
    "test_tiles": (15, 160),
    "test_io": (50, 130),
}
POOL = {
    "test_minkowski": (60, 160, "apps/minkowski/", "tests/minkowski/"),
    "test_visual_hull": (60, 100, "apps/visual_hull/", "tests/visual_hull/"),
    "test_planner": (90, 450, "apps/planner/", "tests/planner/"),
    "test_view": (30, 20, "apps/view/", "tests/view/"),
    "test_nef_mpi": (20, 300, "apps/nef_mpi/", "tests/nef_mpi/"),
    "test_remeshing": (20, 20, "apps/remeshing/", "tests/remeshing/"),
    "test_command": (40, 250, "apps/nef/", "apps/nef/command/", "apps/program/", "tests/command/"),
}


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


def unseen(items: list[str]) -> dict[str, int]:
    """How many runs have left each item out; where no run is known of, by the number of commits (see above)."""
    known = recorded()
    commits = int(git("rev-list", "--count", "HEAD") or 0)
    return {item: known[item] if item in known else (zlib.crc32(item.encode()) - commits) % 3 for item in items}


def choose(costs: dict[str, int], first: set[str], budget: float, parts: dict[str, list[str]] | None = None) -> list[str]:
    """The items to look at now: all that are due, then those of `first`, then the others, each group from what was left
    out most often, as long as the budget is enough. An item may stand for several parts, by which it is known from run to
    run. Counts all as left out; `seen` takes that back."""
    parts = parts or {item: [item] for item in costs}
    runs = unseen([part for item in costs for part in parts[item]])
    age = {item: max(runs[part] for part in parts[item]) for item in costs}
    order = sorted(costs, key=lambda item: (age[item] < DUE, item not in first, -age[item], zlib.crc32(item.encode())))
    chosen = []
    for item in order:
        if age[item] >= DUE or costs[item] <= budget:
            budget -= costs[item]
            chosen.append(item)
    record(recorded() | {part: count + 1 for part, count in runs.items()})
    return chosen


def seen(items: list[str]) -> None:
    """These were looked at to the end."""
    record(recorded() | {item: 0 for item in items})


def tests(seconds: int) -> None:
    """The core's programs, and of the others what choose() says."""
    files = changed()
    touched = {name for name, (_, _, *folders) in POOL.items() if any(file.startswith(tuple(folders)) for file in files)}
    costs = {name: build + run for name, (build, run, *_) in POOL.items()}
    chosen = list(CORE) + choose(costs, touched, seconds - sum(build + run for build, run in CORE.values()))
    # The longest first, so that no core is left waiting for the last one.
    for name in sorted(CORE | POOL, key=lambda name: -(CORE | POOL)[name][1]):
        print(f"{'run' if name in chosen else 'left'} {name}")


def main() -> int:
    command = sys.argv[1] if len(sys.argv) > 1 else ""
    if command == "base":
        commit, why = base()
        print(f"{commit[:12] or '-'} ({why}); {len(changed())} files changed")
    elif command == "tests":
        tests(int(sys.argv[2]))
    elif command == "seen":
        with open(sys.argv[2], encoding="utf-8") as file:
            seen(file.read().split())
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
