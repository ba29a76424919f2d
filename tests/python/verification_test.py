"""A benchmark of tutorials/guides/verification.md: a clamped arch in its thin limit."""
import numpy as np
import pytest

import antilock


def arch(elements, thickness, points):
    """The radial deflection at the free end of a quarter ring under a unit radial force there.

    The ring has the radius 1. Unknowns per node: tangential u, radial w, rotation b. The energy is
    half of int b'^2 + thickness^-2 ((u' + w)^2 + (w' - u - b)^2): bending, membrane strain and
    shear strain.
    """
    h, n = np.pi / 2 / elements, 3 * (elements + 1)
    a1, rows, weights = np.zeros((n, n)), [], []
    for i in range(elements):
        u, w, b = (np.array([3 * i + k, 3 * i + 3 + k]) for k in range(3))
        slope = np.array([-1, 1]) / h
        a1[np.ix_(b, b)] += h * np.outer(slope, slope)
        for s in points:
            value = np.array([1 - s, s])
            membrane, shear = np.zeros(n), np.zeros(n)
            membrane[u], membrane[w] = slope, value
            shear[w], shear[u], shear[b] = slope, -value, -value
            rows += [membrane, shear]
            weights += 2 * [h / len(points)]
    load = np.zeros(n)
    load[-2] = 1
    found = antilock.solve(a1, np.array(rows), np.array(weights), load, compliance=thickness**2,
                           fixed={0: 0, 1: 0, 2: 0})
    return found.u[-2]


GAUSS = [0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5]  # exact for the strains of P1
MIDPOINT = [0.5]


@pytest.mark.parametrize("thickness", [1, 0.1, 1e-3])
def test_a_thin_arch_locks_with_exact_membrane_strains_alone(thickness):
    exact = np.pi / 4 * (1 + 2 * thickness**2)  # Castigliano: bending, membrane and shear
    assert arch(32, thickness, MIDPOINT) == pytest.approx(exact, rel=2e-3)  # h^2 = 2.4e-3
    if thickness == 1e-3:
        assert arch(32, thickness, GAUSS) < 0.01 * exact
        assert arch(32, 0, MIDPOINT) == pytest.approx(np.pi / 4, rel=2e-3)  # the limit


def test_an_arch_has_the_deflection_of_another_program():
    # 8 elements, both forms in one dense matrix
    assert arch(8, 0.1, GAUSS) == pytest.approx(0.553, rel=2e-3)
    assert arch(8, 1e-3, MIDPOINT) == pytest.approx(0.775393, rel=1e-5)
    assert arch(32, 1e-3, MIDPOINT) == pytest.approx(0.784769, rel=1e-5)
    assert arch(8, 1e-3, GAUSS) == pytest.approx(0.000204, rel=1e-2)
    assert arch(32, 1e-3, GAUSS) == pytest.approx(0.00324, rel=1e-2)
