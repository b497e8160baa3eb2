"""Capabilities of arrays against HiGHS, closed forms and finite differences."""

import maxwrench as mw
import numpy as np
import pytest
from scipy.optimize import linprog


def highs(J, tau_d, lower, upper, c, B=None, free=None):
    """The status and value of max c'h subject to B u - J'h = tau_d, lower <= u <= upper, h = c x + free y."""
    n = J.shape[1]
    B = np.eye(n) if B is None else B
    W = np.column_stack([c / np.linalg.norm(c)] + ([] if free is None else [free]))
    objective = np.concatenate([np.zeros(B.shape[1]), -W.T @ (c / np.linalg.norm(c))])
    bounds = list(zip(lower, upper)) + [(None, None)] * W.shape[1]
    found = linprog(objective, A_eq=np.hstack([B, -J.T @ W]), b_eq=tau_d, bounds=bounds, method="highs")
    return {0: "optimal", 2: "infeasible", 3: "unbounded"}[found.status], -found.fun if found.status == 0 else np.nan


def random_program(rng, n, m):
    """J, tau_d, lower, upper, c, B of a program that has a value."""
    J = rng.normal(size=(6, n))
    B = rng.normal(size=(n, m)) if m != n else np.diag(rng.uniform(0.5, 2, n))
    lower, upper = -rng.uniform(1, 5, m), rng.uniform(1, 5, m)
    tau_d = B @ rng.uniform(0.3 * lower, 0.3 * upper)
    return J, tau_d, lower, upper, rng.normal(size=6), B


@pytest.mark.parametrize(
    "solver, columns",  # facets serves one column of the wrench
    [(solver, columns) for solver in mw.solvers() for columns in (0, 1, 3, 5) if solver != "facets" or columns == 0],
)
def test_random_programs(solver, columns):
    rng = np.random.default_rng(10 + columns)
    for n, m in [(6, 6), (7, 7), (8, 10), (5, 9), (10, 12), (3, 3)]:
        J, tau_d, lower, upper, c, B = random_program(rng, n, m)
        free = rng.normal(size=(6, columns)) if columns else None
        status, beta = highs(J, tau_d, lower, upper, c, B, free)
        mine = mw.capability(J, tau_d, lower, upper, c, B, free=free, solver=solver)
        assert mine.status == status, (n, m)
        if status != "optimal":
            assert np.isnan(mine.beta) and mine.reason
            continue
        # Ipopt is an interior point method, the others end at a vertex.
        assert mine.beta == pytest.approx(beta, rel=1e-6 if solver == "ipopt" else 1e-9)
        slack = 1e-6 if solver == "ipopt" else 1e-8
        assert np.abs(B @ mine.u - J.T @ mine.h - tau_d).max() < slack * (1 + abs(beta))
        assert np.all(mine.u >= lower - slack) and np.all(mine.u <= upper + slack)
        assert c @ mine.h / np.linalg.norm(c) == pytest.approx(mine.beta, rel=1e-6)
        # h lies in the span of c and the free columns.
        span = np.column_stack([c] + ([free] if columns else []))
        rest = mine.h - span @ np.linalg.lstsq(span, mine.h, rcond=None)[0]
        assert np.abs(rest).max() < 1e-8 * (1 + np.abs(mine.h).max())


def test_multipliers_are_derivatives_by_tau_d():
    rng = np.random.default_rng(3)
    for columns in (0, 2):
        J, tau_d, lower, upper, c, B = random_program(rng, 7, 9)
        free = rng.normal(size=(6, columns)) if columns else None

        def value(tau):
            return mw.capability(J, tau, lower, upper, c, B, free=free).beta

        lambda_ = mw.capability(J, tau_d, lower, upper, c, B, free=free).lambda_
        step = 1e-5
        for i, direction in enumerate(np.eye(7)):
            slope = (value(tau_d + step * direction) - value(tau_d - step * direction)) / (2 * step)
            assert lambda_[i] == pytest.approx(slope, abs=1e-7)


def test_gravity_that_efforts_cannot_balance_is_infeasible():
    # u_1 = 5 + h J_11 with J = 0: no wrench relieves the joint.
    mine = mw.capability(np.zeros((6, 2)), [5, 0], [-1, -1], [1, 1], "x")
    assert (mine.status, mine.reason != "") == ("infeasible", True)
    for array in (mine.beta, mine.h, mine.u, mine.lambda_):
        assert np.all(np.isnan(array))


def test_wrench_that_loads_no_actuator_is_unbounded():
    assert mw.capability(np.zeros((6, 2)), [0.5, 0], [-1, -1], [1, 1], "z").status == "unbounded"
    # A joint whose upper limit is infinite, pushed that way: u = 0.5 h grows with h.
    J = np.zeros((6, 1))
    J[0, 0] = 0.5
    assert mw.capability(J, [0], [-1], [np.inf], "x").status == "unbounded"
    assert mw.capability(J, [0], [-1], [np.inf], "-x").beta == pytest.approx(2)


