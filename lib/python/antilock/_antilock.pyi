# Types of the compiled part; shapes stand in the docstrings.
from typing import Any, Sequence

from numpy import ndarray
from numpy.typing import ArrayLike

__version__: str

class Error(ValueError): ...
class NotConverged(Error): ...

class Problem:
    compliance: float
    a1: Any
    b: Any
    m: ndarray
    own_compliances: ndarray
    load: ndarray
    fixed: list[int]
    contact: list[int]
    def __init__(self, a1: Any, b: Any, m: ndarray, load: ndarray, compliance: float, fixed: Sequence[int],
                 fixed_values: ArrayLike, contact: Sequence[int], lower: ndarray, upper: ndarray,
                 force_limit: ArrayLike | None) -> None: ...
    def solve(self, tolerance: float = 1e-10) -> Solution: ...

class Solution:
    u: ndarray
    p: ndarray
    lambda_: ndarray
    active: list[bool]
    energy: float
    error: float
    residual: float
    corrections: int
    warning: str

class Diagnosis:
    locks: bool
    coarse: int
    fine: int

class ExactSolution:
    energy: float
    contact: list[tuple[float, float]]
    def __init__(self, epsilon: float, load: str, contact: bool) -> None: ...
    def __call__(self, x: ArrayLike, y: ArrayLike) -> ndarray: ...
    def u_x(self, x: ArrayLike, y: ArrayLike) -> ndarray: ...
    def u_y(self, x: ArrayLike, y: ArrayLike) -> ndarray: ...
    def p(self, x: ArrayLike, y: ArrayLike) -> ndarray: ...
    def pressure(self, x: ArrayLike) -> ndarray: ...

Truth = ExactSolution  # the name in 0.2

def without_void_bound(bound: ArrayLike) -> Any: ...
def diagnose(coarse: Problem, fine: Problem) -> Diagnosis: ...
def assemble(scene: str, folder: str) -> Problem: ...
def run(scene: str, folder: str) -> tuple[dict[str, ndarray], str]: ...
def certify(scene: str, accuracy: float, folder: str) -> dict[str, Any]: ...
