"""OpenBLAS under a memory limit.

Each thread of OpenBLAS maps a buffer of 128 MB as soon as the library is loaded, and where it gets none it asks again
without end: the process could not even end. Under a limit (ulimit -v, ulimit -d) that is too low for them it is loaded
with one thread, whose buffer the library asks for before it solves.
"""
import contextlib
import os
from typing import Iterator

PROGRAM, THREAD = 450_000_000, 220_000_000  # bytes: Python with scipy and the first buffer; each further thread


def _limit() -> float:
    try:
        import resource
    except ImportError:  # no limits of this kind
        return float("inf")
    limits = [resource.getrlimit(kind)[0] for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA)]
    return min([limit for limit in limits if limit != resource.RLIM_INFINITY], default=float("inf"))


@contextlib.contextmanager
def one_thread_where_memory_is_limited() -> Iterator[None]:
    """The environment is as before at the end. A numpy that was imported before has its threads already."""
    name = "OPENBLAS_NUM_THREADS"
    before = os.environ.get(name)
    if _limit() < PROGRAM + ((os.cpu_count() or 1) - 1) * THREAD:
        os.environ[name] = "1"
    try:
        yield
    finally:
        if before is not None:
            os.environ[name] = before
        else:
            os.environ.pop(name, None)
