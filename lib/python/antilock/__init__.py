"""Stiff parameters without locking, for those who have matrices from numpy and scipy, or a scene as a text.

Everything is dimensionless. N unknowns, R rows of B. Error is a ValueError that says in one line what is wrong and what is
accepted; NotConverged is an Error of a solve that did not reach its tolerance. tutorials/guides/howto_python.md shows it all.
"""
from __future__ import annotations

import json
from typing import Any, Mapping

from ._memory import one_thread_where_memory_is_limited

with one_thread_where_memory_is_limited():  # both of them, and the library, load OpenBLAS
    import numpy as np
    from scipy import sparse

    from . import _antilock
from numpy.typing import ArrayLike

from . import _arguments as arguments
from ._antilock import Diagnosis, Error, ExactSolution, NotConverged, Solution, __version__

__all__ = ["Diagnosis", "Error", "ExactSolution", "NotConverged", "Problem", "Solution",
           "assemble", "certify", "diagnose", "exact_solution", "run", "solve"]


class Problem(_antilock.Problem):
    """a1(u, v) + compliance^-1 (B u, M B v) = L(v), with bounds; compliance 0 is the limit.

    a1: N x N, symmetric; b: R x N, one row per strain that becomes stiff; m: R positive weights (areas of cells), the
    diagonal of M; load: N; fixed: unknown -> value; lower, upper: N, infinite (or 1e40 and more)
    where there is no bound; force_limit: N,
    the largest force that a bound can carry (Tresca's g). a1 and b are scipy matrices or arrays. compliance may be set again between two solves.
    """

    def __init__(self, a1: Any, b: Any, m: ArrayLike, load: ArrayLike, *, compliance: float = 1.0,
                 fixed: Mapping[int, float] | None = None, lower: ArrayLike | None = None, upper: ArrayLike | None = None,
                 force_limit: ArrayLike | None = None, force_bound: ArrayLike | None = None) -> None:
        a1, b = arguments.matrix("a1", a1, sparse.csc_matrix), arguments.matrix("b", b, sparse.csr_matrix)
        n = a1.shape[0]
        m, load = arguments.vector("m", m, b.shape[0]), arguments.vector("load", load, n)
        compliance = arguments.number("compliance", compliance, "0 or more")
        held = arguments.unknowns("fixed", fixed, n)
        low = _antilock.without_void_bound(arguments.vector("lower", lower, n, -np.inf))
        high = _antilock.without_void_bound(arguments.vector("upper", upper, n, np.inf))
        for i in np.flatnonzero(~((low <= high) & (low < np.inf) & (high > -np.inf))):
            raise Error(f"lower[{i}] = {low[i]}, upper[{i}] = {high[i]}; accepted: lower <= upper, infinite for none")
        for i, value in held.items():
            if not low[i] <= value <= high[i]:
                raise Error(f"fixed[{i}] = {value}; accepted: from {low[i]} to {high[i]}, its bounds")
        bounded = (low != -np.inf) | (high != np.inf)
        bounded[list(held)] = False
        if force_bound is not None and force_limit is not None:
            raise Error("force_bound is the name of force_limit in 0.2; accepted: one of them")
        name, given = ("force_limit", force_limit) if force_bound is None else ("force_bound", force_bound)
        limits = None if given is None else arguments.vector(name, given, n)[bounded]
        super().__init__(a1, b, m, load, compliance, list(held), list(held.values()), np.flatnonzero(bounded),
                         low[bounded], high[bounded], limits)


def solve(a1: Any, b: Any, m: ArrayLike, load: ArrayLike, *, tolerance: float = 1e-10, **keywords: Any) -> Solution:
    """The answer of Problem(a1, b, m, load, **keywords), to a relative error of u."""
    return Problem(a1, b, m, load, **keywords).solve(tolerance)


def diagnose(coarse: _antilock.Problem, fine: _antilock.Problem) -> Diagnosis:
    """Whether a method locks, from two problems of it, on a mesh and on a finer one. Loads are not looked at."""
    return _antilock.diagnose(arguments.problem("coarse", coarse, _antilock.Problem),
                              arguments.problem("fine", fine, _antilock.Problem))


def exact_solution(epsilon: float, load: str = "10*sin(2*pi*x)", contact: bool = True) -> ExactSolution:
    """The exact solution of (23) at 0 <= epsilon <= 1 for a load that is a sum of sines in x with polynomials in y."""
    return ExactSolution(epsilon, load, contact)


Truth, truth = ExactSolution, exact_solution  # the names in 0.2


def assemble(scene: str, folder: str = ".") -> _antilock.Problem:
    """The matrices of a scene file's text on its mesh; mesh files are looked for in the folder."""
    return _antilock.assemble(arguments.scene(scene), arguments.folder(folder))


def run(scene: str, folder: str = ".") -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """A scene file's text, answered: arrays and the summary that run_scene writes.

    The mesh file and the geometry that it names are looked for in the folder. No other file is read, and nothing is run.
    points N x 2 and u N, one per unknown; p R; vertices V x 2 and triangles T x 3; contact C x 3 (x, gap, pressure).
    With dimension = 3 in [mesh]: points N x 3, vertices V x 3 and tetrahedra T x 4; contact C x 4 (x, y, gap, pressure).
    summary["contact_force"] has the resultant of the obstacle's forces on the body: normal (upwards), tangential (to the right), moment
    (anticlockwise, about x = 0), in the unit of f times length^2 and length^3. summary["compliance"] is the work of the loads.
    normal_proved and moment_proved are proved intervals, with an accuracy and where u is prescribed at no end of the contact boundary.
    In space it has normal, moment and moment_y, the integrals of x and of y times the pressure, in one power of length more.
    u is the value at the point. For element = "BDM1-hybrid", whose unknowns are means, mean N holds the unknowns.
    """
    arrays, summary = _antilock.run(arguments.scene(scene), arguments.folder(folder))
    return arrays, json.loads(summary)


def certify(scene: str, accuracy: float = 1e-2, folder: str = ".") -> dict[str, Any]:
    """Proved numbers of the exact solution of a scene file's text: energy_lower <= J(u) <= energy_upper.

    The scene is refined until the relative error of its answer is proved to be `accuracy` at most. For each v of K, whoever
    computed it, |u - v|_a <= sqrt(2 (J(v) - energy_lower)).
    """
    accuracy = arguments.number("accuracy", accuracy, "above 0, below 1")
    return _antilock.certify(arguments.scene(scene), accuracy, arguments.folder(folder))
