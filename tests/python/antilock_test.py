"""The module of Python: its answers are those of the programs, its refusals are the library's.

notebook_test.py runs the page on it."""
import ast
import inspect
import os
import subprocess
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import scipy.sparse as sparse

import antilock

SCENE = """
[load]
f = "10*sin(2*pi*x)"
[layer]
epsilon = 1e-4
[contact]
[mesh]
kind = "structured"
cells = 16
[method]
element = "CR"
"""


def test_run_is_run_scene(tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE)
    subprocess.run([os.environ["RUN_SCENE"], scene, "--out", tmp_path / "out"], check=True, capture_output=True)
    arrays, summary = antilock.run(SCENE)
    table = np.loadtxt(tmp_path / "out/solution.csv", delimiter=",", skiprows=1)  # 17 digits: the same doubles
    assert np.array_equal(arrays["points"], table[:, :2])
    # both are solved to 1e-10; run_scene may have started again with other kernels of the BLAS
    assert abs(arrays["u"] - table[:, 2]).max() <= 1e-9 * abs(table[:, 2]).max()
    assert summary["contact"]["active"] == np.count_nonzero(arrays["contact"][:, 2] > 0)
    assert summary["locking"]["diagnosis"] and summary["warning"] == ""
    # CR: one bound per edge of length 1/16
    x, _, pressure = arrays["contact"].T
    force = summary["contact_force"]
    assert force["normal"] == pytest.approx(pressure.sum() / 16)
    assert force["moment"] == pytest.approx(x @ pressure / 16)
    begin, end = summary["contact"]["from_within"], summary["contact"]["to_within"]
    assert begin[0] < begin[1] == summary["contact"]["from"] and end[0] == summary["contact"]["to"]
    # the gap is 0: L(u) = a(u, u) = -2 J(u)
    assert summary["compliance"]["value"] == pytest.approx(-2 * summary["energy"])


# (0,1)^3 over (0,1)^2 x (-1,0), six tetrahedra per cube
IN_SPACE = SCENE.replace("[mesh]", "[mesh]\ndimension = 3").replace("cells = 16", "cells = 3")


def test_a_scene_in_space_has_tetrahedra():
    arrays, summary = antilock.run(IN_SPACE)
    vertices, tetrahedra = arrays["vertices"], arrays["tetrahedra"]
    assert vertices.shape == (4 * 4 * 7, 3) and tetrahedra.shape == (6 * 3**2 * 6, 4) and "triangles" not in arrays
    edges = vertices[tetrahedra[:, 1:]] - vertices[tetrahedra[:, :1]]
    assert np.linalg.det(edges).sum() / 6 == pytest.approx(2)
    assert arrays["points"].shape == (len(arrays["u"]), 3)
    x, y, gap, pressure = arrays["contact"].T  # CR: one bound per face of area 1/18
    assert len(x) == 18 and gap.min() > -1e-9
    force = summary["contact_force"]
    for name, weight in ("normal", 1), ("moment", x), ("moment_y", y):
        assert force[name] == pytest.approx((weight * pressure).sum() / 18)
    problem = antilock.assemble(IN_SPACE)
    lower = np.full(len(problem.load), -np.inf)
    lower[problem.contact] = 0
    solution = antilock.solve(problem.a1, problem.b, problem.m, problem.load, compliance=problem.compliance,
                              fixed=dict.fromkeys(problem.fixed, 0.0), lower=lower)
    assert abs(solution.u - arrays["u"]).max() <= 1e-8 * abs(arrays["u"]).max()


def test_solve_of_the_matrices_is_run():
    problem = antilock.assemble(SCENE)
    lower = np.full(len(problem.load), -np.inf)
    lower[problem.contact] = 0
    arrays, summary = antilock.run(SCENE)
    twice = sparse.coo_matrix(problem.a1) / 2  # entries out of order, each place twice: scipy allows both
    a1 = sparse.coo_matrix((np.tile(twice.data, 2), (np.tile(twice.row, 2), np.tile(twice.col, 2))), twice.shape)
    found = antilock.solve(a1, problem.b, problem.m, problem.load, compliance=1e-8,
                           fixed=dict.fromkeys(problem.fixed, 0), lower=lower)
    assert abs(found.u - arrays["u"]).max() <= 1e-9 * abs(found.u).max()  # both are solved to 1e-10
    assert found.energy == pytest.approx(summary["energy"], rel=1e-9)
    # lambda and p balance the load; 1e-10 is the tolerance of the solve
    free = np.setdiff1d(np.arange(len(lower)), problem.fixed)
    left = problem.a1 @ found.u + problem.b.T @ (problem.m * found.p) - problem.load - found.lambda_
    assert abs(left[free]).max() <= 1e-10 * abs(problem.load).max()
    assert np.array_equal(np.flatnonzero(found.active), np.flatnonzero(found.lambda_))


