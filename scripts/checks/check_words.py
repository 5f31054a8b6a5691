#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether messages and --help use plain words: looks through the string literals of the programs, the library and the Python
binding for words that the project no longer uses, and prints each with the word to write instead. Exits 1 if there are any.

Usage: scripts/checks/check_words.py [FILE...]
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SOURCES = ["apps", "nef", "python/binding", "python/nef"]

# A word or phrase, and what to write instead.
RETIRED = [
    (r"mend(s|ed|ing)?", "repair"),
    (r"(hold|holds|holding|held)", "contain, store"),
    (r"(tell|tells|told)", "report, print"),
    (r"ask(s|ed)?", "call, query, need (people ask)"),
    (r"rooms?", "folder, space"),
    (r"(stand|stands|stood)", "be, replace, lie"),
    (r"wants?", "need"),
    (r"whoever", "name the actor"),
    (r"promises?", "announce, declare"),
    (r"(?<!there )(?:is|are|was|were|be) no(?! longer)", "is not a"),
    (r"(?<!if )need not", "does not need to"),
    (r"so (?:much|many)", "this much, at most N"),
    (r"if need be", "if missing, when needed"),
    (r"for want of", "because there is no"),
    (r"gone? with", "is allowed with, excludes"),
    (r"anew", "again"),
    (r"a (?:line|view|frame|edge) each", "one per"),
]
PATTERN = re.compile("|".join(rf"(?P<w{i}>\b{word}\b)" for i, (word, _) in enumerate(RETIRED)), re.IGNORECASE)

# What is said of proofs and promised by signals; names that other software gave.
ALLOWED = re.compile(r"proof (?:holds|does not hold)|held_out|need not sum|\"holds\"|^holds$")

CPP_LITERAL = re.compile(
    r'R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"|"(?P<text>(?:[^"\\\n]|\\.)*)"|//[^\n]*|/\*.*?\*/|' r"'(?:[^'\\\n]|\\.)'", re.DOTALL)
PYTHON_LITERAL = re.compile(
    r'"""(?P<raw>.*?)"""|"(?P<text>(?:[^"\\\n]|\\.)*)"|#[^\n]*|' r"'(?P<mark>(?:[^'\\\n]|\\.)*)'", re.DOTALL)

# Names of invariants are for developers; a broken one is an internal error.
INVARIANTS = re.compile(r"(?:NEF_ASSERT|expect|demand|broken|check)\s*\(.*$")


def literals(path: pathlib.Path) -> list[tuple[int, str]]:
    """Line and text of each literal; adjacent ones are one text."""
    source = path.read_text(encoding="utf-8")
    python = path.suffix == ".py"
    names = ("raw", "text", "mark") if python else ("raw", "text")
    result: list[tuple[int, str]] = []
    end = -1
    for match in (PYTHON_LITERAL if python else CPP_LITERAL).finditer(source):
        text = next((match.group(name) for name in names if match.group(name) is not None), None)
        if text is None:
            continue
        line_begin = source.rfind("\n", 0, match.start()) + 1
        before = source[line_begin:match.start()]
        if before.lstrip().startswith("#include") or INVARIANTS.search(before):
            continue
        if end >= 0 and not source[end:match.start()].strip():
            result[-1] = (result[-1][0], result[-1][1] + text)
        else:
            result.append((source.count("\n", 0, match.start()) + 1, text))
        end = match.end()
    return result


def complaints(path: pathlib.Path) -> list[str]:
    found = []
    for line, text in literals(path):
        for match in PATTERN.finditer(ALLOWED.sub("", text.replace("\\n", " "))):
            instead = RETIRED[int(match.lastgroup[1:])][1] if match.lastgroup else ""
            found.append(f"{path.relative_to(ROOT)}:{line}: '{match.group()}' in \"{text[:100]}\": write {instead}")
    return found


def main() -> int:
    files = [pathlib.Path(name).resolve() for name in sys.argv[1:]]
    if not files:
        files = [path for folder in SOURCES for path in sorted((ROOT / folder).rglob("*")) if path.suffix in (".cpp", ".h", ".py")]
    files = [path for path in files if "validation" not in path.parts]
    found = [line for path in files for line in complaints(path)]
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
