"""Every argument of every function: what is no value of it is an antilock.Error of one line, never an exception of the
language, never a guess (scikit-fem #890: numbers of unknowns where a mapping was wanted were taken for values)."""
import decimal
import fractions
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sparse

import antilock

N, R = 6, 2
SCENE = """
[load]
f = "10*sin(2*pi*x)"
[layer]
epsilon = 1e-2
[contact]
[mesh]
kind = "structured"
cells = 4
"""


def valid():
    """Arguments of Problem that have an answer."""
    a1 = sparse.csc_matrix(2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))
    b = sparse.csr_matrix(np.eye(R, N))
    return dict(a1=a1, b=b, m=np.ones(R), load=-np.ones(N), compliance=0.5, fixed={0: 0.0}, lower=-np.ones(N),
                upper=np.ones(N), force_limit=np.full(N, 10.0))


def problem():
    return antilock.Problem(**valid())


class Hostile:
    """An object whose every answer is an exception."""

    def __repr__(self):
        raise RuntimeError("no repr")

    def __array__(self, *_, **__):
        raise RuntimeError("no array\nin two lines")

    def __float__(self):
        raise RuntimeError("no float")

    def __fspath__(self):
        raise RuntimeError("no path")

    def __len__(self):
        raise RuntimeError("no length")


def out_of_range():
    broken = sparse.csr_matrix(np.eye(N))
    broken.indices[2] = 10**6
    return broken


def coo_out_of_range():
    broken = sparse.coo_matrix(np.eye(N))
    broken.row[2] = 10**6
    return broken


# each is made anew: a generator is used up by its first reader
ANYTHING = {
    "None": lambda: None, "str": lambda: "1.5", "bytes": lambda: b"1.5", "object": lambda: object(),
    "hostile": Hostile, "function": lambda: valid, "type": lambda: float, "complex": lambda: 1 + 2j,
    "dict": lambda: {"a": 1}, "set": lambda: {0, 1}, "generator": lambda: (i for i in range(N)),
    "decimal": lambda: decimal.Decimal("0.5"), "date": lambda: np.datetime64("2024-01-01"),
    "bool": lambda: True, "numpy bool": lambda: np.bool_(False), "ragged": lambda: [[1, 2], [3]],
    "strings": lambda: ["1"] * N, "bools": lambda: [True] * N, "nones": lambda: [None] * N, "objects": lambda: [object()] * N,
    "complex array": lambda: np.ones(N, complex), "dates": lambda: np.zeros(N, "datetime64[s]"),
    "structured": lambda: np.zeros(N, [("a", float)]), "masked": lambda: np.ma.masked_array(np.ones(N), [1] + [0] * (N - 1)),
    "empty": lambda: [], "cube": lambda: np.ones((2, 2, 2)), "long": lambda: np.ones(N + 1), "matrix": lambda: np.ones((N, N + 2)),
    "nans": lambda: np.full(N, np.nan), "huge integers": lambda: [10**400] * N, "scene": lambda: SCENE,
}
NUMBERS = {"nan": lambda: float("nan"), "inf": lambda: float("inf"), "-inf": lambda: float("-inf"), "negative": lambda: -1,
           "huge": lambda: 10**400, "numpy nan": lambda: np.array(np.nan), "array": lambda: np.array([0.5]), "list": lambda: [0.5]}
