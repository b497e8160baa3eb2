"""Pickled results: what one wants back from another process, with the same bits."""

import functools
import json
import multiprocessing
import pickle
import xml.etree.ElementTree as xml

import maxwrench as mw
import numpy as np
import pytest

ROWS = ("beta", "gradient", "q", "base", "u", "h")
SAMPLES = ("t", "readings", "planned_readings", "theta_r_error", "position_error", "h", "u")
SETS = ("vertices", "efforts", "normals", "offsets", "triangles", "flat_normals", "flat_offsets", "ray")
IN_PLANE = np.eye(6)[:, :2]


def again(value):
    return pickle.loads(pickle.dumps(value))


def assert_equal(first, second, names):
    for name in names:
        a, b = getattr(first, name), getattr(second, name)
        if b is None:
            assert a is None, name
            continue
        assert a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes(), name  # bits, NaN as well


@pytest.mark.parametrize(
    "rows",
    [
        lambda: mw.evaluate("planar/force", [[0, 0], [0, 1.2], [0.3, 0.1]], gradients=True),  # the second has no value
        lambda: mw.evaluate("uvms/valve", np.zeros((2, 4))),
        lambda: mw.evaluate("planar/force", np.zeros((0, 2))),
        lambda: mw.evaluate_joints("fixed/push", [[0, 0.3, 0, -1.5, 0, -0.6, 0]] * 2),
    ],
)
def test_evaluations(rows):
    rows = rows()
    loaded = again(rows)
    assert_equal(loaded, rows, ROWS)
    assert loaded.status == rows.status and loaded.task.digest == rows.task.digest and repr(loaded) == repr(rows)
    assert not loaded.beta.flags.writeable


def test_proofs(tmp_path):
    proof = mw.certify("planar/force")
    loaded = again(proof)
    names = ("status", "reason", "beta", "bound", "gap", "boxes", "colliding", "seconds")
    assert [getattr(loaded, name) for name in names] == [getattr(proof, name) for name in names]
    assert loaded.task.name == "planar/force" and repr(loaded) == repr(proof)
    assert_equal(loaded.answer, proof.answer, ("theta_r", "u", "h"))
    # Its certificate is there, and what is read by independent code.
    loaded.save(tmp_path / "a.cert")
    proof.save(tmp_path / "b.cert")
    assert (tmp_path / "a.cert").read_bytes() == (tmp_path / "b.cert").read_bytes()
    assert mw.verify(tmp_path / "a.cert")


def test_a_proof_as_a_dict():
    proof = mw.certify("planar/force")
    table = proof.to_dict()
    assert (table["problem"], table["status"], table["unit"]) == ("planar/force", "proven", "N")
    assert (table["beta"], table["bound"], table["gap"]) == (proof.beta, proof.bound, proof.gap)
    assert table["theta_r"] == proof.answer.theta_r.tolist()


@pytest.mark.parametrize("task, theta_r", [("planar/force", [0, 0]), ("planar/force", [0, 1.2]), ("planar/trajectory", [0, 0])])
def test_explanations(task, theta_r):
    explanation = mw.evaluate(task, theta_r).explain(share=0.5)
    loaded = again(explanation)
    assert loaded.summary() == explanation.summary() and loaded.to_dict() == explanation.to_dict()
    assert_equal(loaded, explanation, ("u",))


@pytest.mark.parametrize("task", ["planar/force", "planar/trajectory"])
def test_experiments(task):
    task = mw.load(task)
    answer = mw.evaluate(task, task.theta_r_default)
    options = {} if answer.t is not None else {"ramp": 0.5, "hold": 0.5}
    experiment = mw.simulate(answer, **options)
    loaded = again(experiment)
    assert_equal(loaded, experiment, SAMPLES)
    names = ("status", "reason", "reading", "planned", "held", "missed")
    assert [getattr(loaded, name) for name in names] == [getattr(experiment, name) for name in names]
    assert loaded.csv() == experiment.csv() and repr(loaded) == repr(experiment) and loaded.task.name == task.name


@pytest.mark.parametrize("directions", [IN_PLANE, np.eye(6)[:, 2:3], "force"], ids=["plane", "no end", "flat"])
def test_polytopes(directions):
    polytope = mw.polytope("planar/force", [0, 0], directions=directions)
    loaded = again(polytope)
    assert_equal(loaded, polytope, SETS)
    names = ("status", "reason", "dimension", "faces", "volume")
    assert [getattr(loaded, name) for name in names] == [getattr(polytope, name) for name in names]


def test_ellipsoids():
    ellipsoid = mw.ellipsoid("planar/force", [0, 0], directions=IN_PLANE)
    loaded = again(ellipsoid)
    assert_equal(loaded, ellipsoid, ("centre", "axes", "radii"))
    assert (loaded.status, loaded.reason, loaded.volume) == (ellipsoid.status, ellipsoid.reason, ellipsoid.volume)


