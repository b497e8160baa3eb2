"""Evaluations: many postures against one by one, gradients against differences, and the balance."""

import gc

import maxwrench as mw
import numpy as np
import pytest

STATIC = [name for name in mw.tasks() if mw.load(name).type == "static"]
ONE_CONTACT = [name for name in STATIC if not name.startswith("dual_arm") and "two_arms" not in name]
IN_TIME = [name for name in mw.tasks() if mw.load(name).type != "static"]


def postures(task, count, seed=1, part=0.3):
    """Random theta_r near the default, some of them without a value."""
    rng = np.random.default_rng(seed)
    span = part * (task.theta_r_max - task.theta_r_min)
    return task.theta_r_default + rng.uniform(-span, span, (count, span.size))


@pytest.mark.parametrize("name", STATIC)
@pytest.mark.parametrize("wrench", ["pure", "any"])
def test_rows_are_single_calls_bit_for_bit(name, wrench):
    task = mw.load(name)
    theta_r = postures(task, 60, part=0.02 if name == "dual_arm/two_arms" else 0.3)
    rows = mw.evaluate(task, theta_r, wrench=wrench, gradients=True, threads=2)
    assert len(rows) == 60 and rows.beta.shape == (60,) and rows.valid.any()
    for i, row in enumerate(theta_r):
        one = mw.evaluate(task, row, wrench=wrench)
        assert rows.status[i] == one.status and rows.valid[i] == one.has_value
        if not one.has_value:
            for array in (rows.beta[i], rows.u[i], rows.h[i], rows.gradient[i]):
                assert np.all(np.isnan(array))
            continue
        assert rows.beta[i] == one.beta
        assert np.array_equal(rows.u[i], one.u) and np.array_equal(rows.h[i], one.h)
        assert np.array_equal(rows.q[i], one.q) and np.array_equal(rows.base[i], one.theta[:6])
        assert np.array_equal(rows.gradient[i], one.gradient)


@pytest.mark.parametrize("solver", [name for name in mw.solvers() if name != "facets"])
def test_rows_are_single_calls_with_every_solver(solver):
    # Solvers of linear programs start where they ended; the row before must not show.
    task = mw.load("uvms/valve")
    theta_r = postures(task, 70)
    rows = mw.evaluate(task, theta_r, wrench="any", solver=solver)
    for i in np.flatnonzero(rows.valid):
        one = mw.evaluate(task, theta_r[i], wrench="any", solver=solver)
        assert rows.beta[i] == one.beta and np.array_equal(rows.u[i], one.u) and np.array_equal(rows.h[i], one.h)


def test_rows_have_gradients_on_request():
    assert mw.evaluate("planar/force", [[0, 0]]).gradient is None
    assert mw.evaluate("planar/force", [[0, 0]], gradients=True).gradient.shape == (1, 2)


@pytest.mark.parametrize("name, wrench", [("fixed/push", "pure"), ("fixed/push", "any"), ("uvms/lift", "any")])
def test_rows_of_joints_are_single_calls_bit_for_bit(name, wrench):
    task = mw.load(name)
    robot = task.robot
    span = np.minimum(robot.q_max, 3) - np.maximum(robot.q_min, -3)
    q = np.maximum(robot.q_min, -3) + np.random.default_rng(7).uniform(-0.02, 1, (60, span.size)) * span
    rows = mw.evaluate_joints(task, q, wrench=wrench)
    assert len(rows) == 60 and rows.gradient is None and rows.valid.any() and not rows.valid.all()
    for i, row in enumerate(q):
        one = mw.evaluate_joints(task, row, wrench=wrench)
        assert rows.status[i] == one.status and np.array_equal(rows.q[i], row)
        assert np.array_equal(rows.base[i], one.theta[:6])
        if not one.has_value:
            assert np.isnan(rows.beta[i]) and np.all(np.isnan(rows.u[i])) and np.all(np.isnan(rows.h[i]))
            continue
        assert rows.beta[i] == one.beta and np.array_equal(rows.u[i], one.u) and np.array_equal(rows.h[i], one.h)
    one_thread = mw.evaluate_joints(task, q, wrench=wrench, threads=1)
    assert np.array_equal(one_thread.beta, rows.beta, equal_nan=True)


def test_no_rows_of_joints():
    rows = mw.evaluate_joints("fixed/push", np.zeros((0, 7)))
    assert len(rows) == 0 and rows.u.shape == (0, 7)


@pytest.mark.parametrize("measure", list(mw.measures()))
def test_rows_of_all_measures(measure):
    task = mw.load("uvms/valve")
    theta_r = postures(task, 20)
    rows = mw.evaluate(task, theta_r, measure=measure)
    single = [mw.evaluate(task, row, measure=measure) for row in theta_r]
    assert np.array_equal(rows.beta, [one.beta for one in single], equal_nan=True) and rows.valid.any()
    assert list(rows.status) == [one.status for one in single]


