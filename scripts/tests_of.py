#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tests of a source: those of its name, those that include its header, and those with a comment that names its path or
its folder (with a slash behind it); if there are none, those of the sources that use it, with the way to them.

Usage: scripts/tests_of.py nef/boolean/operand.cpp ...
"""
import collections
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCES = ["nef", "apps"]
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
NAMED = re.compile(r"^//.*?\b((?:nef|apps)/[\w/]*(?:\.cpp\b|/(?!\w)))", re.MULTILINE)
STEPS = 2  # from a source to one that uses it and has a test


def files(folders: list[str], suffixes: tuple[str, ...]) -> dict[str, str]:
    paths = (path for folder in folders for path in sorted((ROOT / folder).rglob("*")) if path.suffix in suffixes)
    return {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8", errors="replace") for path in paths}


class Tests:
    """What tests which source."""

    def __init__(self) -> None:
        self.sources = files(SOURCES, (".cpp", ".h"))
        self.by_name: dict[str, list[str]] = collections.defaultdict(list)
        self.by_path: dict[str, list[str]] = collections.defaultdict(list)
        for test, text in files(["tests"], (".cpp", ".h", ".py")).items():
            self.by_name[re.sub(r"_test$", "", pathlib.Path(test).stem)].append(test)
            for path in INCLUDE.findall(text) + NAMED.findall(text):
                self.by_path[path].append(test)
        self.users: dict[str, set[str]] = collections.defaultdict(set)
        for source, text in self.sources.items():
            for path in INCLUDE.findall(text):
                self.users[path].add(source)

    def header(self, source: str) -> str:
        return source[: -len(".cpp")] + ".h" if source.endswith(".cpp") else source

    def direct(self, source: str) -> list[str]:
        header = self.header(source)
        folders = [f"{folder}/" for folder in pathlib.PurePosixPath(source).parents]
        found = set(self.by_name[pathlib.Path(source).stem])
        for path in (source, header, *folders):
            found.update(self.by_path[path])
        return sorted(found)

    def used_by(self, source: str) -> set[str]:
        """The sources that include its header. One without a header of its own is declared in one that it includes."""
        header = self.header(source)
        if header in self.sources:
            return self.users[header] - {source, header}
        folder = source.rsplit("/", 1)[0]
        included = (path for path in INCLUDE.findall(self.sources[source]) if path in self.sources)
        return {path for path in included if folder.startswith(path.rsplit("/", 1)[0])}

    @functools.cache
    def nearest(self, source: str) -> tuple[list[str], list[str]]:
        """Tests, and the sources on the way to them."""
        seen = {source}
        level: list[tuple[str, list[str]]] = [(source, [])]
        for _ in range(STEPS + 1):
            for path, way in level:
                if self.direct(path):
                    return self.direct(path), way
            further = []
            for path, way in level:
                for user in sorted(self.used_by(path) - seen):
                    seen.add(user)
                    further.append((user, [*way, user]))
            level = further
        return [], []


def untested() -> list[str]:
    """The sources that no test is near."""
    tests = Tests()
    return [source for source in tests.sources if source.endswith(".cpp") and not tests.nearest(source)[0]]


def main() -> int:
    if len(sys.argv) < 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    tests = Tests()
    code = 0
    for source in sys.argv[1:]:
        if source not in tests.sources:
            print(f"{source}: no source of this name in {' or '.join(SOURCES)}", file=sys.stderr)
            return 2
        found, way = tests.nearest(source)
        code = code if found else 1
        print(f"{source}: {', '.join(found) or 'no test'}" + (f" (through {', '.join(way)})" if way else ""))
    return code


if __name__ == "__main__":
    sys.exit(main())
