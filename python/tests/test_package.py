"""The package as a whole: its names, their docstrings, and the methods written in Python."""

import re
import types
from pathlib import Path

import maxwrench as mw
import pytest


def test_all_lists_every_public_name():
    names = {n for n, v in vars(mw).items() if not n.startswith("_") and not isinstance(v, types.ModuleType)}
    assert set(mw.__all__) == names | {"__version__"}
    assert mw.__all__ == sorted(mw.__all__)


@pytest.mark.parametrize("name", [n for n in mw.__all__ if n != "__version__"])
def test_names_have_docstrings(name):
    thing = getattr(mw, name)
    assert thing.__doc__ and thing.__doc__.strip()
    for member in vars(thing).values() if isinstance(thing, type) else ():
        if isinstance(member, property):
            assert member.__doc__


def test_methods_of_the_compiled_classes():
    for owner, names in (
        (mw.Answer, ("plot", "wrench_at", "_repr_html_")),
        (mw.Robot, ("_repr_html_",)),
        (mw.Task, ("_repr_html_",)),
        (mw.Evaluations, ("_repr_html_",)),
        (mw.Explanation, ("_repr_html_",)),
    ):
        assert all(callable(getattr(owner, name)) for name in names)


@pytest.mark.skipif(
    not (Path(mw.__file__).parent / "problems").exists(), reason="the package in the build folder reads the problems of the sources"
)
def test_the_package_brings_all_files_of_the_problems():
    """Its meshes and licences, too: without a mesh a task has other answers."""
    source = Path(__file__).resolve().parents[2] / "problems"
    copy = Path(mw.__file__).parent / "problems"

    def files_of(folder):
        files = [f for f in folder.rglob("*") if f.is_file() and f.suffix not in (".cpp", ".h", ".cmake")]
        return {f.relative_to(folder): f.read_bytes() for f in files}

    ours = files_of(copy)
    assert ours and ours == files_of(source)
    assert mw.load("gallery/ur10/lift").robot.warnings == []


def public_names():
    """Every name of the package, and every member of its classes."""
    for name in mw.__all__:
        thing = getattr(mw, name)
        yield name
        if isinstance(thing, type):
            yield from (f"{name}.{member}" for member in vars(thing) if not member.startswith("_"))


def is_tested(name, text):
    """Whether a test names it: as an attribute, an argument of a part, or a text such as "beta" in a list of names."""
    last = name.rpartition(".")[2]
    return re.search(rf"(?:\.|[\"'])(?:\w+\.)?{last}\b|\b{last}=", text) is not None


def test_every_public_name_has_a_test():
    files = Path(__file__).parent.glob("test_*.py")
    text = "\n".join(file.read_text() for file in files if file.name != Path(__file__).name)
    names = list(public_names())
    assert len(names) > 400
    assert [name for name in names if name != "__version__" and not is_tested(name, text)] == []
    assert not is_tested("no_such_name", text)