@pytest.mark.parametrize("name", ["mobile/push_any_height", "fixed/push", "uvms/lift"])
def test_threads_do_not_change_values(name):
    task = mw.load(name)
    theta_r = postures(task, 300)
    reference = mw.evaluate(task, theta_r, wrench="any", gradients=True, threads=1)
    for threads in (0, 2, 3, 8):
        rows = mw.evaluate(task, theta_r, wrench="any", gradients=True, threads=threads)
        for name in ("beta", "gradient", "q", "base", "u", "h"):
            assert np.array_equal(getattr(rows, name), getattr(reference, name), equal_nan=True), name
        assert rows.status == reference.status


def test_no_rows():
    rows = mw.evaluate("planar/force", np.zeros((0, 2)), gradients=True)
    assert len(rows) == 0 and rows.beta.shape == (0,) and rows.u.shape == (0, 6) and rows.gradient.shape == (0, 2)
    assert rows.valid.shape == (0,) and rows.status == []


@pytest.mark.parametrize("name", STATIC)
@pytest.mark.parametrize("wrench", ["pure", "any"])
def test_gradient_is_the_derivative(name, wrench):
    # The value is smooth except where the binding limits change: there the differences to both sides disagree.
    task = mw.load(name)
    step, compared = 1e-6, 0
    for theta_r in postures(task, 8, seed=2, part=0.1):
        answer = mw.evaluate(task, theta_r, wrench=wrench, check_collision=False)
        if not answer.has_value:
            continue
        for i, direction in enumerate(np.eye(theta_r.size)):
            at = theta_r + step * direction * np.array([[1], [-1]])
            up, down = mw.evaluate(task, at, wrench=wrench, check_collision=False).beta - answer.beta
            if not abs(up + down) < 1e-4 * step * (1 + abs(answer.beta)):
                continue
            scale = 1 + abs(answer.gradient[i]) + abs(answer.beta)
            assert answer.gradient[i] == pytest.approx((up - down) / (2 * step), abs=2e-4 * scale)
            compared += 1
    assert compared >= 6


@pytest.mark.parametrize("name", IN_TIME)
def test_gradient_of_a_trajectory(name):
    task = mw.load(name)
    knots = np.tile(task.theta_r_default, (task.knots, 1))
    answer = mw.evaluate(task, knots, check_collision=False)
    assert answer.gradient.shape == knots.shape
    if task.type == "impulse":
        return  # its start forbids to move single knots; the shape is all there is to compare
    rng = np.random.default_rng(3)
    step, compared = 1e-6, 0
    for _ in range(6):
        direction = rng.normal(size=knots.shape)
        up, down = (
            mw.evaluate(task, knots + s * step * direction, check_collision=False).beta - answer.beta for s in (1, -1)
        )
        if not abs(up + down) < 1e-2 * abs(up - down):
            continue  # another instant or limit binds on one side
        slope = np.sum(answer.gradient * direction)
        assert slope == pytest.approx((up - down) / (2 * step), rel=1e-3, abs=1e-3 * (1 + abs(answer.beta)))
        compared += 1
    assert compared >= 1


@pytest.mark.parametrize("name", ONE_CONTACT)
@pytest.mark.parametrize(
    "measure, wrench", [("linf_polytope", "pure"), ("linf_polytope", "any"), ("l2_polytope", "pure")]
)
def test_efforts_balance_the_wrench(name, measure, wrench):
    task = mw.load(name)
    robot = task.robot
    for theta_r in postures(task, 20, seed=4):
        answer = mw.evaluate(task, theta_r, measure=measure, wrench=wrench)
        if not answer.has_value:
            assert answer.reason and answer.u is None and answer.h is None
            continue
        scale = 1 + abs(answer.beta)
        assert np.abs(robot.B @ answer.u - answer.J.T @ answer.h - answer.tau_d).max() < 1e-8 * scale
        assert np.all(answer.u >= robot.u_min - 1e-8) and np.all(answer.u <= robot.u_max + 1e-8)
        assert task.c @ answer.h == pytest.approx(answer.beta, abs=1e-8 * scale)
        basis = task.c[:, None] if wrench == "pure" else task.W_any
        assert np.abs(answer.h - basis @ (basis.T @ answer.h)).max() < 1e-8 * scale
        assert np.all(answer.q >= robot.q_min - 1e-12) and np.all(answer.q <= robot.q_max + 1e-12)


