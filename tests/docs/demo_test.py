#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""README's first command, after its build: all jobs of scripts/demo.py run, and the page that they leave leads to pictures
with something on them and to files that are there.

Usage: demo_test.py SOURCE PROGRAM_DIRECTORY OUTPUT_DIRECTORY. Prints a word and stops if this build cannot write pages.
"""
import os
import re
import shutil
import subprocess
import sys
import zlib


def colours(picture: bytes) -> int:
    """How many different bytes the lines of a PNG file have; a blank one has a few."""
    assert picture.startswith(b"\x89PNG\r\n\x1a\n")
    packed = b""
    at = 8
    while at < len(picture):
        size = int.from_bytes(picture[at:at + 4], "big")
        if picture[at + 4:at + 8] == b"IDAT":
            packed += picture[at + 8:at + 8 + size]
        at += 12 + size
    return len(set(zlib.decompress(packed)))


def main() -> int:
    source, programs, out = (os.path.abspath(path) for path in sys.argv[1:4])
    shutil.rmtree(out, ignore_errors=True)
    run = subprocess.run([sys.executable, "-B", "scripts/demo.py", programs, out], cwd=source, capture_output=True, text=True,
                         check=False)
    if "pages cannot be written" in run.stdout + run.stderr:
        print("skipped: this build cannot write pages")
        return 0
    if run.returncode != 0:
        print(run.stdout + run.stderr)
        return 1
    with open(os.path.join(out, "index.html"), encoding="utf-8") as file:
        page = file.read()
    links = sorted(set(re.findall(r'(?:src|href)="([^"]+)"', page)))
    wrong = []
    for link in links:
        path = os.path.join(out, link)
        if not os.path.isfile(path) or os.path.getsize(path) == 0:
            wrong.append(f"{link} is not there")
            continue
        with open(path, "rb") as file:
            content = file.read()
        if link.endswith(".png") and colours(content) < 30:
            wrong.append(f"{link} is blank")
        if link.endswith(".glb") and not content.startswith(b"glTF"):
            wrong.append(f"{link} is no binary glTF")
    pictures = [link for link in links if link.endswith(".png")]
    if len(pictures) != page.count("<figure>") or sorted(pictures) != sorted(n for n in os.listdir(out) if n.endswith(".png")):
        wrong.append("not every picture is in the gallery once")
    print(f"{len(links)} links, {len(pictures)} pictures", *wrong, sep="\n")
    return 1 if wrong or not pictures else 0


if __name__ == "__main__":
    sys.exit(main())
