"""Docstrings, their examples, and how objects are shown."""

import doctest
import inspect
import re

import maxwrench as mw
import numpy as np
import pytest

PUBLIC = {name: value for name, value in vars(mw).items() if name[0] != "_" and not inspect.ismodule(value)}


def members(cls):
    """The public members that a class itself defines."""
    return {name: value for name, value in vars(cls).items() if name[0] != "_"}


def documented():
    """All public names with their objects: functions, classes and members."""
    for name, value in PUBLIC.items():
        yield name, value
        if inspect.isclass(value):
            for member, defined in members(value).items():
                if callable(defined) or isinstance(defined, (property, staticmethod)):
                    yield f"{name}.{member}", getattr(value, member)


DOCUMENTED = dict(documented())


def test_public_names():
    expected = {"load", "tasks", "Static", "Trajectory", "Impulse", "Task", "Robot", "Pose", "Path"}
    expected |= {"evaluate", "solve", "evaluate_joints", "Answer", "Evaluations"}
    expected |= {"capability", "scale", "Capability", "linprog", "LpAnswer"}
    expected |= {"measures", "solvers", "searches", "integrators", "describe_build", "InputError", "MissingFileError"}
    assert expected <= set(PUBLIC)
    assert re.match(r"\d+\.\d+\.\d+", mw.__version__) and mw.__version__ in mw.describe_build()


def test_the_module_has_a_docstring():
    assert mw.__doc__


@pytest.mark.parametrize("name", DOCUMENTED)
def test_docstrings(name):
    text = DOCUMENTED[name].__doc__
    assert text and text.strip()
    body = re.sub(r"^\w+\(.*\) -> .*\n+", "", text).strip()  # without the signature
    assert body, "only a signature"
    assert body.rstrip().endswith((".", ")", "'", "]")) or ">>>" in body


def arguments_of(function):
    """The names of a function's arguments; those of a compiled one are in the first line of its docstring."""
    if inspect.isfunction(function):
        return [name for name in inspect.signature(function).parameters if name != "self"]
    first = (function.__doc__ or "").partition("\n")[0]
    return [name for name in re.findall(r"(\w+): ", first.rpartition(" -> ")[0]) if name not in ("self", "arg0")]


FUNCTIONS = [name for name, value in DOCUMENTED.items() if inspect.isroutine(value) and arguments_of(value)]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_docstrings_name_all_arguments(name):
    body = re.sub(r"^\w+\(.*\) -> .*\n+", "", DOCUMENTED[name].__doc__)
    if "others:" in body:
        return  # they are those of another function
    for argument in arguments_of(DOCUMENTED[name]):
        if argument == "kwargs":
            continue  # those it takes have names of their own
        assert re.search(rf"\b{argument}\b", body, re.IGNORECASE), argument


@pytest.mark.parametrize("name", FUNCTIONS)
def test_signatures_are_those_of_python(name):
    # A name of C++ in a signature means that a type was bound too late.
    first = DOCUMENTED[name].__doc__.splitlines()[0]
    assert "::" not in first


EXAMPLES = {name: value for name, value in DOCUMENTED.items() if ">>>" in (value.__doc__ or "")}


@pytest.mark.parametrize("name", [name for name, value in PUBLIC.items() if callable(value)])
def test_each_function_and_class_has_an_example(name):
    assert name in EXAMPLES


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # where no file is
    test = doctest.DocTestParser().get_doctest(EXAMPLES[name].__doc__, {"maxwrench": mw, "numpy": np}, name, None, 0)
    report = []
    doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    assert not report, "".join(report)


