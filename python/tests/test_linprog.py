"""Linear programs against HiGHS; proofs are checked by their inequalities."""

import maxwrench as mw
import numpy as np
import pytest
import scipy.sparse
from scipy.optimize import linprog

INF = np.inf
SOLVERS = ["simplex", "clp", "glpk", "ipopt"]
# Ipopt is an interior point method; the others end at a vertex.
TOLERANCE = {"simplex": 1e-9, "clp": 1e-9, "glpk": 1e-9, "ipopt": 1e-6}
NAMES = {0: "optimal", 2: "infeasible", 3: "unbounded"}


def highs(c, A, b, l, u):
    found = linprog(-np.asarray(c), A_eq=A, b_eq=b, bounds=list(zip(l, u)), method="highs")
    if found.status == 4 or found.status == 2:
        # HiGHS' presolve may only know "infeasible or unbounded": with a zero objective it is infeasible or not.
        feasible = linprog(np.zeros(len(c)), A_eq=A, b_eq=b, bounds=list(zip(l, u)), method="highs").status == 0
        return ("unbounded" if feasible else "infeasible"), None
    return NAMES[found.status], -found.fun if found.status == 0 else None


def assert_proves_infeasible(y, A, b, l, u):
    """sup {y'A x : l <= x <= u} < y'b, where rounding of a coefficient does not count against an infinite bound."""
    d = A.T @ y
    d[np.abs(d) < 1e-9 * (np.abs(A).T @ np.abs(y))] = 0
    with np.errstate(invalid="ignore"):
        most = np.where(d > 0, d * u, np.where(d < 0, d * l, 0)).sum()
    assert most < y @ b


def assert_is_ray(ray, c, A, l, u):
    """A r = 0, r violates no bound, and c'r > 0."""
    size = np.abs(ray).max()
    assert size > 0 and np.abs(A @ ray).max() < 1e-8 * size
    assert np.all(ray[np.isfinite(l)] >= -1e-8 * size) and np.all(ray[np.isfinite(u)] <= 1e-8 * size)
    assert c @ ray > 0


def random_program(rng):
    """A program with boxed, one-sided and free columns, which need not have a solution."""
    rows, cols = rng.integers(2, 8), rng.integers(6, 14)
    A = rng.normal(size=(rows, cols)) * (rng.random((rows, cols)) < 0.7)
    l, u = -rng.uniform(0, 3, cols), rng.uniform(0, 3, cols)
    kind = rng.integers(0, 8, cols)
    l[(kind == 0) | (kind == 1)] = -INF
    u[(kind == 0) | (kind == 2)] = INF
    x = rng.uniform(np.maximum(l, -3), np.minimum(u, 3))
    b = A @ x + (rng.normal(size=rows) * 10 if rng.random() < 0.3 else 0)
    return rng.normal(size=cols), A, b, l, u


@pytest.mark.parametrize("solver", SOLVERS)
def test_random_programs(solver):
    rng = np.random.default_rng(1)
    seen, undecided = {}, 0
    for case in range(25 if solver == "ipopt" else 60):
        c, A, b, l, u = random_program(rng)
        status, objective = highs(c, A, b, l, u)
        mine = mw.linprog(c, A, b, l, u, solver=solver)
        if solver == "ipopt" and mine.status == "numerical_error":
            undecided += 1  # an interior point method may end without a proof, but says so
            assert mine.reason
            continue
        assert mine.status == status, (case, mine.reason)
        seen[status] = seen.get(status, 0) + 1
        if status == "optimal":
            tolerance = TOLERANCE[solver]
            assert mine.objective == pytest.approx(objective, rel=tolerance, abs=tolerance), case
            assert np.abs(A @ mine.x - b).max() < 10 * tolerance * (1 + np.abs(b).max())
            assert np.all(mine.x >= l - 10 * tolerance) and np.all(mine.x <= u + 10 * tolerance)
            assert c @ mine.x == pytest.approx(mine.objective, rel=1e-12, abs=1e-12)
            assert max(mine.residual.values()) < 1e-6
            # Weak duality holds with equality: lambda'b + sup {(c - A'lambda)'x} is the objective.
            d = c - A.T @ mine.lambda_
            d[np.abs(d) < 1e-6] = 0
            with np.errstate(invalid="ignore"):
                dual = mine.lambda_ @ b + np.where(d > 0, d * u, np.where(d < 0, d * l, 0)).sum()
            assert dual == pytest.approx(objective, rel=1e-4, abs=1e-4)
        elif status == "infeasible":
            assert_proves_infeasible(mine.certificate, A, b, l, u)
        else:
            assert_is_ray(mine.certificate, c, A, l, u)
            assert np.abs(A @ mine.x - b).max() < 1e-6 * (1 + np.abs(b).max())  # x is feasible
    assert min(seen[name] for name in NAMES.values()) >= 2 and undecided <= 2, seen


@pytest.mark.parametrize("solver", SOLVERS)
def test_multipliers_are_derivatives(solver):
    # max x + 2 y, x + y = 1, 0 <= x <= 1, 0 <= y <= 0.7: y = 0.7, x = 0.3; another unit of b makes x one larger.
    mine = mw.linprog([1, 2], [[1, 1]], [1], [0, 0], [1, 0.7], solver=solver)
    np.testing.assert_allclose(mine.x, [0.3, 0.7], atol=1e-6)
    assert mine.objective == pytest.approx(1.7, abs=1e-6)
    assert mine.lambda_ == pytest.approx([1], abs=1e-6)


