# SPDX-License-Identifier: Apache-2.0
"""The type stubs name what there is: every function and method, with its parameters in their order."""
import ast
import importlib
import inspect
import pathlib

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
                more = [argument for argument in (node.args.vararg, node.args.kwarg) if argument]
                names = [argument.arg for argument in node.args.args + node.args.kwonlyargs + more]
                found[prefix + node.name] = names[1:] if prefix else names

    visit(ast.parse(path.read_text()).body, "")
    return found


def parameters(function):
    """The names of the parameters but self; None for a function of several overloads, which has no signature."""
    try:
        names = list(inspect.signature(function).parameters)
    except ValueError:
        return None
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
    skipped = {f"{name}.{key}" for name in ("Polyhedron", "TiledPolyhedron") for key in ("__getattr__", "__init__", "__repr__", "__new__")}
    for key, function in there.items():
        if key in skipped or "._pybind11" in key:
            continue
        assert key in stubs, f"{key} has no stub"
        if ".__" not in key:
            assert stubs[key] == parameters(function), key
    assert set(stubs) - set(there) - skipped == set()


@pytest.mark.parametrize("name", ["nef", "minkowski", "planner", "remeshing", "visual_hull"])
def test_everything_public_is_documented(name, needs):
    module = needs(name)
    for key in module.__all__:
        assert (getattr(module, key).__doc__ or "").strip(), key
    for key, value in vars(nef.Polyhedron).items():
        if callable(value) and not key.startswith("_"):
            assert (value.__doc__ or "").strip(), key


@pytest.mark.parametrize("name", ["nef", "minkowski", "planner", "remeshing", "visual_hull"])
def test_public_functions_have_signatures(name, needs):
    module = needs(name)
    functions = [value for key, value in vars(module).items() if key in module.__all__ and callable(value)]
    for type_ in [value for value in functions if isinstance(value, type)]:
        functions += [value for key, value in vars(type_).items() if callable(value) and not key.startswith("_")]
    for function in functions:
        if not isinstance(function, type):
            inspect.signature(function)
    assert str(inspect.signature(nef.box)) == "(low, high)"
    assert str(inspect.signature(nef.Polyhedron.contains)) == "(self, points, threads=1)"
    assert str(inspect.signature(nef.Polyhedron().to_mesh)) == (
        "(polygons=False, exact=False, *, manifold=False, recenter=False, repair=False)")
    assert nef.box.__doc__.startswith("The closed box")


@pytest.mark.parametrize("name", ["_nef", "_minkowski"])
def test_stubs_have_the_docstrings_of_the_module(name, needs):
    needs(name[1:])
    module = importlib.import_module("nef." + name)
    seen = 0
    for node in ast.parse(pathlib.Path(nef.__file__).with_name(name + ".pyi").read_text()).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and not node.name.startswith("_"):
            assert inspect.cleandoc(ast.get_docstring(node)) == inspect.getdoc(getattr(module, node.name)), node.name
            seen += 1
    assert seen > 15


def test_the_reference_has_everything_public():
    reference = (pathlib.Path(__file__).resolve().parents[1] / "reference" / "index.rst").read_text()
    for key in nef.__all__:
        module = getattr(nef, key).__module__
        assert f":: nef.{key}\n" in reference or f"automodule:: {module}\n" in reference, key