def objects():
    static, in_time = mw.load("planar/force"), mw.load("planar/trajectory")
    path = mw.Path.screw(mw.Pose([1, 2, 3]), 2, angle=1)
    J = np.ones((2, 6, 3))
    limits = np.ones(3)
    return {
        "Pose": mw.Pose([1, 2, 3], rpy=[0.1, 0.2, 0.3]),
        "Path": path,
        "Robot": static.robot,
        "Robot of two arms": mw.load("dual_arm/two_arms").robot,
        "Task": static,
        "Task in time": in_time,
        "Answer": mw.evaluate(static, [0, 0]),
        "Answer without value": mw.evaluate(static, [0, 1.2]),
        "Answer in time": mw.evaluate(in_time, [0, 0]),
        "Answer of a search": mw.solve(static, budget=20),
        "Explanation": mw.evaluate(static, [0, 0]).explain(),
        "Explanation without value": mw.evaluate(static, [0, 1.2]).explain(),
        "Explanation in time": mw.evaluate(in_time, [0, 0]).explain(),
        "Limit": mw.evaluate(static, [0, 0]).explain().limits[0],
        "Evaluations": mw.evaluate(static, [[0, 0], [0, 1.2]]),
        "no Evaluations": mw.evaluate(static, np.zeros((0, 2))),
        "Capability": mw.capability(J[0], [0, 0, 0], -limits, limits, "x"),
        "Capability of many": mw.capability(J, np.zeros((2, 3)), -limits, limits, "x"),
        "Capability without value": mw.capability(J[0], [9, 0, 0], -limits, limits, "x"),
        "Polytope": mw.polytope(static, [0, 0], directions=np.eye(6)[:, :2]),
        "Polytope without end": mw.polytope(static, [0, 0], directions=np.eye(6)[:, 2:3]),
        "Ellipsoid": mw.ellipsoid(static, [0, 0], directions=np.eye(6)[:, :2]),
        "Experiment": mw.simulate(mw.evaluate(static, [0, 0]), ramp=0.1, hold=0.1),
        "Proof": mw.certify(static),
        "LpAnswer": mw.linprog([1, 2], [[1, 1]], [1]),
        "LpAnswer without value": mw.linprog([1], [[1]], [-1]),
    }


OBJECTS = objects()


@pytest.mark.parametrize("name", OBJECTS)
def test_repr_is_one_line(name):
    text = repr(OBJECTS[name])
    assert text and len(text.splitlines()) == 1 and len(text) < 300
    assert "object at 0x" not in text and name.split()[-1 if name.startswith("no ") else 0] in text


def test_a_program_without_an_optimum_shows_no_objective():
    assert "objective" not in repr(OBJECTS["LpAnswer without value"])


def test_repr_of_a_pose_makes_it_again():
    pose = mw.Pose([1, 2, 3], rpy=[0.25, -0.5, 0.75])
    again = eval(repr(pose), {"Pose": mw.Pose})
    np.testing.assert_allclose(again.matrix, pose.matrix, atol=1e-6)


@pytest.mark.parametrize("name", OBJECTS)
def test_all_properties_can_be_read(name):
    value = OBJECTS[name]
    for member, defined in members(type(value)).items():
        if isinstance(defined, property):
            getattr(value, member)


@pytest.mark.parametrize("name", OBJECTS)
def test_objects_cannot_change(name):
    value = OBJECTS[name]
    for member, defined in members(type(value)).items():
        if isinstance(defined, property):
            with pytest.raises(AttributeError):
                setattr(value, member, 1)


def test_an_answer_without_a_value():
    beyond = OBJECTS["Answer without value"]
    assert beyond.to_dict()["beta"] is None and "NaN" not in beyond.to_json()
    assert beyond.reason in beyond.summary() and beyond.reason in repr(beyond)
    for name in ("u", "h", "betas", "gradient", "lambda_"):
        assert getattr(beyond, name) is None
    with pytest.raises(mw.InputError) as caught:
        mw.solve("uvms/lift_impulse", search="sample", budget=3).figure()
    assert len(str(caught.value).splitlines()) == 1


def test_documents_of_an_answer():
    for name in ("Answer", "Answer in time", "Answer of a search"):
        answer = OBJECTS[name]
        assert answer.figure().startswith("<svg") and answer.figure().rstrip().endswith("</svg>")
        assert answer.task.name in answer.summary() and answer.to_dict()["problem"] == answer.task.name
