"""Arrays and matrices as other programs hand them over. Each case was made after a public report, named beside it
(tests/README.md lists them): the answer is that of the plain arrays, or an Error of one line says what is accepted."""
import gc
import multiprocessing
import os
import subprocess
import sys

import numpy as np
import pytest
import scipy.sparse as sparse

import antilock

N = 6
A1 = 2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1)
B = np.array([[1.0, -1, 0, 0, 0, 0], [0, 1, -1, 0, 0, 0]])
M, LOAD = np.array([1.0, 2]), np.array([1.0, -2, 3, 4, -5, 6])
BOUNDED = dict(compliance=1e-3, fixed={0: 0.0}, lower=np.r_[np.full(3, -np.inf), np.zeros(3)])


def solved(a1=A1, b=B, m=M, load=LOAD):
    return antilock.solve(a1, b, m, load, **BOUNDED).u


PLAIN = solved().copy()


def every_second(array):
    """The same entries, of an array twice as large in each direction."""
    larger = np.full([2 * n for n in array.shape], 7.0)
    view = larger[tuple([slice(None, None, 2)] * array.ndim)]
    view[...] = array
    return view


def field(array):
    """The same entries as a field of a packed record: their distance is no multiple of 8 bytes."""
    records = np.zeros(array.shape, dtype=[("of", "f8"), ("with", "i1")])
    records["of"] = array
    return records["of"]


# pybind11 #267, #782 and #6164, fwilliams/numpyeigen #40, stack-of-tasks/eigenpy #638: the memory is read in another order.
@pytest.mark.parametrize("change", [np.asfortranarray, every_second, field, lambda a: a.astype(">f8"),
                                    lambda a: a.astype(int), lambda a: a[::-1].copy()[::-1]])
def test_the_order_in_memory_is_of_no_concern(change):
    assert np.array_equal(solved(change(A1), change(B), change(M), change(LOAD)), PLAIN)


def doubled(matrix):
    """Each entry in two halves, one behind the other."""
    return sparse.csc_matrix((np.repeat(matrix.data / 2, 2), np.repeat(matrix.indices, 2), 2 * matrix.indptr), matrix.shape)


def unsorted(matrix):
    for column in range(matrix.shape[1]):
        entries = slice(matrix.indptr[column], matrix.indptr[column + 1])
        matrix.indices[entries], matrix.data[entries] = matrix.indices[entries][::-1], matrix.data[entries][::-1]
    matrix.has_sorted_indices = False
    return matrix


def with_zeros(matrix):
    full = matrix.tocoo()
    return sparse.coo_matrix((np.r_[full.data, 0, 0], (np.r_[full.row, 0, N - 1], np.r_[full.col, N - 1, 0])), full.shape)


def long_indices(matrix):
    matrix.indices, matrix.indptr = matrix.indices.astype(np.int64), matrix.indptr.astype(np.int64)
    return matrix


# scipy #6079, #8937 and #15226, jax #21031, Deep-MI/LaPy #61: what is stored twice, unsorted, as 0 or with long indices.
@pytest.mark.parametrize("change", [doubled, unsorted, with_zeros, long_indices])
def test_a_sparse_matrix_is_what_it_adds_up_to(change):
    given = change(sparse.csc_matrix(A1))
    before = given.copy()
    assert np.array_equal(solved(a1=given), PLAIN)
    assert (given != before).nnz == 0  # and the caller's is as it was


def index_out_of_range(matrix):
    matrix.indices[0] = 77


def index_below_zero(matrix):
    matrix.indices[0] = -1


def columns_beyond_the_entries(matrix):
    matrix.indptr[2] = 99


# IntelPython/dpnp #2841: scipy makes such a matrix without a word. Its entries were read beyond the end of the memory; so
# this runs in a process of its own.
@pytest.mark.parametrize("spoil", [index_out_of_range, index_below_zero, columns_beyond_the_entries])
def test_a_sparse_matrix_with_broken_indices_is_refused(spoil):
    code = ("import antilock, foreign_arrays_test as t, scipy.sparse as sparse\n"
            f"given = sparse.csc_matrix(t.A1)\nt.{spoil.__name__}(given)\n"
            "try:\n    t.solved(a1=given)\nexcept antilock.Error as refused:\n"
            "    print('refused', str(refused).count('\\n'))\n")
    paths = os.pathsep.join([os.path.dirname(__file__), os.environ.get("PYTHONPATH", "")])
    run = subprocess.run([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": paths}, capture_output=True, text=True)
    assert (run.returncode, run.stdout) == (0, "refused 0\n"), run.stderr


# numpy #26669 and #18675: np.asarray drops a mask, and what it hid counts.
@pytest.mark.parametrize("masked", [{"load": np.ma.masked_array(LOAD, LOAD < 0)}, {"m": np.ma.masked_array(M, M > 1)},
                                    {"a1": np.ma.masked_array(A1, A1 < 0)}])
def test_masked_entries_are_refused(masked):
    with pytest.raises(antilock.Error) as refused:
        solved(**masked)
    assert "\n" not in str(refused.value)


# thelfer/MFrontGenericInterfaceSupport #290, pybind11 #4236, psi4 #751: views whose owner is gone.
def test_arrays_outlive_what_they_belong_to():
    problem = antilock.Problem(A1, B, M, LOAD, **BOUNDED)
    solution = problem.solve()
    u, load, m = solution.u, problem.load, problem.m
    del problem, solution
    gc.collect()
    taken = [np.full(N, 7.0) for _ in range(1000)]  # the memory, had it been given back
    assert np.array_equal(u, PLAIN) and np.array_equal(load, LOAD) and np.array_equal(m, M) and len(taken) == 1000


def test_what_was_given_may_change_afterwards():
    a1, load = A1.copy(), LOAD.copy()
    problem = antilock.Problem(a1, B, M, load, **BOUNDED)
    a1[:], load[:] = 0, 0
    assert np.array_equal(problem.solve().u, PLAIN)


# OpenBLAS #240 and #294, libKriging #325: a process that is forked after the first solve waits for ever.
def test_a_process_that_is_forked_later_solves():
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for u in pool.map_async(_of_a_fork, range(4)).get(60):
            assert np.array_equal(u, PLAIN)


def _of_a_fork(_):
    return solved()
