"""Tests that the type stub declares exactly the members of the extension, class by class."""
import ast
import inspect
import pathlib

from strata import _strata

# Members that every class of an extension has; most are from object.
COMMON = {"__init__", "__new__", "__repr__", "__module__", "__doc__", "__weakref__", "__dict__"}


def own_names(kind):
    return {name for name in vars(kind) if not name.startswith("_pybind11") and name not in COMMON}


def names_in(kind):
    """Methods and read-only attributes."""
    methods = {part.name for part in kind.body if isinstance(part, ast.FunctionDef)}
    return (methods | {part.target.id for part in kind.body if isinstance(part, ast.AnnAssign)}) - COMMON


def test_stub_and_extension_have_the_same_names():
    stub = ast.parse(pathlib.Path(_strata.__file__).with_name("_strata.pyi").read_text())
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    classes = {node.name: names_in(node) for node in stub.body if isinstance(node, ast.ClassDef)}
    found = vars(_strata)
    assert functions == {name for name, value in found.items() if callable(value) and not inspect.isclass(value)}
    assert set(classes) == {name for name, value in found.items() if inspect.isclass(value)}
    for name, members in classes.items():
        assert members == own_names(found[name]), name