def test_an_element_with_means_has_values_and_means():
    scene = SCENE.replace('"CR"', '"M2"')
    problem = antilock.assemble(scene)
    arrays, _ = antilock.run(scene)
    lower = np.full(len(problem.load), -np.inf)
    lower[problem.contact] = 0
    found = antilock.solve(problem.a1, problem.b, problem.m, problem.load, compliance=1e-8,
                           fixed=dict.fromkeys(problem.fixed, 0), lower=lower)
    assert abs(found.u - arrays["mean"]).max() <= 1e-9 * abs(found.u).max()  # both are solved to 1e-10
    # a mean differs from the value by second derivatives times h^2 / 36 or so
    assert 1e-5 < abs(arrays["u"] - arrays["mean"]).max() < 0.05 * abs(arrays["u"]).max()
    assert arrays["points"].shape == (len(arrays["u"]), 2)


def bounded_string(lower, upper, fixed={0: 0, 7: 0}):
    n = 8
    a1 = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    load = -np.ones(n)
    load[2] = 3
    return antilock.solve(a1, np.eye(n)[:3] - np.eye(n)[1:4], np.ones(3), load, fixed=fixed, lower=lower, upper=upper)


# slsqp #37, OpenMDAO1 #427: the largest double and other customary infinities are no bounds
@pytest.mark.parametrize("none", [1e20, 1e30, 1e39, 1e40, 1e300, np.finfo(float).max, np.inf])
def test_no_bound_has_many_names(none):
    lower, upper = np.full(8, -none), np.full(8, none)
    lower[3], upper[2] = -0.5, 0.25
    given = lower.copy()
    found = bounded_string(lower, upper)
    assert np.array_equal(lower, given)  # the user's own array
    assert found.u[2] == pytest.approx(0.25, abs=1e-12) and found.u[3] == pytest.approx(-0.5, abs=1e-12)
    assert np.array_equal(np.flatnonzero(found.active), [2, 3])
    alone = bounded_string(np.where(lower == -0.5, -0.5, -np.inf), np.where(upper == 0.25, 0.25, np.inf))
    assert found.u == pytest.approx(alone.u, abs=1e-10)  # both are solved to 1e-10


# osqp #256, 4C #947: sides that cross, and bounds that shut out a prescribed value
@pytest.mark.parametrize("at, low, high, says", [
    (3, 0.5, -0.5, "lower[3] = 0.5, upper[3] = -0.5; accepted: lower <= upper"),
    (3, np.nan, 1, "lower has a nan at 3"),
    (3, np.inf, np.inf, "lower[3] = inf"),
    (0, 0.25, np.inf, "fixed[0] = 0.0; accepted: from 0.25 to inf, its bounds"),
])
def test_bounds_that_nothing_meets_are_refused(at, low, high, says):
    lower, upper = np.full(8, -np.inf), np.full(8, np.inf)
    lower[at], upper[at] = low, high
    with pytest.raises(antilock.Error) as refused:
        bounded_string(lower, upper)
    assert says in str(refused.value) and "\n" not in str(refused.value)


def test_arrays_of_an_answer_are_views():
    found = antilock.assemble(SCENE).solve()
    assert not found.u.flags.owndata and not found.u.flags.writeable
    u, first = found.u, found.u[5]
    del found
    assert u[5] == first  # the view keeps the answer alive


