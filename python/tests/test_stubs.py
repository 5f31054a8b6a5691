# SPDX-License-Identifier: Apache-2.0
"""The type stubs name what there is: every function and method, with its parameters in their order."""
import ast
import importlib
import pathlib
import re

import pytest

import nef


def stubbed(path):
    """{name: parameters} of a stub; methods as "Class.name"."""
    found = {}

    def visit(body, prefix):
        for node in body:
            if isinstance(node, ast.ClassDef):
                visit(node.body, node.name + ".")
            elif isinstance(node, ast.FunctionDef):
                names = [argument.arg for argument in node.args.args + node.args.kwonlyargs]
                found[prefix + node.name] = names[1:] if prefix else names

    visit(ast.parse(path.read_text()).body, "")
    return found


def parameters(function):
    """The names that pybind11 writes into the first line of a docstring; None for what is no such function."""
    match = re.match(r"\w+\((.*)\) -> ", function.__doc__ or "")
    if match is None:
        return None
    names = re.findall(r"(?:^|, )(\w+): ", match.group(1))
    return [name for name in names if name != "self"]


@pytest.mark.parametrize("name", ["_nef", "_minkowski"])
def test_stub(name, needs):
    needs(name[1:])
    module = importlib.import_module("nef." + name)
    stubs = stubbed(pathlib.Path(nef.__file__).with_name(name + ".pyi"))
    there = {key: value for key, value in vars(module).items() if callable(value) and not isinstance(value, type)}
    if name == "_nef":
        for type_ in (nef.Polyhedron, nef.TiledPolyhedron):
            there.update({f"{type_.__name__}.{key}": value for key, value in vars(type_).items() if callable(value)})
    skipped = {f"{name}.{key}" for name in ("Polyhedron", "TiledPolyhedron") for key in ("__init__", "__repr__", "__new__")}
    for key, function in there.items():
        if key in skipped or "._pybind11" in key:
            continue
        assert key in stubs, f"{key} has no stub"
        names = parameters(function)
        if names is not None and ".__" not in key:
            assert stubs[key] == names, key
    assert set(stubs) - set(there) - skipped == set()


@pytest.mark.parametrize("name", ["nef", "minkowski", "planner", "visual_hull"])
def test_everything_public_is_documented(name, needs):
    module = needs(name)
    for key in module.__all__:
        assert (getattr(module, key).__doc__ or "").strip(), key
    for key, value in vars(nef.Polyhedron).items():
        if callable(value) and not key.startswith("_"):
            assert (value.__doc__ or "").strip().count("\n") >= 1 or not parameters(value), key
