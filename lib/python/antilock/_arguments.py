"""The arguments of the module: each is what its function documents, or an Error of one line says what is accepted.

Nothing is guessed: a text is no number, True is no 1, an array of another shape is not flattened, an object that numpy
would wrap (a set, a generator) is no array.
"""
from __future__ import annotations

import contextlib
import math
import numbers
import os
from typing import Any, Callable, Iterator, Mapping

import numpy as np
from scipy import sparse

from ._antilock import Error

LARGEST_INDEX = 2**31 - 1  # of a row, a column or an entry: the library counts with 32 bits


def _shown(given: Any) -> str:
    """A short text of one line, whatever the object does when it is asked for its own."""
    try:
        text = " ".join(repr(given).split())
    except Exception:
        text = object.__repr__(given)
    text = text.encode("ascii", "replace").decode()
    return text if len(text) <= 60 else f"{type(given).__name__}"


def refused(name: str, why: str, accepted: str) -> Error:
    return Error(f"{name} {why}; accepted: {accepted}")


@contextlib.contextmanager
def _named(name: str, accepted: str) -> Iterator[None]:
    """What numpy and scipy raise for an object that is no array becomes an Error."""
    try:
        yield
    except Error:
        raise
    except Exception as failure:
        first = (str(failure).splitlines() or [""])[0][:100]
        raise refused(name, f"cannot be read: {first or type(failure).__name__}", accepted) from None


def number(name: str, given: Any, accepted: str = "a real number") -> float:
    if isinstance(given, np.ndarray) and given.shape == ():
        given = given[()]
    if isinstance(given, (bool, np.bool_)) or not isinstance(given, numbers.Real):
        raise refused(name, f"= {_shown(given)}", accepted)
    with _named(name, accepted):
        value = float(given)
        if math.isnan(value):
            raise refused(name, "= nan", accepted)
        return value


def flag(name: str, given: Any) -> bool:
    if not isinstance(given, (bool, np.bool_)):
        raise refused(name, f"= {_shown(given)}", "True or False")
    return bool(given)


def text(name: str, given: Any, accepted: str = "a text") -> str:
    if not isinstance(given, str):
        raise refused(name, f"is {_shown(given)}", accepted)
    try:
        given.encode()
    except UnicodeEncodeError:
        raise refused(name, "has a sign that is no Unicode", accepted) from None
    return given


def scene(given: Any) -> str:
    return text("scene", given, "the text of a scene file, such as pathlib.Path(name).read_text()")


def folder(given: Any) -> str:
    accepted = "the path of a folder"
    with _named("folder", accepted):
        path = text("folder", os.fspath(given), accepted)
        if "\0" in path:
            raise refused("folder", "has a zero in it", accepted)
        return path


def _real(name: str, array: Any, accepted: str) -> None:
    if array.dtype.kind == "c":
        raise refused(name, "is complex", "real numbers")
    if array.dtype.kind not in "iuf":
        raise refused(name, f"has entries of the type {array.dtype}", accepted)


def numbers_of(name: str, given: Any) -> np.ndarray:
    """Real numbers of any shape, a number alone too, as doubles."""
    accepted = "a real number, or an array or list of them"
    if isinstance(given, (str, bytes)) or sparse.issparse(given) or np.ma.is_masked(given):
        raise refused(name, f"is {_shown(given)}", accepted)
    with _named(name, accepted):
        array = np.asarray(given)
        if array.size == 0 and array.dtype.kind == "f":
            return array
        if array.shape == () and array.dtype.kind not in "iufc":
            raise refused(name, f"is {_shown(given)}", accepted)
        _real(name, array, accepted)
        return array.astype(float)


def points(x: Any, y: Any) -> tuple[np.ndarray, np.ndarray]:
    """x and y as they broadcast."""
    with _named("x and y", "numbers, or arrays that broadcast to one shape"):
        return np.broadcast_arrays(numbers_of("x", x), numbers_of("y", y))


def vector(name: str, given: Any, size: int, none: float | None = None) -> np.ndarray:
    """`size` real numbers, a column or a row of a matrix too; `none` stands for each where None is given."""
    accepted = f"{size} real numbers, an array or a list"
    if given is None and none is not None:
        return np.full(size, none)
    array = numbers_of(name, given) if given is not None else np.asarray(None)
    if array.dtype.kind != "f" or array.ndim not in (1, 2) or (array.ndim == 2 and 1 not in array.shape):
        raise refused(name, f"is {_shown(given)}" if array.ndim == 0 else f"has the shape {array.shape}", accepted)
    if array.size != size:
        raise refused(name, f"has {array.size} entries", str(size))
    if np.isnan(array).any():
        raise refused(name, f"has a nan at {int(np.flatnonzero(np.isnan(array.ravel()))[0])}", accepted)
    return array.ravel()


def matrix(name: str, given: Any, kind: Callable[..., Any]) -> Any:
    """A copy as a sparse matrix of scipy, of that kind, with its entries in order and each place once."""
    accepted = "a matrix of real numbers, scipy's, numpy's or a list of rows"
    if not sparse.issparse(given):
        array = numbers_of(name, given) if given is not None else np.asarray(None)
        if array.ndim != 2:
            raise refused(name, f"has {array.ndim} dimensions", accepted)
        given = array
    _real(name, given, accepted)
    with _named(name, accepted):
        if len(given.shape) != 2:
            raise refused(name, f"has {len(given.shape)} dimensions", accepted)
        if max(given.shape) > LARGEST_INDEX:
            raise refused(name, f"has the shape {given.shape}", f"at most {LARGEST_INDEX} rows and columns")
        # an index out of range would be followed
        if hasattr(given, "check_format"):
            given.check_format(full_check=True)
        elif sparse.issparse(given) and given.format == "coo":
            given = sparse.coo_matrix((given.data, (given.row, given.col)), shape=given.shape)
        copy = kind(given, dtype=float, copy=True)
        copy.sum_duplicates()
        if copy.nnz > LARGEST_INDEX:
            raise refused(name, f"has {copy.nnz} entries", f"at most {LARGEST_INDEX}")
        return copy


def unknowns(name: str, given: Any, size: int) -> dict[int, float]:
    """A mapping from unknowns, 0 to size - 1, to real numbers."""
    accepted = "a mapping from unknowns to their values, such as dict.fromkeys([0, 4], 0.0)"
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise refused(name, f"is {_shown(given)}", accepted)
    held: dict[int, float] = {}
    with _named(name, accepted):
        for key, value in given.items():
            if isinstance(key, (bool, np.bool_)) or not isinstance(key, numbers.Integral):
                raise refused(name, f"has the unknown {_shown(key)}", accepted)
            if not 0 <= key < size:
                raise Error(f"{name}: unknown {_shown(key)} is out of range; accepted: 0 to {size - 1}")
            held[int(key)] = number(f"{name}[{int(key)}]", value, "a real number")
    return dict(sorted(held.items()))


def problem(name: str, given: Any, kind: type) -> Any:
    if not isinstance(given, kind):
        raise refused(name, f"is {_shown(given)}", "a Problem, by Problem(...) or assemble(...)")
    return given
