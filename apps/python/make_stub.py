"""Writes the types of the module palpate, as its docstrings and signatures say them, to a .pyi."""
import ast
import inspect
import sys

import palpate

HEAD = '''# Types of the module palpate, made with it; help() and docs/manual/python.md explain it.
import os
from collections.abc import Iterator, Sequence
from typing import Any, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Path = Union[str, "os.PathLike[str]"]
_Source = Union["Profile", "Features", _Path, Sequence[_Path]]

__version__: str

class Error(RuntimeError): ...
'''
# What the signature of a C++ function calls an object.
ARGUMENTS = {"source": "_Source", "a": "Profile | _Path", "b": "Profile | _Path",
             "hand": "Hand | _Path | None", "frames": "ArrayLike | Sequence[ArrayLike]",
             "matrix": "int | str | None", "reference": "str | int",
             "session_offset": "str | float", "scene": "_Path | dict[str, Any]",
             "events": "Sequence[dict[str, Any]]"}
ARRAYS = ("time_ms", "angles", "angle_time_ms", "temperatures", "temperature_time_ms")
ARGUMENTS.update({name: "ArrayLike | None" for name in ARRAYS})
SPECIAL = ("__init__", "__len__", "__getitem__", "__iter__")
RETURNED = {"Profile.__iter__": "Iterator[NDArray[np.float32]]"}


class Types(ast.NodeTransformer):
    """From the names of pybind11 to those of type checkers."""

    def __init__(self, returned):
        self.returned = returned

    def visit_Subscript(self, node):
        outer = ast.unparse(node.value)
        if outer == "numpy.ndarray":
            kind = ast.unparse(node.slice).replace("numpy", "np")
            return parsed(f"NDArray[{kind}]" if self.returned else "ArrayLike")
        if isinstance(node.slice, ast.Constant):  # float[2]: a list of that length
            return node.value
        parts = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        inside = [ast.unparse(self.visit(part)) for part in parts]
        if outer in ("Optional", "Union"):
            return parsed(" | ".join(inside + ["None"] * (outer == "Optional")))
        kept = {"List": "list" if self.returned else "Sequence", "Dict": "dict", "Tuple": "tuple"}
        return parsed(f"{kept.get(outer, outer)}[{', '.join(inside)}]")

    def visit_Attribute(self, node):
        name = ast.unparse(node)
        return parsed({"os.PathLike": "_Path", "numpy.ndarray": "NDArray[Any]"}.get(
            name, name.removeprefix("palpate.")))

    def visit_Name(self, node):
        return parsed({"dict": "dict[str, Any]", "list": "list[Any]", "tuple": "tuple[Any, ...]",
                       "object": "Any"}.get(node.id, node.id))


def parsed(text):
    return ast.parse(text, mode="eval").body


def function(signature, name, owner=""):
    """Its definition in the stub, of "name(argument: type = default, ..) -> type"."""
    node = ast.parse(f"def {signature}: ...").body[0]
    node.name = name
    for one in [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs]:
        if one.arg in ("self", "arg0"):
            one.arg, one.annotation = "self", None
        elif one.annotation and ast.unparse(one.annotation) == "object":
            one.annotation = parsed(ARGUMENTS.get(one.arg, "Any"))
        elif one.annotation:
            one.annotation = Types(returned=False).visit(one.annotation)
    if node.args.vararg:  # the filters of a chain, wherever there are any
        node.args.vararg = ast.arg("specs", parsed("str | Sequence[str]"))
    whole = f"{owner}{name}"
    if whole in RETURNED:
        node.returns = parsed(RETURNED[whole])
    elif node.returns:
        node.returns = Types(returned=True).visit(node.returns)
    return ast.unparse(ast.fix_missing_locations(node)).replace(":\n    ...", ": ...")


def signatures(thing, name):
    """Those that its docstring begins with, else what Python knows."""
    lines = (thing.__doc__ or "").splitlines()
    if lines and lines[0].startswith(f"{name}(*args, **kwargs)"):
        return [line.split(". ", 1)[1] for line in lines
                if line[:1].isdigit() and f". {name}(" in line]
    if lines and lines[0].startswith(f"{name}("):
        return [lines[0]]
    return [f"{name}{inspect.signature(thing)}"]


def definitions(thing, name, owner=""):
    found = signatures(thing, name)
    for each in found:
        if len(found) > 1:
            yield "@overload"
        yield function(each, name, owner)


def members(name, kind):
    for attribute, of in vars(kind).get("__annotations__", {}).items():
        yield f"{attribute}: {inspect.formatannotation(of)}"
    for member, value in sorted(vars(kind).items()):
        if member.startswith("_") and member not in SPECIAL:
            continue
        if isinstance(value, property):
            yield "@property"
            yield function(member + value.fget.__doc__.splitlines()[0], member)
        elif type(value).__name__ != "wrapper_descriptor":
            if isinstance(value, staticmethod):
                yield "@staticmethod"
            yield from definitions(getattr(kind, member), member, f"{name}.")


def stub():
    lines = [HEAD]
    public = [(name, thing) for name, thing in sorted(vars(palpate).items())
              if not name.startswith("_") and name != "Error"]
    for name, kind in public:
        if not isinstance(kind, type):
            continue
        base = "(dict[str, Any])" if issubclass(kind, dict) else ""
        lines.append(f"class {name}{base}:")
        lines += [f"    {line}" for line in members(name, kind)] + [""]
    for name, thing in public:
        if callable(thing) and not isinstance(thing, type):
            lines += definitions(thing, name)
    return "\n".join(lines) + "\n"


text = stub()
ast.parse(text)
with open(sys.argv[1], "w") as file:
    file.write(text)