MATRICES = {
    "sparse of complex": lambda: sparse.csr_matrix(np.eye(N) * 1j), "sparse of bool": lambda: sparse.csr_matrix(np.eye(N) > 0),
    "sparse of nan": lambda: sparse.csc_matrix(np.full((N, N), np.nan)), "index out of range": out_of_range,
    "index out of range, by places": coo_out_of_range, "vector": lambda: np.ones(N), "rows of text": lambda: [["1"] * N] * N,
    "far too large": lambda: sparse.coo_matrix(([1.0], ([0], [0])), (2**33, 2**33)), "no rows": lambda: np.zeros((0, 0)),
    "not square": lambda: np.ones((N, N + 1)), "infinite": lambda: np.full((N, N), np.inf),
}
MAPPINGS = {
    "numbers of unknowns": lambda: [0, 1, 2], "the same as an array": lambda: np.array([0, 1, 2]), "as a set": lambda: {0, 5},
    "as a tuple": lambda: (0, 5), "pairs": lambda: [(0, 0.0)], "an array per unknown": lambda: np.zeros(N),
    "text for an unknown": lambda: {"0": 0.0}, "a float for an unknown": lambda: {0.0: 0.0}, "True for an unknown": lambda: {True: 0.0},
    "out of range": lambda: {N: 0.0}, "negative": lambda: {-1: 0.0}, "huge": lambda: {10**30: 0.0}, "text for a value": lambda: {0: "0"},
    "None for a value": lambda: {0: None}, "nan for a value": lambda: {0: np.nan}, "inf for a value": lambda: {0: np.inf},
    "a list for a value": lambda: {0: [0.0]}, "True for a value": lambda: {0: True}, "beyond the bounds": lambda: {0: 2.0},
}
VECTORS = {"short": lambda: np.ones(1)[:0], "a number": lambda: 1.0, "sparse": lambda: sparse.csr_matrix(np.ones((N, 1))),
           "two columns": lambda: np.ones((N // 2, 2)), "minus infinity": lambda: np.full(N, -np.inf)}


def solve_with(name):
    return lambda given: antilock.solve(**{**valid(), name: given})


def set_compliance(given):
    made = problem()
    made.compliance = given


EXACT = antilock.exact_solution(1e-1)
ARRAYS = ("list", "array", "empty", "long", "matrix", "cube")  # values of x and of y: 0.5 and ones
FUNCTIONS = {
    "a1": (solve_with("a1"), MATRICES, ()),
    "b": (solve_with("b"), MATRICES, ("no rows",)),  # of the shape (0, 0): it has no column for an unknown
    "m": (solve_with("m"), VECTORS, ()),
    "load": (solve_with("load"), VECTORS, ()),
    "compliance": (solve_with("compliance"), NUMBERS, ()),
    "fixed": (solve_with("fixed"), MAPPINGS, ("None",)),
    "lower": (solve_with("lower"), VECTORS, ("None", "minus infinity")),
    "upper": (solve_with("upper"), VECTORS, ("None",)),
    "force_limit": (solve_with("force_limit"), VECTORS, ("None",)),
    "force_bound": (lambda given: antilock.solve(**{**valid(), "force_limit": None, "force_bound": given}), VECTORS, ("None",)),
    "tolerance": (solve_with("tolerance"), NUMBERS, ()),
    "tolerance of Problem.solve": (lambda given: problem().solve(given), NUMBERS, ()),
    "compliance of a Problem": (set_compliance, NUMBERS, ()),
    "coarse": (lambda given: antilock.diagnose(given, problem()), {}, ()),
    "fine": (lambda given: antilock.diagnose(problem(), given), {}, ()),
    "epsilon": (lambda given: antilock.exact_solution(given), NUMBERS, ()),
    "epsilon of ExactSolution": (lambda given: antilock.ExactSolution(given, "sin(pi*x)", True), NUMBERS, ()),
    "load of an exact solution": (lambda given: antilock.exact_solution(0.1, given), {"surrogate": lambda: "\ud800", "zero": lambda: "x\0"}, ("str",)),
    "contact": (lambda given: antilock.exact_solution(0.1, contact=given), {"one": lambda: 1, "text": lambda: "yes"}, ("bool", "numpy bool")),
    "x": (lambda given: EXACT(given, 0.5), NUMBERS, ARRAYS),
    "y": (lambda given: EXACT(0.5, given), NUMBERS, (*ARRAYS, "negative")),
    "x of u_x": (lambda given: EXACT.u_x(given, 0.5), NUMBERS, ARRAYS),
    "y of u_y": (lambda given: EXACT.u_y(0.5, given), NUMBERS, (*ARRAYS, "negative")),
    "y of p": (lambda given: EXACT.p(0.5, given), {**NUMBERS, "in the body": lambda: 0.5}, ("empty", "negative")),
    "x of pressure": (lambda given: EXACT.pressure(given), NUMBERS, ARRAYS),
    "scene of assemble": (antilock.assemble, {"path": lambda: Path("s.toml"), "surrogate": lambda: "\ud800"}, ("scene",)),
    "scene of run": (antilock.run, {"path": lambda: Path("s.toml"), "surrogate": lambda: "\ud800"}, ("scene",)),
    "scene of certify": (antilock.certify, {"path": lambda: Path("s.toml"), "zero": lambda: SCENE + "\0"}, ("scene",)),
    "accuracy": (lambda given: antilock.certify(SCENE, given), NUMBERS, ()),
    "folder of assemble": (lambda given: antilock.assemble(SCENE, given), {"surrogate": lambda: "\ud800", "zero": lambda: "a\0b"}, ("str", "scene")),
    "folder of run": (lambda given: antilock.run(SCENE, given), {"surrogate": lambda: "\ud800"}, ("str", "scene")),
    "folder of certify": (lambda given: antilock.certify(SCENE, 0.5, given), {"surrogate": lambda: "\ud800"}, ("str", "scene")),
}
CASES = [pytest.param(call, make, id=f"{name}: {what}")
         for name, (call, own, accepted) in FUNCTIONS.items()
         for what, make in {**ANYTHING, **own}.items() if what not in accepted]


@pytest.mark.parametrize("call, make", CASES)
def test_what_is_no_value_is_an_error_of_one_line(call, make):
    with pytest.raises(antilock.Error) as refused:  # another exception of the language fails here
        call(make())
    assert "\n" not in str(refused.value) and len(str(refused.value)) < 400
    assert "accepted" in str(refused.value) or "finite" in str(refused.value) or "toml" in str(refused.value).lower()


def same(found):
    return found.u == pytest.approx(antilock.solve(**valid()).u, abs=1e-9)  # both are solved to 1e-10


@pytest.mark.parametrize("name, given", [
    ("a1", valid()["a1"].toarray()), ("a1", valid()["a1"].toarray().tolist()), ("a1", valid()["a1"].tocsr()),
    ("a1", valid()["a1"].tocoo()), ("a1", valid()["a1"].tolil()), ("a1", valid()["a1"].todok()), ("a1", valid()["a1"].todia()),
    ("a1", valid()["a1"].tobsr()), ("a1", valid()["a1"].astype(int)), ("a1", np.matrix(valid()["a1"].toarray())),
    ("a1", valid()["a1"].astype(np.float32)), ("b", valid()["b"].toarray()), ("b", valid()["b"].tocsc()),
    ("m", [1, 1]), ("m", (1.0, 1.0)), ("m", np.ones((R, 1))), ("m", np.ones((1, R))), ("m", np.ones(R, int)),
    ("load", -np.ones((N, 1))), ("load", [-1] * N), ("load", -np.ones(N, np.float32)), ("load", np.ma.masked_array(-np.ones(N))),
    ("fixed", {np.int64(0): np.float32(0)}), ("fixed", {0: fractions.Fraction(0)}), ("fixed", {0: np.array(0.0)}),
    ("compliance", fractions.Fraction(1, 2)), ("compliance", np.float64(0.5)), ("compliance", np.array(0.5)),
    ("lower", [-1] * N), ("upper", np.ones((N, 1))), ("force_limit", [10] * N),
])
def test_what_is_a_value_in_another_form_is_that_value(name, given):
    assert same(antilock.solve(**{**valid(), name: given}))


def test_force_bound_is_the_old_name_of_force_limit():
    arguments = valid()
    arguments["force_bound"] = arguments.pop("force_limit")
    assert same(antilock.solve(**arguments))
    with pytest.raises(antilock.Error, match="force_bound is the name of force_limit in 0.2; accepted: one of them"):
        antilock.solve(**{**valid(), "force_bound": [10] * N})


def test_arguments_are_not_changed():
    given = valid()
    given["a1"] = sparse.csc_matrix((np.r_[given["a1"].data, 0.0], np.r_[given["a1"].indices, N - 1],
                                     np.r_[given["a1"].indptr[:-1], given["a1"].nnz + 1]), (N, N))  # a place twice
    before = given["a1"].data.copy(), given["load"].copy(), dict(given["fixed"])
    antilock.solve(**given)
    assert np.array_equal(given["a1"].data, before[0]) and np.array_equal(given["load"], before[1])
    assert given["fixed"] == before[2]


def test_x_and_y_broadcast_or_are_refused():
    assert EXACT([0.1, 0.2], [[0.5], [0.6]]).shape == (2, 2)
    assert EXACT(np.zeros((0,)), 0.5).shape == (0,)
    with pytest.raises(antilock.Error, match="broadcast"):
        EXACT([0.1, 0.2], [0.5, 0.6, 0.7])
