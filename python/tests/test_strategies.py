"""Measures and searches written in Python, by their names in solve and evaluate."""

import re
import time

import maxwrench as mw
import numpy as np
import pytest
from scipy.optimize import differential_evolution


class Ease(mw.Measure):
    """Minus the squared load at rest."""

    name, unit = "ease", "N^2 m^2"

    def value(self, posture):
        return -posture.tau_d @ posture.tau_d

    def derivatives(self, posture):
        return -2 * posture.tau_d, np.zeros_like(posture.J)


class EaseByValue(mw.Measure):
    name, unit = "ease_by_value", "N^2 m^2"

    def value(self, posture):
        return -posture.tau_d @ posture.tau_d


class Ray(mw.Measure):
    """The polytope along c, by SciPy: max x with B u - J'c x = tau_d."""

    name = "ray"

    def value(self, posture):
        from scipy.optimize import linprog

        a = np.column_stack([posture.B, -posture.J.T @ posture.c])
        bounds = [*zip(posture.u_min, posture.u_max), (None, None)]
        result = linprog(np.eye(a.shape[1])[-1] * -1, A_eq=a, b_eq=posture.tau_d, bounds=bounds)
        return result.x[-1] if result.status == 0 else np.nan


class Sample(mw.Search):
    name, accepts_starts = "random_points", True

    def maximize(self, objective):
        random = np.random.default_rng(objective.seed)
        shape = objective.left, objective.dimension
        objective.values(random.uniform(objective.lower, objective.upper, shape))


class Evolution(mw.Search):
    name = "scipy_de"

    def maximize(self, objective):
        bounds = np.stack([objective.lower, objective.upper], axis=1)
        differential_evolution(lambda x: -max(objective(x), -1e9), bounds, seed=objective.seed, maxiter=10**6)


@pytest.fixture(autouse=True)
def added():
    for measure in (Ease(), EaseByValue(), Ray()):
        mw.add_measure(measure)
    for search in (Sample(), Evolution()):
        mw.add_search(search)


def test_a_measure_has_exact_and_difference_gradients():
    at = np.array([0.5])
    exact = mw.evaluate("fixed/push", at, measure="ease")
    assert exact.status == "optimal" and exact.unit == "N^2 m^2" and exact.u is None
    step = 1e-5
    ahead, behind = (mw.evaluate("fixed/push", at + s, measure="ease").beta for s in (step, -step))
    slope = (ahead - behind) / (2 * step)
    assert exact.gradient == pytest.approx([slope], rel=1e-5)
    by_value = mw.evaluate("fixed/push", at, measure="ease_by_value")
    assert by_value.beta == exact.beta
    assert by_value.gradient == pytest.approx(exact.gradient, rel=1e-6)


def test_a_measure_that_solves_the_same_program_gives_the_same_value():
    for theta_r in ([0, 0], [0.3, -0.4], [-0.5, 1.0]):
        ours = mw.evaluate("planar/force", theta_r).beta
        assert mw.evaluate("planar/force", theta_r, measure="ray").beta == pytest.approx(ours, rel=1e-9)


def test_a_measure_in_rows_and_in_threads():
    rows = np.linspace(-0.9, 0.9, 200)[:, None]
    one, four = (mw.evaluate("fixed/push", rows, measure="ease", threads=n) for n in (1, 4))
    assert np.array_equal(one.beta, four.beta, equal_nan=True) and np.isfinite(one.beta).any()
    best = [mw.solve("fixed/push", measure="ease", search="cmaes", budget=400, threads=n) for n in (1, 4)]
    assert best[0].beta == best[1].beta and np.array_equal(best[0].theta_r, best[1].theta_r)


def test_a_value_that_is_nan_is_no_value():
    class Nowhere(mw.Measure):
        name = "nowhere"

        def value(self, posture):
            return float("nan")

    mw.add_measure(Nowhere())
    answer = mw.evaluate("planar/force", [0, 0], measure="nowhere")
    assert not answer.has_value and np.isnan(answer.beta)
    assert (answer.status, answer.reason) == ("infeasible", "measure nowhere returned NaN")
    assert mw.solve("planar/force", measure="nowhere", search="sample", budget=50).status == "none_found"


@pytest.mark.parametrize("number, said", [(np.nan, "NaN"), (np.inf, "an infinity"), (-np.inf, "an infinity")])
@pytest.mark.parametrize("search", ["", "cmaes", "sample"])
def test_a_search_says_where_a_measure_returned_no_number(number, said, search):
    class Nowhere(mw.Measure):
        name, unit = "nowhere", "m"

        def value(self, posture):
            return number

    mw.add_measure(Nowhere())
    # Most of these postures collide, which is not why a search finds nothing.
    answer = mw.solve("uvms/valve", measure="nowhere", search=search, budget=100)
    assert answer.status == "none_found"
    found = re.fullmatch(rf"nothing that was evaluated has a value: measure nowhere returned {said} at theta_r = (.*)", answer.reason)
    theta_r = [float(number) for number in found[1].split()]
    assert mw.evaluate("uvms/valve", theta_r).has_value  # a posture there is


