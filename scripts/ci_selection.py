#!/usr/bin/env python3
"""What .ci/run looks at: what changed since its last green run, and a share of the rest that rotates from day to day.

The last green run is, in this order: the commit in NEF_CI_BASE, the commit that a green run left in build/ci-green, or,
in a fresh clone, which knows no runs, the state before the last commits (HISTORY of them).

Usage: ci_selection.py base                     the commit, and how it was found
       ci_selection.py tests SECONDS            lines "run NAME" and "left NAME": test programs for the sanitizers, which
                                                take so many CPU seconds together to build and run
       ci_selection.py green                    records that HEAD is green
"""
import os
import subprocess
import sys
import time

HISTORY = 25
RECORD = "build/ci-green"

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
    "test_view": (30, 20, "nef/view/", "tests/view/"),
    "test_nef_mpi": (20, 300, "apps/nef_mpi/", "tests/nef_mpi/"),
    "test_remeshing": (20, 20, "nef/remeshing/", "tests/remeshing/"),
    "test_command": (40, 250, "apps/nef/", "nef/command/", "nef/program/", "tests/command/"),
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


def day() -> int:
    return int(os.environ.get("NEF_CI_DAY", time.time() / 86400))


def rotated(items: list[str]) -> list[str]:
    """The items in an order that begins elsewhere each day, so that a share from the front reaches all in turn."""
    if not items:
        return []
    start = day() * 7 % len(items)
    return items[start:] + items[:start]


def tests(seconds: int) -> None:
    """The core's programs, then those whose folders changed, then others in turn, as long as the time is enough."""
    files = changed()
    touched = [name for name, (_, _, *folders) in POOL.items() if any(file.startswith(tuple(folders)) for file in files)]
    rest = [name for name in rotated(list(POOL)) if name not in touched]
    chosen = list(CORE)
    left = seconds - sum(build + run for build, run in CORE.values())
    for name in rotated(touched) + rest:
        build, run, *_ = POOL[name]
        if build + run <= left:
            left -= build + run
            chosen.append(name)
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
