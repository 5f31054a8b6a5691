# SPDX-License-Identifier: Apache-2.0
"""The notebooks run from top to bottom, and what each cell ends with shows itself.

A small executor instead of Jupyter's, which would need some fifty packages: cells are plain Python.
"""
import ast
import doctest
import json
import pathlib

import pytest

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent / "examples"


def run_cell(source, names, where):
    """Executes a cell; returns what its last line evaluates to, if that is an expression."""
    tree = ast.parse(source, where)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, where, "exec"), names)
    return None if last is None else eval(compile(ast.Expression(last.value), where, "eval"), names)


def show(value):
    """What Jupyter asks an object for."""
    png = getattr(value, "_repr_png_", lambda: None)()
    assert png is None or png.startswith(b"\x89PNG")
    page = getattr(value, "_repr_html_", lambda: None)()
    assert page is None or "<iframe" in page
    assert repr(value)


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebook(path, needs):
    book = json.loads(path.read_text(encoding="utf-8"))
    needed = {"visual_hull": "visual_hull", "configuration_space": "planner", "infeasibility": "planner"}
    if path.stem in needed:
        needs(needed[path.stem])
    names = {"__name__": "__main__"}
    for number, cell in enumerate(book["cells"]):
        if cell["cell_type"] == "code":
            show(run_cell("".join(cell["source"]), names, f"{path.name}, cell {number}"))


@pytest.mark.parametrize("name", ["nef", "minkowski", "planner", "remeshing"])
def test_docstrings(name, needs):
    module = needs(name)
    failed, tried = doctest.testmod(module)
    assert tried > 0 and failed == 0


@pytest.mark.parametrize("page", ["docs/tutorials/python.md", "docs/python.md", "docs/labels.md", "README.md"])
def test_pages(page, needs, tmp_path, monkeypatch):
    needs("minkowski")
    needs("planner")
    monkeypatch.chdir(tmp_path)
    path = EXAMPLES.parent.parent / page
    # A fence ends the output above it.
    text = path.read_text(encoding="utf-8").replace("\n```\n", "\n\n")
    parser = doctest.DocTestParser()
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    runner.run(parser.get_doctest(text, {}, page, str(path), 0))
    assert runner.tries > 0 and runner.failures == 0