def test_wrench_may_be_needed_to_hold_the_posture():
    # u = 3 - h <= 1 requires h >= 2, and u >= -1 allows h <= 4 along x; along -x the best is h = -2.
    J = np.zeros((6, 1))
    J[0, 0] = -1
    assert mw.capability(J, [3], [-1], [1], "x").beta == pytest.approx(4)
    assert mw.capability(J, [3], [-1], [1], "-x").beta == pytest.approx(-2)


@pytest.mark.parametrize("c, unit", [("x", 0), ("y", 1), ("z", 2), ("rx", 3), ("ry", 4), ("rz", 5)])
def test_directions_by_name(c, unit):
    # One joint of lever 0.5 along that axis and limits -1 and 3: 3 / 0.5 forwards, 1 / 0.5 backwards.
    J = np.zeros((6, 1))
    J[unit, 0] = 0.5
    assert mw.capability(J, [0], [-1], [3], c).beta == 6
    assert mw.capability(J, [0], [-1], [3], "+" + c).beta == 6
    assert mw.capability(J, [0], [-1], [3], "-" + c).beta == 2
    assert mw.capability(J, [0], [-1], [3], 7 * np.eye(6)[unit]).beta == 6


@pytest.mark.parametrize("threads", [1, 2, 8])
def test_leading_axes(threads):
    rng = np.random.default_rng(4)
    J, tau_d = rng.normal(size=(2, 3, 6, 7)), rng.normal(size=(2, 3, 7))
    tau_d[1, 1] = 100  # infeasible for limits of 5 along a single direction
    lower, upper = -np.full(7, 5.0), np.full(7, 5.0)
    all_of_them = mw.capability(J, tau_d, lower, upper, "z", threads=threads)
    assert all_of_them.beta.shape == all_of_them.status.shape == all_of_them.reason.shape == (2, 3)
    assert all_of_them.h.shape == (2, 3, 6)
    assert all_of_them.u.shape == all_of_them.lambda_.shape == (2, 3, 7)
    for i, j in np.ndindex(2, 3):
        one = mw.capability(J[i, j], tau_d[i, j], lower, upper, "z")
        assert one.status == all_of_them.status[i, j] == highs(J[i, j], tau_d[i, j], lower, upper, np.eye(6)[2])[0]
        for name in ("beta", "h", "u", "lambda_"):
            assert np.array_equal(getattr(one, name), getattr(all_of_them, name)[i, j], equal_nan=True), name
    assert all_of_them.status[1, 1] == "infeasible" and np.isnan(all_of_them.beta[1, 1])


@pytest.mark.parametrize("leading", [((), (4,)), ((4,), ()), ((3, 1), (4,)), ((1, 4), (3, 4)), ((0,), ())])
def test_leading_axes_are_broadcast_as_numpy_does(leading):
    rng = np.random.default_rng(5)
    J, tau_d = rng.normal(size=leading[0] + (6, 7)), rng.normal(size=leading[1] + (7,))
    lower, upper = -np.full(7, 5.0), np.full(7, 5.0)
    mine = mw.capability(J, tau_d, lower, upper, "z")
    shape = np.broadcast_shapes(*leading)
    assert mine.beta.shape == shape
    all_J, all_tau_d = np.broadcast_to(J, shape + (6, 7)), np.broadcast_to(tau_d, shape + (7,))
    for i in np.ndindex(shape):
        assert mine.beta[i] == mw.capability(all_J[i], all_tau_d[i], lower, upper, "z").beta


def test_leading_axes_that_do_not_fit(rejects):
    error = rejects(mw.capability, np.zeros((2, 6, 7)), np.zeros((3, 7)), -np.ones(7), np.ones(7), "z")
    assert str(error) == "tau_d: got shape (3, 7), expected an array of shape (..., 7) whose leading axes fit those of J, (2, 6, 7)"


def test_many_rows_are_each_solved():
    # More rows than one chunk of work: all values against the closed form of one joint, (5 - tau_d) / J_x.
    levers = np.linspace(0.1, 2, 1000)
    J = np.zeros((1000, 6, 1))
    J[:, 0, 0] = levers
    tau_d = np.linspace(-4, 4, 1000)[:, None]
    mine = mw.capability(J, tau_d, [-5], [5], "x")
    np.testing.assert_allclose(mine.beta, (5 - tau_d[:, 0]) / levers, rtol=1e-12)


def test_no_rows():
    none = mw.capability(np.zeros((0, 6, 7)), np.zeros((0, 7)), -np.ones(7), np.ones(7), "x")
    assert none.beta.shape == (0,) and none.h.shape == (0, 6) and none.u.shape == (0, 7)
    assert none.status.shape == none.reason.shape == (0,)
    assert none.status.dtype.kind == none.reason.dtype.kind == "U"  # texts, as with rows