@pytest.mark.parametrize("search", ["sample", "cmaes", "crs2", "slsqp", "multistart", "de", "annealing"])
@pytest.mark.parametrize("threads", [1, 4])
def test_an_exception_in_a_measure_reaches_the_caller(search, threads):
    class Broken(mw.Measure):
        name = "broken"
        calls = 0

        def value(self, posture):
            self.calls += 1
            if self.calls > 30:
                raise ZeroDivisionError("the 31st call")
            return posture.tau_d @ posture.tau_d

    mw.add_measure(Broken())
    with pytest.raises(ZeroDivisionError, match="the 31st call"):
        mw.solve("planar/force", measure="broken", search=search, budget=500, threads=threads)


def test_wrong_results_of_a_measure(rejects):
    class Wrong(mw.Measure):
        name = "wrong"

        def value(self, posture):
            return 1.0

        def derivatives(self, posture):
            return np.zeros(2), np.zeros((6, 3))

    mw.add_measure(Wrong())
    assert rejects(mw.evaluate, "planar/force", [0, 0], measure="wrong").key == "wrong.derivatives[0]"


@pytest.mark.parametrize(
    "value, got",
    [
        (None, "None"),
        ("1.5", "dtype <U3"),
        (1j, "dtype complex128"),
        (True, "dtype bool"),
        (object(), "dtype object"),
        (np.array([1.0, 2.0]), "shape (2,)"),
        (np.array([]), "shape (0,)"),
        (np.ma.masked_array([1.0], [True]), "a masked array"),
    ],
    ids=str,
)
@pytest.mark.parametrize("call", [lambda m: mw.evaluate("planar/force", [0, 0], measure=m), lambda m: mw.solve("planar/force", measure=m, budget=20)])
def test_what_is_no_value_of_a_measure(rejects, value, got, call):
    class Odd(mw.Measure):
        name = "odd"

        def value(self, posture):
            return value

    mw.add_measure(Odd())
    assert str(rejects(call, "odd")).startswith(f"odd.value: got {got}, expected ")


@pytest.mark.parametrize(
    "pair, key, got",
    [
        (lambda p: [p.tau_d, p.J], "", ""),
        (lambda p: p.tau_d, "", ""),
        (lambda p: (None, p.J), "[0]", "None"),
        (lambda p: (p.tau_d[1:], p.J), "[0]", "shape (4,)"),
        (lambda p: (p.tau_d, p.J.T), "[1]", "shape (5, 6)"),
        (lambda p: (p.tau_d * 1j, p.J), "[0]", "dtype complex128"),
        (lambda p: (p.tau_d, p.J * np.nan), "[1]", "a NaN or an infinity"),
        (lambda p: (p.tau_d + np.inf, p.J), "[0]", "a NaN or an infinity"),
    ],
)
def test_what_are_no_derivatives_of_a_measure(rejects, pair, key, got):
    class Sloped(mw.Measure):
        name = "sloped"

        def value(self, posture):
            return 1.0

        def derivatives(self, posture):
            return pair(posture)

    mw.add_measure(Sloped())
    error = rejects(mw.evaluate, "planar/force", [0, 0], measure="sloped")
    assert str(error).startswith(f"sloped.derivatives{key}: got {got}") and "expected" in str(error)


def test_numbers_of_other_types_are_values():
    class Narrow(mw.Measure):
        name = "narrow"

        def value(self, posture):
            return kind(2.5)

        def derivatives(self, posture):
            return posture.tau_d.astype("f4"), np.asfortranarray(posture.J.astype("i8"))

    mw.add_measure(Narrow())
    for kind in (float, np.float32, np.float64, np.array):
        assert mw.evaluate("planar/force", [0, 0], measure="narrow").beta == 2.5
    kind = int
    assert mw.evaluate("planar/force", [0, 0], measure="narrow").beta == 2


def test_names_of_strategies(rejects):
    class Taken(mw.Measure):
        name = "ellipsoid"

        def value(self, posture):
            return 0.0

    rejects(mw.add_measure, Taken())
    Taken.name = ""
    rejects(mw.add_measure, Taken())
    Taken.name = "a b"
    rejects(mw.add_measure, Taken())
    assert "ease" in str(rejects(mw.evaluate, "planar/force", [0, 0], measure="no"))