@pytest.mark.parametrize("solver", SOLVERS)
def test_default_bounds_are_zero_and_infinity(solver):
    # max -x, x - y = 2, x and y >= 0: x = 2; and max x grows along (1, 1).
    assert mw.linprog([-1, 0], [[1, -1]], [2], solver=solver).objective == pytest.approx(-2, abs=1e-6)
    ray = mw.linprog([1, 0], [[1, -1]], [2], solver=solver)
    assert ray.status == "unbounded" and ray.certificate[0] > 0
    assert ray.certificate[0] == pytest.approx(ray.certificate[1])
    # x + y = -1 has no point: y = -1 proves it, sup {-x - y} = 0 < 1.
    none = mw.linprog([1, 0], [[1, 1]], [-1], solver=solver)
    assert none.status == "infeasible" and none.certificate[0] < 0


@pytest.mark.parametrize("solver", SOLVERS)
def test_crossed_bounds_are_infeasible(solver):
    assert mw.linprog([1], [[1.0]], [0], [1], [-1], solver=solver).status == "infeasible"


@pytest.mark.parametrize("solver", SOLVERS)
def test_no_rows_and_no_columns(solver):
    # Without rows each column goes to its better bound.
    mine = mw.linprog([1, -1], np.zeros((0, 2)), [], [-1, -2], [3, 4], solver=solver)
    assert mine.objective == pytest.approx(3 + 2, abs=1e-5) and mine.lambda_.shape == (0,)
    assert mw.linprog([], np.zeros((0, 0)), [], solver=solver).status == "optimal"
    assert mw.linprog([], np.zeros((1, 0)), [1], solver=solver).status == "infeasible"


@pytest.mark.parametrize("form", ["csc", "csr", "coo", "lil", "dok", "bsr", "dia"])
def test_sparse_matrices(form):
    rng = np.random.default_rng(2)
    for _ in range(5):
        c, A, b, l, u = random_program(rng)
        dense = mw.linprog(c, A, b, l, u)
        sparse = mw.linprog(c, scipy.sparse.csc_matrix(A).asformat(form), b, l, u)
        assert sparse.status == dense.status
        assert np.array_equal(sparse.x, dense.x) and np.array_equal(sparse.lambda_, dense.lambda_)
        assert np.array_equal(sparse.certificate, dense.certificate)


def test_sparse_arrays_of_other_kinds():
    # Entries of one place that add up, indices of 64 bits, indices that are not sorted, integers, sparse arrays.
    def objective(A):
        return mw.linprog([1, 1], A, [4, 3], [0, 0], [10, 10]).objective

    # 2 x = 4 and y = 3 throughout: 2 + 3.
    twice = scipy.sparse.coo_matrix(([1.0, 1.0, 1.0], ([0, 0, 1], [0, 0, 1])), shape=(2, 2))
    assert objective(twice) == pytest.approx(5)
    assert twice.nnz == 3  # the argument is as it was
    wide = scipy.sparse.csc_matrix(np.diag([2.0, 1.0]))
    wide.indices, wide.indptr = wide.indices.astype(np.int64), wide.indptr.astype(np.int64)
    assert objective(wide) == pytest.approx(5)
    assert objective(scipy.sparse.csr_array(np.diag([2, 1]))) == pytest.approx(5)


def test_sparse_arguments_do_not_change():
    # x + y = 4, y = 3; the rows of the second column are in falling order.
    falling = (np.array([1.0, 1.0, 1.0]), np.array([0, 1, 0]), np.array([0, 1, 3]))
    # 2 x = 4, y = 3; the first column has two entries in one place.
    doubled = (np.array([1.0, 1.0, 1.0]), np.array([0, 0, 1]), np.array([0, 2, 3]))
    for (data, indices, indptr), objective in ((falling, 4), (doubled, 5)):
        A = scipy.sparse.csc_matrix((data.copy(), indices.copy(), indptr.copy()), shape=(2, 2))
        assert mw.linprog([1, 1], A, [4, 3], [0, 0], [10, 10]).objective == pytest.approx(objective)
        assert A.data.tolist() == data.tolist() and A.indices.tolist() == indices.tolist()
        assert A.indptr.tolist() == indptr.tolist()


def test_a_degenerate_program():
    # An assignment problem of 6 workers: each vertex is degenerate. Against HiGHS' objective.
    rng = np.random.default_rng(3)
    cost = rng.integers(1, 20, (6, 6)).astype(float)
    A = np.vstack([np.kron(np.eye(6), np.ones(6)), np.kron(np.ones(6), np.eye(6))])  # 12 rows of rank 11
    expected = -linprog(-cost.ravel(), A_eq=A, b_eq=np.ones(12), method="highs").fun
    for solver in SOLVERS:
        mine = mw.linprog(cost.ravel(), A, np.ones(12), solver=solver)
        assert mine.status == "optimal" and mine.objective == pytest.approx(expected, rel=1e-6), solver


def test_answers_are_read_only_and_outlive_their_object():
    mine = mw.linprog([1, 2], [[1, 1]], [1])
    x = mine.x
    assert not x.flags.writeable and not mine.lambda_.flags.writeable and not mine.certificate.flags.writeable
    del mine
    assert x.tolist() == [0, 1]