def test_a_nan_has_no_value():
    J, tau_d = np.ones((3, 6, 2)), np.zeros((3, 2))
    J[1, 0, 0] = np.nan
    tau_d[2, 1] = np.inf
    mine = mw.capability(J, tau_d, [-1, -1], [1, 1], "x")
    assert mine.status.tolist() == ["optimal", "numerical_error", "numerical_error"]
    assert np.isnan(mine.beta).tolist() == [False, True, True]
    assert mine.beta[0] == 1  # u = J_x h, both levers 1 and both limits 1


def test_ellipsoid_is_the_root_of_its_quadratic():
    # |W (tau_d + J'c beta)| = 1 with u = B^+ tau and W = diag(1 / smaller limit): with a = W B^+ J'c and
    # g = W B^+ tau_d the largest beta is the larger root of (a'a) beta^2 + 2 (a'g) beta + g'g - 1 = 0.
    rng = np.random.default_rng(5)
    for n, m in [(6, 6), (7, 9), (5, 8)]:
        J, tau_d, lower, upper, c, B = random_program(rng, n, m)
        tau_d /= 4
        weighted = np.diag(1 / np.minimum(-lower, upper)) @ np.linalg.pinv(B)
        a, g = weighted @ J.T @ (c / np.linalg.norm(c)), weighted @ tau_d
        root = np.roots([a @ a, 2 * a @ g, g @ g - 1]).max()
        assert mw.capability(J, tau_d, lower, upper, c, B, measure="ellipsoid").beta == pytest.approx(root, rel=1e-10)
        # Outside of it the posture alone takes more than the ellipsoid has.
        outside = tau_d / (g @ g) ** 0.5 * 1.01
        assert mw.capability(J, outside, lower, upper, c, B, measure="ellipsoid").status == "infeasible"


def test_ellipsoid_with_free_columns():
    # All wrenches free and J square: h = J'^-1 (u - tau_d) with |W u| <= 1, so the largest c'h is that of a
    # sphere through the linear map c'J'^-1 W^-1: its norm, minus c'J'^-1 tau_d.
    rng = np.random.default_rng(6)
    J, tau_d, lower, upper, c, _ = random_program(rng, 6, 6)
    tau_d = tau_d / 4
    c /= np.linalg.norm(c)
    others = np.linalg.qr(np.column_stack([c, rng.normal(size=(6, 5))]))[0][:, 1:]
    row = np.linalg.solve(J, c)  # c'J'^-1
    expected = np.linalg.norm(row * np.minimum(-lower, upper)) - row @ tau_d
    mine = mw.capability(J, tau_d, lower, upper, c, free=others, measure="ellipsoid")
    assert mine.beta == pytest.approx(expected, rel=1e-9)


def test_l2_polytope_is_an_interval():
    # u = B^+ (tau_d + J'c beta) within its limits: each actuator gives beta an interval, their meet ends at beta.
    rng = np.random.default_rng(7)
    for n, m in [(6, 6), (7, 10), (5, 8)]:
        J, tau_d, lower, upper, c, B = random_program(rng, n, m)
        pinv = np.linalg.pinv(B)
        a, g = pinv @ J.T @ (c / np.linalg.norm(c)), pinv @ tau_d
        expected = np.where(a > 0, (upper - g) / a, (lower - g) / a).min()
        mine = mw.capability(J, tau_d, lower, upper, c, B, measure="l2_polytope")
        assert mine.beta == pytest.approx(expected, rel=1e-10)
        np.testing.assert_allclose(mine.u, a * expected + g, rtol=1e-8, atol=1e-9)
        assert mine.beta <= mw.capability(J, tau_d, lower, upper, c, B).beta + 1e-9


def test_results_are_read_only_and_outlive_their_object():
    J = np.ones((4, 6, 2))
    mine = mw.capability(J, np.zeros((4, 2)), [-1, -1], [1, 1], "x")
    u = mine.u
    for array in (mine.beta, mine.h, u, mine.lambda_):
        assert not array.flags.writeable and array.dtype == np.float64
    kept = u.copy()
    del mine
    assert np.array_equal(u, kept)


