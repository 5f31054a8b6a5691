# SPDX-License-Identifier: Apache-2.0
"""What is wrong with the arguments of a call of the extension modules, in words.

pybind11 says only that no overload fits, and lists their types. `complaint` compares these with what was given: too many
arguments, a missing one, an unknown name, or the first value that is not of its type. The functions of the extension modules
call it when they are refused (python/binding/base/arguments.h); it changes no call.
"""
import re
import sys
from typing import Any, List, NamedTuple, Optional

from .errors import InputError

_SIGNATURE = re.compile(r"^    \d+\. (.*)$", re.MULTILINE)
_WORDS = {"int": "an int", "float": "a number", "str": "a str", "bool": "True or False", "function": "a function", "Callable": "a function",
          "Iterable": "a list of sets, or another iterable"}


class Parameter(NamedTuple):
    """A parameter as pybind11 writes it, "corners: int = 32"."""

    name: str
    type: str
    default: Optional[str]


def _parts(text: str) -> List[str]:
    """The parts between commas outside of brackets and quotes."""
    parts, depth, quote, begin = [], 0, "", 0
    for at, letter in enumerate(text):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        elif letter in "([{":
            depth += 1
        elif letter in ")]}":
            depth -= 1
        elif letter == "," and depth == 0:
            parts.append(text[begin:at].strip())
            begin = at + 1
    return [part for part in [*parts, text[begin:].strip()] if part]


def _parameters(signature: str) -> List[Parameter]:
    inside = signature[signature.index("(") + 1:]
    found = []
    for part in _parts(inside[:inside.rindex(") ->" if ") ->" in inside else ")")]):
        name, _, rest = part.partition(": ")
        kind, equals, default = rest.partition(" = ")
        found.append(Parameter(name, kind, default if equals else None))
    return found


def _fits(value: Any, kind: str) -> bool:
    """Whether a value may be of a type; True for types that are not known here."""
    if kind.startswith("Optional["):
        return value is None or _fits(value, kind[9:-1])
    if kind.startswith("Union["):
        return any(_fits(value, one) for one in _parts(kind[6:-1]))
    if kind.startswith("List["):
        return isinstance(value, (list, tuple)) and all(_fits(item, kind[5:-1]) for item in value)
    if kind == "int":
        return hasattr(value, "__index__")
    if kind == "float":
        return hasattr(value, "__float__") or hasattr(value, "__index__")
    if kind == "str":
        return isinstance(value, (str, bytes))
    if kind == "bool":
        return isinstance(value, bool) or type(value).__name__ == "bool_"
    if kind.startswith("Callable"):
        return callable(value)
    if kind == "Iterable":
        return hasattr(value, "__iter__")
    if re.fullmatch(r"nef\.[\w.]+", kind):
        return any(base.__name__ == kind.rpartition(".")[2] for base in type(value).__mro__)
    return True


def _named(kind: str) -> str:
    """A type in words."""
    if kind.startswith("Optional["):
        return _named(kind[9:-1]) + " or None"
    if kind.startswith("Union["):
        return " or ".join(_named(one) for one in _parts(kind[6:-1]))
    if kind.startswith("List["):
        return "a list, each item " + _named(kind[5:-1])
    return _WORDS.get(kind.partition("[")[0], "a " + re.sub(r"\._\w+", "", kind))


def shown(value: Any) -> str:
    """A value and its type, in one short line."""
    text = repr(value)
    text = text if len(text) <= 60 and "\n" not in text else " ".join(text[:50].split()) + "..."
    return f"{text} ({type(value).__name__})"


def wrong_type(name: str, kind: str, value: Any) -> str:
    """What is said of a value that is not of the type that pybind11 calls `kind`."""
    return f"{name} must be {_named(kind)}, not {shown(value)}"