@pytest.mark.parametrize("search", ["random_points", "scipy_de", "random_points+cmaes", "restart:random_points+slsqp"])
def test_a_search_finds_what_it_evaluates(search):
    task = mw.load("planar/force")
    answer = mw.solve(task, search=search, budget=1000, seed=3)
    assert answer.status == "best_found" and answer.search == search
    assert 0 < answer.evaluations <= 1000
    assert answer.beta == mw.evaluate(task, answer.theta_r).beta
    assert answer.beta > 0.9 * mw.solve(task).beta
    again = mw.solve(task, search=search, budget=1000, seed=3, threads=4)
    assert np.array_equal(answer.theta_r, again.theta_r)


def test_an_objective_has_bounds_gradients_and_an_end():
    seen = {}

    class Look(mw.Search):
        name = "look"

        def maximize(self, objective):
            value, gradient = objective.value_and_gradient(objective.start)
            seen.update(value=value, gradient=gradient, lower=objective.lower, upper=objective.upper)
            seen.update(budget=objective.budget, start=objective.start, left=objective.left, kept=objective)
            seen["rows"] = objective.values([objective.start, objective.start])
            while True:
                objective(objective.start)

    mw.add_search(Look())
    task = mw.load("planar/force")
    answer = mw.solve(task, search="look", budget=10)
    expected = mw.evaluate(task, task.theta_r_default)
    assert seen["value"] == expected.beta and np.array_equal(seen["gradient"], expected.gradient)
    assert np.array_equal(seen["rows"], [expected.beta] * 2)
    assert np.array_equal(seen["lower"], task.theta_r_min) and np.array_equal(seen["upper"], task.theta_r_max)
    assert (seen["budget"], seen["left"]) == (10, 9) and answer.evaluations == 10
    with pytest.raises(mw.InputError, match="search has ended"):
        seen["kept"](seen["start"])


def test_an_exception_in_a_search_reaches_the_caller():
    class Fails(mw.Search):
        name = "fails"

        def maximize(self, objective):
            objective(objective.start)
            raise LookupError("no more")

    mw.add_search(Fails())
    with pytest.raises(LookupError, match="no more"):
        mw.solve("planar/force", search="fails", budget=10)


@pytest.mark.parametrize("interrupted", [False, True])
def test_a_search_that_survives_its_errors_ends(interrupted):
    class Survives(mw.Search):
        name = "survives"

        def maximize(self, objective):
            while True:
                try:
                    objective(objective.start)
                    raise LookupError("a step of its own that fails")
                except Exception:
                    pass

    mw.add_search(Survives())
    budget = 10**8 if interrupted else 10
    answer = mw.solve("planar/force", search="survives", budget=budget, callback=lambda n: interrupted)
    assert answer.status == ("budget_exhausted" if interrupted else "best_found") and answer.has_value
    assert interrupted or answer.evaluations == 10
    assert not issubclass(mw.SearchEnded, Exception)


def test_a_race_has_a_row_for_each_run():
    runs = mw.race(["planar/force"], ["sample", "random_points", "scipy_de"], seeds=2, budget=300)
    assert len(runs["beta"]) == 6 and set(runs["search"]) == {"sample", "random_points", "scipy_de"}
    assert np.nanmin(runs["gap"]) == 0 and (runs["gap"] >= 0).all() and (runs["evaluations"] <= 300).all()


def test_a_search_that_only_computes_can_be_interrupted():
    class Sleeps(mw.Search):
        name = "sleeps"

        def maximize(self, objective):
            objective(objective.start)
            while True:
                time.sleep(0.01)

    mw.add_search(Sleeps())
    calls = []
    answer = mw.solve("planar/force", search="sleeps", budget=10, callback=lambda n: calls.append(n) or len(calls) > 2)
    assert answer.status == "budget_exhausted" and answer.evaluations == 1 and answer.has_value
    again = mw.solve("planar/force", search="random_points+cmaes", budget=200)  # nothing is left behind
    assert again.status == "best_found"


def test_what_is_no_strategy(rejects):
    assert str(rejects(mw.add_search, 3)) == "search: got 3, expected an object with maximize()"
    assert str(rejects(mw.add_measure, "x")) == "measure: got 'x', expected an object with value()"


def test_a_class_in_place_of_an_object(rejects):
    assert "Ease()" in str(rejects(mw.add_measure, Ease))
    assert "Sample()" in str(rejects(mw.add_search, Sample))


def test_lists_have_what_was_added():
    assert mw.measures()["ease"].startswith("Minus the squared load")
    assert {"random_points", "scipy_de", "cmaes", "slp"} <= set(mw.searches())


def test_one_name_in_a_race():
    assert len(mw.race("planar/force", "cmaes", seeds=1, budget=50)["beta"]) == 1
