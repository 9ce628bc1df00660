"""The types that are made with the module: every public name has a signature; and everything is explained."""
import ast
import inspect
import re
from pathlib import Path

import palpate
import pytest
from conftest import SOURCE

STUB = Path(palpate.__file__).with_name("palpate.pyi").read_text()
TREE = ast.parse(STUB)
CLASSES = {node.name: node for node in TREE.body if isinstance(node, ast.ClassDef)}


def functions_of(body):
    return {node.name: node for node in body if isinstance(node, ast.FunctionDef)}


def public(names):
    return {name for name in names if not name.startswith("_")}


def arguments(node):
    """Names, kinds and defaults; the names of *specs aside."""
    spec = node.args
    defaults = [ast.unparse(value) for value in spec.defaults]
    keyword = [(one.arg, default and ast.unparse(default))
               for one, default in zip(spec.kwonlyargs, spec.kw_defaults)]
    return [one.arg for one in spec.args], defaults, bool(spec.vararg), keyword


def signature(function):
    line = (function.__doc__ or "").splitlines()[0]
    if not line.startswith(f"{function.__name__}("):  # one that is written in Python
        line = f"{function.__name__}{inspect.signature(function)}"
    return ast.parse(f"def {line}: ...").body[0]


def test_names_are_those_of_the_module():
    in_stub = set(CLASSES) | set(functions_of(TREE.body))
    assert public(in_stub) == public(vars(palpate))


@pytest.mark.parametrize("name", [n for n in CLASSES if n != "Error"])
def test_members_are_those_of_the_class(name):
    stubbed = functions_of(CLASSES[name].body)
    real = getattr(palpate, name)
    assert public(stubbed) == public(vars(real))
    for member, node in stubbed.items():
        decorators = {one.id for one in node.decorator_list}
        kind = vars(real)[member]
        assert ("property" in decorators) == isinstance(kind, property), member
        assert ("staticmethod" in decorators) == isinstance(kind, staticmethod), member
        if callable(getattr(real, member)) and not member.startswith("_"):
            assert arguments(node) == arguments(signature(getattr(real, member))), member


@pytest.mark.parametrize("name", sorted(functions_of(TREE.body)))
def test_arguments_are_those_of_the_function(name):
    assert arguments(functions_of(TREE.body)[name]) == arguments(signature(getattr(palpate, name)))


@pytest.mark.parametrize("name", sorted(functions_of(TREE.body)))
def test_types_are_those_of_python(name):
    node = functions_of(TREE.body)[name]
    spec = node.args
    for one in [*spec.args, *spec.kwonlyargs] if name != "render" else []:
        assert one.annotation, one.arg
    assert not re.search(r"::|palpate\.|numpy\.|\b(object|Optional|List|Dict)\b", ast.unparse(node))
    assert "::" not in (getattr(palpate, name).__doc__ or "").splitlines()[0]  # no type of C++


def test_types_that_are_known():
    def definition(line):
        assert f"\n{line}: ...\n" in STUB or f"\n    {line}: ...\n" in STUB, line
    definition("def load(path: _Path) -> Profile")
    definition("def verify(path: _Path) -> dict[str, Any]")
    definition("def grasps(profile: Profile, *, rule: str='general') -> Table")
    definition("def strongest_taxel(profile: Profile) -> Any")
    definition("def first_contact(profile: Profile, *, frames: int=3, taxels: int=3) -> int | None")
    definition("def __getitem__(self, frames: slice) -> Profile")
    definition("def matrix(self, m: int, start: int=0, stop: int | None=None) -> NDArray[np.float32]")
    for name in ("signals", "slip", "slip_segments", "contact", "grasps", "seconds", "compare", "labels", "flat"):
        assert ast.unparse(functions_of(TREE.body)[name].returns) == "Table", name


def test_the_manual_shows_which_arguments_are_given_by_name():
    functions = functions_of(TREE.body)
    for node in CLASSES.values():
        functions.update(functions_of(node.body))
    calls = re.findall(r"`(\w+)\(([^()`]*)\)", (SOURCE / "docs/manual/python.md").read_text())
    assert len(calls) > 40
    for name, text in calls:
        if name not in functions:
            continue
        by_name = {one.arg for one in functions[name].args.kwonlyargs}
        behind = False
        for part in (one.strip() for one in text.split(",")):
            behind = behind or part.startswith("*")
            assert behind or part.split("=")[0] not in by_name, (name, part)


def test_everything_is_explained():
    for name in public(vars(palpate)):
        thing = getattr(palpate, name)
        text = thing.__doc__
        assert text and len(text.split("\n\n", 1)[-1]) > 20, name
        if isinstance(thing, type):
            for member in public(vars(thing)) - {"args", "with_traceback"}:
                doc = getattr(thing, member).__doc__
                assert doc and len(doc.split("\n\n", 1)[-1]) > 10, f"{name}.{member}"


def test_the_page_names_everything():
    page = (SOURCE / "docs/manual/python.md").read_text()
    for name in public(vars(palpate)):
        assert any(form in page for form in (f"{name}(", f"`{name}`", f"`palpate.{name}`")), name
    for name, node in CLASSES.items():
        for member in public(functions_of(node.body)):
            assert member in page, f"{name}.{member}"
