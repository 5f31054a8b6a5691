# SPDX-License-Identifier: Apache-2.0
"""Writes a stub of an extension module with the docstrings of the module, for editors that do not import it.

Usage: python/stub_docstrings.py PACKAGE NAME STUB OUTPUT

PACKAGE is the folder of the built package, NAME that of the module, such as _nef.
"""
import ast
import importlib
import inspect
import pathlib
import sys
import types


def load(package: pathlib.Path, name: str):
    """The extension module, without the package around it, which needs numpy."""
    nef = types.ModuleType("nef")
    nef.__path__ = [str(package)]
    sys.modules["nef"] = nef
    return importlib.import_module("nef." + name)


def docstring_of(owner, name: str):
    return inspect.getdoc(vars(owner).get(name)) if not name.startswith("__") else None


def quoted(text: str, indent: str) -> str:
    lines = text.replace("\\", "\\\\").replace('"""', '\\"\\"\\"').split("\n")
    body = "\n".join([lines[0], *((indent + line if line else "") for line in lines[1:])])
    return f'{indent}"""{body}\n{indent}"""' if len(lines) > 1 else f'{indent}"""{body}"""'


def with_docstrings(stub: str, module) -> str:
    """The text of the stub with docstrings; of overloads, the first one has it."""
    lines = stub.split("\n")
    inserted = []  # (line to replace or to insert after, text, whether "..." ends that line)
    done = set()

    def visit(body, owner, indent):
        for node in body:
            if isinstance(node, ast.ClassDef):
                cls = vars(owner).get(node.name)
                if inspect.getdoc(cls):
                    inserted.append((node.lineno, quoted(inspect.getdoc(cls), indent + "    "), False))
                visit(node.body, cls, indent + "    ")
            elif isinstance(node, ast.FunctionDef) and (owner, node.name) not in done:
                done.add((owner, node.name))
                text = docstring_of(owner, node.name)
                if text:
                    inserted.append((node.end_lineno, quoted(text, indent + "    "), True))

    visit(ast.parse(stub).body, module, "")
    for number, text, ends in sorted(inserted, reverse=True):
        if ends:
            lines[number - 1] = lines[number - 1].removesuffix(" ...")
        lines.insert(number, text)
    return "\n".join(lines)


def main() -> None:
    package, name, stub, output = sys.argv[1:]
    text = with_docstrings(pathlib.Path(stub).read_text(encoding="utf-8"), load(pathlib.Path(package), name))
    pathlib.Path(output).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