def test_truth_broadcasts_and_its_parts_agree():
    exact = antilock.exact_solution(1e-2)
    assert antilock.truth is antilock.exact_solution and antilock.Truth is antilock.ExactSolution  # the names in 0.2
    x = np.linspace(0.1, 0.6, 6)
    grid = exact(x, np.array([[-1.0], [0.5]]))
    assert grid.shape == (2, 6) and grid[0, 1] == exact(x[1], -1)
    step = 1e-4  # a centred difference is right to step^2 u_xxx / 6, some 1e-8, and to 1e-8 / step of the values
    assert (exact(x + step, 0.5) - exact(x - step, 0.5)) / (2 * step) == pytest.approx(exact.u_x(x, 0.5), abs=2e-4)
    assert exact.pressure(0.9) == pytest.approx(-exact.p(0.9, -1), abs=1e-6)
    (start, end), = exact.contact
    assert exact.pressure(start - 1e-3) == 0 < exact.pressure(start + 1e-3) and end == 1


def test_the_certified_energies_hold_the_exact_one():
    proved = antilock.certify(SCENE, accuracy=0.1)
    assert proved["energy_lower"] < antilock.exact_solution(1e-4).energy < proved["energy_upper"]
    assert proved["relative"] <= 0.1


@pytest.mark.parametrize("ask, says", [
    (lambda p: antilock.solve(p.a1, p.b, p.m[1:], p.load), "m has 511 entries; accepted: 512"),
    (lambda p: antilock.solve(p.a1 * 1j, p.b, p.m, p.load), "a1 is complex; accepted: real numbers"),
    (lambda p: antilock.solve(p.a1, p.b, p.m, p.load, compliance=-1), "compliance = -1; accepted"),
    (lambda p: antilock.solve(p.a1, p.b, p.m, p.load, fixed={-1: 0}), "unknown -1 is out of range"),
    (lambda p: antilock.solve(p.a1, p.b, p.m, p.load, tolerance=0), "tolerance = 0; accepted"),
    (lambda p: antilock.solve(p.a1, p.b, p.m, p.load * np.nan), "load has a nan at 0"),
    (lambda p: antilock.exact_solution(2), "epsilon = 2 is out of range; accepted"),
    (lambda p: antilock.exact_solution(0.1, "exp(x)"), "is no sum of sines"),
    (lambda p: antilock.exact_solution(0.1)(0.5, -2), "accepted: 0 <= x <= 1, -1 <= y <= 1"),
    (lambda p: antilock.run("[load]"), "mesh: is missing; accepted"),
    (lambda p: antilock.run(SCENE + 'solver = "petsc"'), "method.solver"),
    (lambda p: antilock.certify(SCENE, 2), "accepted"),
    (lambda p: antilock.certify(IN_SPACE, 0.5), "certify: does not know three dimensions; accepted: a scene without it"),
    (lambda p: antilock.run(IN_SPACE + 'accuracy = 0.1'), "method.accuracy: an accuracy does not go with a mesh of tetrahedra"),
])
def test_refusals_are_errors_of_one_line(ask, says):
    with pytest.raises(antilock.Error) as refused:
        ask(antilock.assemble(SCENE))
    assert isinstance(refused.value, ValueError)
    assert says in str(refused.value) and "\n" not in str(refused.value)


def test_other_threads_go_on_during_a_solve():
    problem = antilock.assemble(SCENE.replace("cells = 16", "cells = 128"))
    done, ticks = threading.Event(), []
    solver = threading.Thread(target=lambda: (problem.solve(), done.set()))
    solver.start()
    while not done.wait(0.001):
        ticks.append(time.monotonic())
    solver.join()
    assert len(ticks) >= 3  # a solve that held the lock would leave none or one; this one takes a tenth of a second or more


def test_everything_is_explained_and_typed():
    from antilock import _antilock
    stub = {node.name: node for node in ast.parse(Path(_antilock.__file__).with_name("_antilock.pyi").read_text()).body
            if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(stub) | {"Truth"} == {name for name in dir(_antilock) if not name.startswith("_")}
    for name in ("Problem", "Solution", "Diagnosis", "ExactSolution"):
        listed = {getattr(part, "name", getattr(getattr(part, "target", None), "id", None)) for part in stub[name].body}
        assert {part for part in dir(getattr(_antilock, name)) if not part.startswith("_")} <= listed
    for name in antilock.__all__:
        assert inspect.getdoc(getattr(antilock, name)), name