def require_int(name: str, value: Any, low: int, high: int) -> None:
    """Raises TypeError unless the value is an int, and InputError unless that is from `low` to `high`."""
    if not hasattr(value, "__index__"):
        raise TypeError(wrong_type(name, "int", value))
    if not low <= value <= high:
        raise InputError(f"{name} must be from {low} to {high}, not {value}")


def _place(value: Any, function: str, name: str) -> str:
    """ "function(): name", where a value was given. Cores whose parameters have no names are called by functions of this
    package, where the value has one."""
    frame = sys._getframe(3)  # of what called the extension module
    code = frame.f_code
    if frame.f_globals.get("__name__", "").startswith("nef."):
        for outer in code.co_varnames[:code.co_argcount + code.co_kwonlyargcount]:
            if frame.f_locals.get(outer) is value:
                called = code.co_name if code.co_name != "__init__" else type(frame.f_locals["self"]).__name__
                return f"{called}(): {outer}"
    return f"{function}(): " + (f"argument {int(name[3:]) + 1}" if re.fullmatch(r"arg\d+", name) else name)


def _usage(function: str, parameters: List[Parameter]) -> str:
    texts = (p.name if p.default is None else f"{p.name}={p.default}" for p in parameters)
    return f"{function}({', '.join(texts)})"


def _one_complaint(function: str, parameters: List[Parameter], arguments: tuple, keywords: dict) -> str:
    usage = _usage(function, parameters)
    positional = []
    for parameter in parameters:
        if parameter.name.startswith("*"):
            break
        positional.append(parameter)
    if len(arguments) > len(positional) and not any(p.name == "*args" for p in parameters):
        numbers = len(arguments) > 2 and all(isinstance(value, (int, float)) for value in arguments)
        hint = "; three coordinates are one argument, such as (0, 0, 1)" if numbers else ""
        return f"{function}() was called with too many arguments, {len(arguments)}: {usage}{hint}"
    named = {parameter.name: parameter for parameter in parameters}
    for name in keywords:
        if name not in named and "**kwargs" not in named:
            return f"{function}() has no argument {name!r}: {usage}"
    given = dict(zip((parameter.name for parameter in positional), arguments))
    for name in keywords:
        if name in given:
            return f"{function}() was given the argument {name!r} twice: {usage}"
    given.update(keywords)
    for parameter in parameters:
        if parameter.name not in given and parameter.default is None and not parameter.name.startswith("*"):
            return f"{function}() lacks the argument {parameter.name!r}: {usage}"
    for parameter in parameters:
        if parameter.name in given and not _fits(given[parameter.name], parameter.type):
            value = given[parameter.name]
            return wrong_type(_place(value, function, parameter.name), parameter.type, value)
    given_values = [shown(value) for value in arguments] + [f"{name}={shown(value)}" for name, value in keywords.items()]
    return f"{function}() does not take these values: {', '.join(given_values)}; it is {usage}"


def complaint(text: str, arguments: tuple, keywords: Optional[dict]) -> str:
    """pybind11's message `text` about a call with these arguments, in words."""
    function = text[:text.index("(")]
    signatures = _SIGNATURE.findall(text)
    overloads = [_parameters(signature) for signature in signatures]
    if function == "__init__":
        function = signatures[0][:signatures[0].index("(")].rpartition(".")[2]
        arguments = arguments[1:]
    elif all(parameters and parameters[0].name == "self" for parameters in overloads):
        if arguments and not _fits(arguments[0], overloads[0][0].type):
            return f"{function}() is a method of {_named(overloads[0][0].type)}, not of {shown(arguments[0])}"
        overloads = [parameters[1:] for parameters in overloads]
        arguments = arguments[1:]
    if len(overloads) == 1:
        return _one_complaint(function, overloads[0], arguments, keywords or {})
    return f"{function}() takes none of these values: {', '.join(map(shown, arguments)) or 'no argument'}; it is " + " or ".join(
        _usage(function, parameters) for parameters in overloads)
