#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every piece of C++ on the pages and in the comments of headers is compiled: it stands, but for white space, includes and the frame
of main, in a source of tests/, or it is a file of a tutorial (a block with a title) or the example of visual_hull.h, which tests/install
builds.

Usage: check_snippets.py SOURCE_DIRECTORY
"""
import pathlib
import re
import sys

FRAME = re.compile(r"^\s*(#include.*|int main\(\) \{|using namespace .*;)\s*$")
BLOCK = re.compile(r"^```cpp *\n(.*?)^```", re.MULTILINE | re.DOTALL)

COMMENT = re.compile(r"(?:^//   .*\n)+", re.MULTILINE)
INSTALLED = "apps/visual_hull/visual_hull.h"


def header_examples(root: pathlib.Path):
    """The examples of headers: indented comments with statements of the library."""
    for folder in ("nef", "apps"):
        for path in sorted((root / folder).rglob("*.h")):
            for block in COMMENT.findall(path.read_text(encoding="utf-8")):
                if "nef::" in block and ";" in block and path != root / INSTALLED:
                    yield path, re.sub(r"^//   ", "", block, flags=re.MULTILINE)


def bare(text: str) -> str:
    lines = [re.sub(r"\s*//.*", "", line) for line in text.splitlines() if not FRAME.match(line)]
    return re.sub(r"\s+", "", "".join(lines))


def main() -> int:
    root = pathlib.Path(sys.argv[1])
    sources = [bare(path.read_text(encoding="utf-8")) for path in (root / "tests").rglob("*.cpp")]
    pages = [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
    blocks = [(page, block) for page in pages for block in BLOCK.findall(page.read_text(encoding="utf-8"))]
    blocks += header_examples(root)
    missing = []
    for page, block in blocks:
        code = bare(block)
        if "int main()" in block:
            code = code.rstrip("}")
        if not any(code in source for source in sources):
            missing.append(f"{page.relative_to(root)}: no test contains the C++ that begins with: {block.strip().splitlines()[0]}")
    print("\n".join(missing) or f"{len(blocks)} pieces of C++ are in tests")
    return 1 if missing or not blocks else 0


if __name__ == "__main__":
    sys.exit(main())