@pytest.mark.parametrize("name", IN_TIME)
def test_efforts_balance_at_each_instant(name):
    task = mw.load(name)
    robot = task.robot
    answer = mw.evaluate(task, task.theta_r_default)
    assert np.all(answer.u >= robot.u_min - 1e-6) and np.all(answer.u <= robot.u_max + 1e-6)
    assert answer.betas.shape == answer.t.shape
    # J is not among the arrays of a task in time: the work of the efforts replaces it. With the twist V = J v
    # of the path, v'(B u - tau_d) = V'h; a fixed end effector takes no power.
    power = np.einsum("ij,ij->i", answer.velocity, answer.u @ robot.B.T - answer.tau_d)
    if task.type == "impulse":
        assert np.abs(power).max() < 1e-6 * (1 + np.abs(answer.u).max())
        assert answer.betas.max() == pytest.approx(answer.beta, rel=1e-6)
    else:
        assert answer.betas.min() == pytest.approx(answer.beta, rel=1e-6)
    # The wrench is a multiple of c, which may turn.
    assert np.linalg.norm(answer.h, axis=1) == pytest.approx(np.abs(answer.betas), rel=1e-9, abs=1e-9)


def test_multiplier_is_a_derivative():
    # lambda is d beta / d tau_d: the capability of the same arrays gives it by differences.
    task = mw.load("uvms/valve")
    answer = mw.evaluate(task, task.theta_r_default + [0.1, -0.1, 0.2, 0.1], check_collision=False)
    robot = task.robot

    def beta(tau_d):
        return mw.capability(answer.J, tau_d, robot.u_min, robot.u_max, task.c, robot.B).beta

    assert beta(answer.tau_d) == pytest.approx(answer.beta, rel=1e-12)
    step = 1e-6
    slopes = [(beta(answer.tau_d + step * e) - beta(answer.tau_d - step * e)) / (2 * step) for e in np.eye(10)]
    np.testing.assert_allclose(answer.lambda_, slopes, atol=1e-7)


def test_other_wrenches_cannot_make_it_worse():
    for name in STATIC:
        task = mw.load(name)
        theta_r = postures(task, 30, seed=5)
        pure, free = (mw.evaluate(task, theta_r, wrench=wrench).beta for wrench in ("pure", "any"))
        both = np.isfinite(pure)
        assert both.any() and np.all(free[both] >= pure[both] - 1e-7 * (1 + np.abs(pure[both]))), name


def test_a_constant_posture_of_a_task_in_time():
    task = mw.load("planar/trajectory")
    assert mw.evaluate(task, [0.1, -0.1]).beta == mw.evaluate(task, np.tile([0.1, -0.1], (8, 1))).beta


def test_collisions_count_unless_they_are_ignored():
    task = mw.load("planar/two_arms")
    theta_r = postures(task, 400, seed=6, part=0.5)
    checked, ignored = mw.evaluate(task, theta_r), mw.evaluate(task, theta_r, check_collision=False)
    assert np.all(ignored.valid[checked.valid]) and ignored.valid.sum() > checked.valid.sum()
    worse = np.flatnonzero(ignored.valid & ~checked.valid)[0]
    assert "collision" in mw.evaluate(task, theta_r[worse]).reason


@pytest.mark.parametrize("name", ["beta", "gradient", "q", "base", "u", "h"])
def test_views_are_read_only_and_keep_their_numbers(name):
    rows = mw.evaluate("planar/force", [[0, 0], [0.1, 0.2]], gradients=True)
    view = getattr(rows, name)
    assert view.dtype == np.float64 and view.flags.c_contiguous
    with pytest.raises(ValueError):
        view[...] = 0
    with pytest.raises(ValueError):
        view.flags.writeable = True
    assert np.shares_memory(view, getattr(rows, name))  # a view, not a copy
    kept = view.copy()
    del rows
    gc.collect()
    mw.evaluate("planar/force", np.ones((100, 2)))
    assert np.array_equal(view, kept)


def test_arguments_are_not_changed():
    theta_r = np.array([[0.1, 0.2], [0.3, 0.4]])
    before = theta_r.copy()
    mw.evaluate("planar/force", theta_r)
    assert np.array_equal(theta_r, before) and theta_r.flags.writeable


def test_solve_finds_at_least_what_it_starts_from():
    answer = mw.solve("planar/force", seed=3, budget=400)
    grid = np.stack(np.meshgrid(*[np.linspace(-1.04, 1.04, 21)] * 2), -1).reshape(-1, 2)
    assert answer.beta >= np.nanmax(mw.evaluate("planar/force", grid).beta)
    again = mw.evaluate("planar/force", answer.theta_r)
    assert again.beta == answer.beta and np.array_equal(again.u, answer.u)
    assert answer.evaluations <= 400 and answer.budget == 400 and answer.seed == 3
    assert mw.solve("planar/force", seed=3, budget=400).theta_r.tolist() == answer.theta_r.tolist()