def everything(value):
    """All that an object says: its attributes, with the bits of arrays, and the values of objects in it."""
    if isinstance(value, np.ndarray):
        return value.dtype, value.shape, value.tobytes()
    if isinstance(value, float):
        return np.float64(value).tobytes()  # NaN as well
    if isinstance(value, (list, tuple)):
        return [everything(item) for item in value]
    if isinstance(value, dict):
        return {key: everything(item) for key, item in value.items()}
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, mw.Task):
        return value.digest
    names = [name for name in dir(type(value)) if isinstance(getattr(type(value), name), property)]
    return {name: everything(getattr(value, name)) for name in names}


MOTION = {"t": [0, 1, 2], "shoulder": [-0.8, -0.7, -0.8], "elbow": [1, 0.9, 1]}


@functools.lru_cache
def results():
    force, motion = mw.load("planar/force"), mw.load("planar/trajectory")
    proof = mw.certify(force)
    moved = mw.certify(motion, motion.theta_r_default)
    return {
        "map": mw.map(force, {"azimuth": (0, 6, 3)}, budget=100, check=1.0),
        "front": mw.pareto("uvms/valve", "uvms/lift", points=3, budget=100),
        "sensitivity": mw.sensitivity(force, actuators="elbow", friction=1, budget=50),
        "loss": mw.sensitivity(force, actuators="elbow", friction=1, budget=50).losses[1],
        "margin": mw.margin(force, MOTION, ball=["fx", "fy"]),
        "proof": proof,
        "trajectory proof": moved,
        "linprog": mw.linprog([1, 2], [[1, 1]], [1]),
        "infeasible": mw.linprog([1], [[1]], [-1]),
        "capability": mw.capability(np.full((3, 6, 2), 0.5), np.zeros((3, 2)), [-2, -2], [2, 2], "x"),
        "one capability": mw.capability(np.zeros((6, 1)), [9.0], [-2.0], [2.0], "x"),
        "scale": mw.scale([[1, 1]], [-1, -1], [1, 1], [0], [4]),
        "limit": mw.evaluate(force, [0, 0]).explain().limits[0],
        "held": mw.solve_held(motion, simulations=2, budget=300),
        "experiment": mw.simulate(mw.evaluate(force, [0, 0]), ramp=0.5, hold=0.5),
        "polytope": mw.polytope(force, [0, 0], directions=IN_PLANE),
        "ellipsoid": mw.ellipsoid(force, [0, 0], directions=IN_PLANE),
        "evaluations": mw.evaluate(force, [[0, 0], [0, 1.2]]),
    }


def test_all_results_are_pickled_and_are_data(tmp_path):
    found = dict(results())
    found["proof"].save(tmp_path / "a.cert")
    found["trajectory proof"].save(tmp_path / "b.cert")
    found["verified"] = mw.verify(tmp_path / "a.cert")
    found["verified trajectory"] = mw.verify(tmp_path / "b.cert")
    assert found["one capability"].status == "infeasible" and found["infeasible"].certificate.size == 1
    for name, result in found.items():
        loaded = again(result)
        assert everything(loaded) == everything(result), name
        assert repr(loaded) == repr(result) and str(loaded) == str(result), name
        if hasattr(result, "__len__"):
            assert len(loaded) == len(result), name
        table = result.to_dict()
        assert table and loaded.to_dict() == table, name
        json.dumps(table, allow_nan=False)
        assert len(list(xml.fromstring(result._repr_html_()).iter("tr"))) > 1, name


def test_pictures_and_files_of_pickled_results(tmp_path):
    found = results()
    for name in ("map", "front", "margin"):
        assert again(found[name]).figure() == found[name].figure(), name
    for name in ("front", "margin"):
        assert again(found[name]).csv() == found[name].csv(), name
    again(found["trajectory proof"]).save(tmp_path / "b.cert")
    assert mw.verify(tmp_path / "b.cert")
    values = {name: found[name].to_dict() for name in ("linprog", "capability", "one capability")}
    assert values["linprog"]["objective"] == 2 and values["linprog"]["x"] == [0, 1]
    assert values["capability"]["beta"] == found["capability"].beta.tolist()
    assert values["one capability"]["beta"] is None  # NaN is no number of JSON


def work(i):
    task = mw.load("fixed/push")
    return mw.evaluate(task, np.linspace(-1, 1, 5 + i)[:, None])


def test_workers_return_evaluations():
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        for rows, expected in zip(pool.map_async(work, range(2)).get(60), map(work, range(2))):
            assert_equal(rows, expected, ROWS)


def test_a_worker_returns_all_results():
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        received = pool.apply_async(results).get(120)
    assert sorted(received) == sorted(results())
