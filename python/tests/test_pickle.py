"""Pickled results: what one wants back from another process, with the same bits."""

import multiprocessing
import pickle

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


def test_what_has_no_pickle_says_so():
    with pytest.raises(TypeError, match="LpAnswer") as caught:
        pickle.dumps(mw.linprog([1, 2], [[1, 1]], [1]))
    assert len(str(caught.value).splitlines()) == 1


def work(i):
    task = mw.load("fixed/push")
    return mw.evaluate(task, np.linspace(-1, 1, 5 + i)[:, None])


def test_workers_return_evaluations():
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        for rows, expected in zip(pool.map_async(work, range(2)).get(60), map(work, range(2))):
            assert_equal(rows, expected, ROWS)
