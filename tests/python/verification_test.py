"""A benchmark of tutorials/guides/verification.md: a clamped arch in its thin limit."""
import numpy as np
import pytest

import antilock


GAUSS = [0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5]  # exact for the squares of the strains of P1
MIDPOINT = [0.5]


def arch(elements, thickness, membrane_points, shear_points=MIDPOINT):
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
        for s in membrane_points:
            row, value = np.zeros(n), np.array([1 - s, s])
            row[u], row[w] = slope, value
            rows.append(row)
            weights.append(h / len(membrane_points))
        for s in shear_points:
            row, value = np.zeros(n), np.array([1 - s, s])
            row[w], row[u], row[b] = slope, -value, -value
            rows.append(row)
            weights.append(h / len(shear_points))
    load = np.zeros(n)
    load[-2] = 1
    found = antilock.solve(a1, np.array(rows), np.array(weights), load, compliance=thickness**2,
                           fixed={0: 0, 1: 0, 2: 0})
    return found.u[-2]


@pytest.mark.parametrize("thickness", [1, 0.1, 1e-3])
def test_a_thin_arch_locks_with_exact_membrane_strains(thickness):
    exact = np.pi / 4 * (1 + 2 * thickness**2)  # Castigliano: bending, membrane and shear
    assert arch(32, thickness, MIDPOINT) == pytest.approx(exact, rel=2e-3)  # h^2 = 2.4e-3
    if thickness == 1e-3:
        assert arch(32, thickness, GAUSS) < 0.01 * exact  # membrane locking alone
        assert arch(32, thickness, MIDPOINT, GAUSS) < 0.01 * exact  # shear locking alone
        assert arch(32, 0, MIDPOINT) == pytest.approx(np.pi / 4, rel=2e-3)  # the limit


def test_an_arch_has_the_deflection_of_another_program():
    # both forms in one dense matrix, which costs 1e6 eps at the smaller thickness
    assert arch(8, 0.1, GAUSS, GAUSS) == pytest.approx(0.5526505, rel=1e-6)
    assert arch(8, 1e-3, MIDPOINT) == pytest.approx(0.7753933, rel=1e-6)
    assert arch(32, 1e-3, MIDPOINT) == pytest.approx(0.7847693, rel=1e-6)
    assert arch(8, 1e-3, GAUSS) == pytest.approx(0.000483388, rel=1e-5)
    assert arch(32, 1e-3, GAUSS) == pytest.approx(0.00744534, rel=1e-5)