def test_scale_against_highs():
    rng = np.random.default_rng(8)
    for _ in range(20):
        n, m = 6, 8
        B = rng.normal(size=(n, m))
        lower, upper = -rng.uniform(1, 5, m), rng.uniform(1, 5, m)
        tau_d, w = B @ rng.uniform(0.3 * lower, 0.3 * upper), rng.normal(size=n)
        found = linprog(
            np.append(np.zeros(m), -1),
            A_eq=np.column_stack([B, -w]),
            b_eq=tau_d,
            bounds=[*zip(lower, upper), (None, None)],
            method="highs",
        )
        mine = mw.scale(B, lower, upper, tau_d, w)
        assert mine.status == "optimal" and mine.beta == pytest.approx(-found.fun, rel=1e-9)
        assert np.abs(B @ mine.u - tau_d - mine.beta * w).max() < 1e-8 * (1 + abs(mine.beta))
        assert np.all(mine.u >= lower - 1e-8) and np.all(mine.u <= upper + 1e-8)
        assert np.all(np.isnan(mine.h))  # there is no wrench
        step = 1e-5
        for i, direction in enumerate(np.eye(n)):
            high, low = (mw.scale(B, lower, upper, tau_d + s * step * direction, w).beta for s in (1, -1))
            assert mine.lambda_[i] == pytest.approx((high - low) / (2 * step), abs=1e-6)


def test_scale_without_a_value():
    assert mw.scale(None, [-1, -1], [1, 1], [0, 5], [1, 0]).status == "infeasible"
    assert mw.scale(None, [-1, -1], [1, 1], [0, 0], [0, 0]).status == "unbounded"
    assert mw.scale(None, [-1], [np.inf], [0], [1]).status == "unbounded"
    # No actuator reaches the second coordinate, which the demand needs: only s = 0 is left.
    assert mw.scale([[1], [0]], [-1], [1], [0, 0], [1, 1]).beta == 0


def test_scale_of_more_limits_than_are_kept():
    # Eight sets of actuators are kept; with ten of them in turn each still has its own value, upper / w.
    for _ in range(3):
        for limit in range(1, 11):
            assert mw.scale(None, [-1], [limit], [0], [2]).beta == limit / 2


def test_other_measures():
    rng = np.random.default_rng(9)
    J, tau_d, lower, upper, c, _ = random_program(rng, 7, 7)
    unit = c / np.linalg.norm(c)

    def value(measure):
        return mw.capability(J, tau_d, lower, upper, c, measure=measure).beta

    # The extent of {|J'h| <= 1} along c: 1 / |J'c|, and with efforts weighted by their limits.
    assert value("transmission_ratio") == pytest.approx(1 / np.linalg.norm(J.T @ unit), rel=1e-10)
    weights = 1 / np.minimum(-lower, upper)
    weighted = 1 / np.linalg.norm(weights * (J.T @ unit))
    assert value("weighted_transmission_ratio") == pytest.approx(weighted, rel=1e-10)
    # Minus the sum of squared efforts u = tau_d + J'c at the reference of 1.
    assert value("least_effort") == pytest.approx(-np.sum((tau_d + J.T @ unit) ** 2), rel=1e-10)
    # With one direct drive for each joint the efforts are unique, so the first that saturates ends linf_polytope.
    assert value("saturating_wrench") == pytest.approx(value("linf_polytope"), rel=1e-10)


def test_measures_of_more_actuators_than_joints():
    rng = np.random.default_rng(3)
    J, B = rng.normal(size=(6, 10)), rng.normal(size=(10, 12))
    limits = np.full(12, 5.0)
    values = {
        measure: mw.capability(J, np.zeros(10), -limits, limits, "z", B, measure=measure).beta
        for measure in ("linf_polytope", "l2_polytope", "saturating_wrench", "ellipsoid")
    }
    # At equal limits and without a load, the actuator that saturates first limits the least-squares efforts.
    assert values["saturating_wrench"] == pytest.approx(values["l2_polytope"], rel=1e-9)
    assert 0 < values["ellipsoid"] <= values["l2_polytope"] <= values["linf_polytope"]


def test_manipulability_is_that_of_all_rows():
    # measures() says: Yoshikawa's sqrt det(J J'). It does not depend on c or the limits.
    J = np.random.default_rng(11).normal(size=(6, 7))
    for c in ("x", "rz"):
        mine = mw.capability(J, np.zeros(7), -np.ones(7), np.ones(7), c, measure="manipulability")
        assert mine.beta == pytest.approx(np.linalg.det(J @ J.T) ** 0.5, rel=1e-10)


@pytest.mark.parametrize("measure", ["dynamic_manipulability", "dynamic_capability"])
def test_accelerations_need_masses(measure):
    with pytest.raises(mw.InputError, match=f"measure: got '{measure}', expected one of J and tau_d alone"):
        mw.capability(np.eye(6), np.zeros(6), -np.ones(6), np.ones(6), "x", measure=measure)
    answer = mw.evaluate("uvms/valve", [3, 1.2, 1.1, 0.4], measure=measure)
    assert answer.unit == "rad/s^2" and answer.h is None and answer.u.shape == answer.task.robot.u_max.shape
    # As beta is no wrench, the efforts are those of the acceleration, not B u = tau_d.
    assert np.abs(answer.task.robot.B @ answer.u - answer.tau_d).max() > 0.1
