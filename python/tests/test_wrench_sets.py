"""Polytopes and ellipsoids of forces, against betas of the same posture and SciPy's hulls."""

import maxwrench as mw
import numpy as np
import pytest
from scipy.spatial import ConvexHull

TASK = mw.load("uvms/lift")


def posture():
    return mw.solve(TASK, search="sample", budget=200, seed=2).theta_r


def test_vertices_and_inequalities_describe_the_same_set():
    polytope = mw.polytope(TASK, posture())
    assert (polytope.status, polytope.dimension) == ("optimal", 3)
    slack = polytope.offsets - polytope.vertices @ polytope.normals.T
    size = np.abs(polytope.vertices).max()
    assert slack.min() > -1e-9 * size
    assert (np.sum(slack < 1e-9 * size, axis=1) >= 3).all()  # each vertex is on three facets or more
    hull = ConvexHull(polytope.vertices)
    assert len(hull.vertices) == len(polytope.vertices)
    assert polytope.volume == pytest.approx(hull.volume, rel=1e-9)
    assert polytope.triangles.max() < len(polytope.vertices) and len(polytope.faces) == len(polytope.offsets)


def test_each_vertex_is_exerted_by_its_efforts():
    theta_r = posture()
    polytope, answer = mw.polytope(TASK, theta_r), mw.evaluate(TASK, theta_r)
    force = np.vstack([polytope.vertices.T, np.zeros((3, len(polytope.vertices)))])
    balance = TASK.robot.B @ polytope.efforts.T - answer.J.T @ force - answer.tau_d[:, None]
    assert np.abs(balance).max() < 1e-8
    assert (polytope.efforts >= TASK.robot.u_min - 1e-9).all() and (polytope.efforts <= TASK.robot.u_max + 1e-9).all()


@pytest.mark.parametrize("measure", ["linf_polytope", "l2_polytope"])
def test_the_extent_along_c_is_beta(measure):
    theta_r = posture()
    polytope = mw.polytope(TASK, theta_r, measure=measure)
    along = polytope.normals @ TASK.c[:3]
    reach = min(polytope.offsets[along > 1e-12] / along[along > 1e-12])
    assert reach == pytest.approx(mw.evaluate(TASK, theta_r, measure=measure).beta, rel=1e-9)


def test_the_support_along_c_of_any_wrenches_is_beta():
    theta_r = posture()
    polytope = mw.polytope(TASK, theta_r, wrench="any")
    support = (polytope.vertices @ TASK.c[:3]).max()
    assert support == pytest.approx(mw.evaluate(TASK, theta_r, wrench="any").beta, rel=1e-8)


def test_the_ellipsoid_along_c_is_beta():
    theta_r = posture()
    ellipsoid = mw.ellipsoid(TASK, theta_r)
    c = ellipsoid.axes.T @ TASK.c[:3] / ellipsoid.radii
    centre = ellipsoid.axes.T @ ellipsoid.centre / ellipsoid.radii
    # |x c - centre| = 1
    a, b, d = c @ c, -2 * c @ centre, centre @ centre - 1
    root = (-b + np.sqrt(b * b - 4 * a * d)) / (2 * a)
    assert root == pytest.approx(mw.evaluate(TASK, theta_r, measure="ellipsoid").beta, rel=1e-9)


def test_directions_and_answers():
    answer = mw.solve("planar/force", budget=100)
    plane = np.eye(6)[:, :2]
    flat = mw.polytope(answer, directions=plane)
    assert flat.dimension == 2 and flat.vertices.shape[1] == 2 and flat.volume > 0
    assert mw.polytope(answer).status == "unbounded"  # the plane bears any force across it
    torque = mw.polytope("uvms/valve", mw.solve("uvms/valve", budget=2000).theta_r, directions="torque")
    assert torque.status == "optimal"


def test_bad_arguments(rejects):
    assert rejects(mw.polytope, "planar/force", [0, 0], directions="lift").key == "directions"
    rejects(mw.polytope, "planar/force", [0, 0], directions=np.zeros((6, 2)))
    rejects(mw.polytope, "planar/force", [0, 0], directions=np.eye(6))
    rejects(mw.polytope, "planar/force", [0, 0], measure="ellipsoid")
    rejects(mw.polytope, "planar/force", None)
    assert rejects(mw.polytope, "planar/trajectory", [0, 0]).key == "task"
