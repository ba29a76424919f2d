#!/usr/bin/python3
"""The second opinion on chapter 40: Q1 with its switches and the rotated element, written from
their definitions in plain Python. Nothing of the library is used.

    independent.py FOLDER

FOLDER is an output folder of 40_switches. Its vertices.csv and cells.csv are a mesh of
quadrilaterals, and second_opinion.csv has u in contact at each unknown for each switch. This
program assembles problem (23) on the same mesh, solves the inequality, and compares.
"""
import csv
import math
import sys

EPSILON = 0.01
# Both programs solve systems whose condition is some h^-2 EPSILON^-2 = 1e6. The differences are
# below 1e-12 of the largest u (measured), and ten times as much is accepted.
ACCEPTED = 1e-11

GAUSS = {
    1: [(0.5, 1.0)],
    2: [(0.5 - math.sqrt(1 / 12), 0.5), (0.5 + math.sqrt(1 / 12), 0.5)],
    3: [(0.5 - math.sqrt(0.15), 5 / 18), (0.5, 8 / 18), (0.5 + math.sqrt(0.15), 5 / 18)],
}


def square_rule(n):
    return [(s, t, v * w) for s, v in GAUSS[n] for t, w in GAUSS[n]]


def bilinear(s, t):
    """Values and slopes of the four vertex functions."""
    return ([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t],
            [(t - 1, s - 1), (1 - t, -s), (t, s), (-t, 1 - s)])


def rotated(s, t):
    """The functions of 1, S, T, S^2 - T^2 with mean 1 over one edge and 0 over the others, and
    S T, all in the unknowns of the library: the four of the edges lose a quarter of S T."""
    a, b = 2 * s - 1, 2 * t - 1
    values, slopes = [], []
    for sign, along, across, first in ((-1, 0, 1, -1), (1, 1, 0, 1), (1, 0, 1, -1), (-1, 1, 0, 1)):
        value = 0.25 + sign * (a if along else b) / 2 + first * 0.375 * (a * a - b * b)
        by_a = (sign / 2 if along else 0) + first * 0.75 * a - 0.25 * b
        by_b = (sign / 2 if across else 0) - first * 0.75 * b - 0.25 * a
        values.append(value - 0.25 * a * b)
        slopes.append((2 * by_a, 2 * by_b))
    return values + [a * b], slopes + [(2 * b, 2 * a)]


class Cell:
    def __init__(self, corners):
        self.corners = corners

    def at(self, functions, s, t):
        """Place, area factor, values and gradients by x and y of the functions."""
        shape, slopes = bilinear(s, t)
        x = [sum(n * c[k] for n, c in zip(shape, self.corners)) for k in (0, 1)]
        j = [[sum(d[m] * c[k] for d, c in zip(slopes, self.corners)) for m in (0, 1)]
             for k in (0, 1)]  # dx_k / dxi_m
        det = j[0][0] * j[1][1] - j[0][1] * j[1][0]
        values, derivatives = functions(s, t)
        gradients = [((d[0] * j[1][1] - d[1] * j[1][0]) / det,
                      (d[1] * j[0][0] - d[0] * j[0][1]) / det) for d in derivatives]
        return x, det, values, gradients


def hourglass(cell, kx, ky):
    """The row of the hourglass part and its weight."""
    h = (1, -1, 1, -1)
    _, _, _, centre = cell.at(bilinear, 0.5, 0.5)
    moment = [sum(hi * c[k] for hi, c in zip(h, cell.corners)) for k in (0, 1)]
    row = [(h[i] - moment[0] * centre[i][0] - moment[1] * centre[i][1]) / 4 for i in range(4)]
    weight = 0
    for s, t, w in square_rule(2):
        _, det, _, gradients = cell.at(bilinear, s, t)
        slope = [sum(hi * g[k] for hi, g in zip(h, gradients)) for k in (0, 1)]  # of S T
        weight += w * det * (kx * slope[0] ** 2 + ky * slope[1] ** 2)
    return row, weight


class Method:
    """points of A1, points of B (0: the mean over the cell), stabilised, the element."""

    def __init__(self, gradient, strain, stabilised=False, functions=bilinear):
        self.gradient, self.strain = gradient, strain
        self.stabilised, self.functions = stabilised, functions


METHODS = {
    "full": Method(2, 2),
    "selective": Method(2, 1),
    "B-bar": Method(2, 0),
    "reduced": Method(1, 1),
    "stabilised": Method(1, 1, stabilised=True),
    "rotated, means": Method(2, 0, functions=rotated),
}


def numbering(cells, vertices, functions):
    """The unknowns of each cell, their number, those that are 0, and those on the bottom."""
    held = lambda p: p[0] < 1e-9 or p[0] > 1 - 1e-9 or p[1] > 1 - 1e-9
    low = lambda p: p[1] < -1 + 1e-9
    if functions is bilinear:
        fixed = {i for i, p in enumerate(vertices) if held(p)}
        bottom = {i for i, p in enumerate(vertices) if low(p)} - fixed
        return cells, len(vertices), fixed, bottom
    number, unknowns, count = {}, [], {}
    for cell in cells:
        own = []
        for k in range(4):
            edge = tuple(sorted((cell[k], cell[(k + 1) % 4])))
            own.append(number.setdefault(edge, len(number) + len(unknowns)))
            count[edge] = count.get(edge, 0) + 1
        own.append(len(number) + len(unknowns))
        unknowns.append(own)
    fixed, bottom = set(), set()
    for edge, cells_at in count.items():
        middle = [(vertices[edge[0]][k] + vertices[edge[1]][k]) / 2 for k in (0, 1)]
        if cells_at == 1:
            (bottom if low(middle) else fixed).add(number[edge])
    return unknowns, len(number) + len(unknowns), fixed, bottom


def assemble(method, cells, regions, vertices, unknowns, size):
    """The matrix A1 + EPSILON^-2 B' M B as dictionaries of rows, and the load 10 sin 2 pi x."""
    matrix, load = [{} for _ in range(size)], [0.0] * size

    def add(dofs, row, weight):
        for i, a in zip(dofs, row):
            for j, b in zip(dofs, row):
                matrix[i][j] = matrix[i].get(j, 0.0) + weight * a * b

    for corners, region, dofs in zip(cells, regions, unknowns):
        cell = Cell([vertices[v] for v in corners])
        in_layer = region == 2
        for s, t, w in square_rule(method.gradient):
            _, det, _, gradients = cell.at(method.functions, s, t)
            add(dofs, [g[0] for g in gradients], w * det)
            if not in_layer:
                add(dofs, [g[1] for g in gradients], w * det)
        if method.stabilised:
            add(dofs, *hourglass(cell, 1, 0 if in_layer else 1))
        if in_layer:
            rows = []
            for s, t, w in square_rule(method.strain or 2):
                _, det, _, gradients = cell.at(method.functions, s, t)
                rows.append((w * det, [g[1] for g in gradients]))
            if method.strain == 0:
                area = sum(weight for weight, _ in rows)
                rows = [(area, [sum(weight * row[i] for weight, row in rows) / area
                                for i in range(len(dofs))])]
            for weight, row in rows:
                add(dofs, row, weight / EPSILON ** 2)
        else:
            for s, t, w in square_rule(3):
                x, det, values, _ = cell.at(method.functions, s, t)
                for i, value in zip(dofs, values):
                    load[i] += w * det * value * 10 * math.sin(2 * math.pi * x[0])
    return matrix, load


def solve_linear(matrix, load, zero):
    """Gaussian elimination without pivots of a symmetric positive definite matrix, row by row. The
    unknowns in `zero` are 0."""
    free = [i for i in range(len(load)) if i not in zero]
    place = {i: k for k, i in enumerate(free)}
    rows = [{place[j]: a for j, a in matrix[i].items() if j in place} for i in free]
    right = [load[i] for i in free]
    for k, row in enumerate(rows):
        for i in [j for j in row if j > k]:
            factor = row[i] / row[k]
            for j, a in row.items():
                if j >= i:
                    rows[i][j] = rows[i].get(j, 0.0) - factor * a
            right[i] -= factor * right[k]
    for k in range(len(rows) - 1, -1, -1):
        right[k] = (right[k] - sum(a * right[j] for j, a in rows[k].items() if j > k)) / rows[k][k]
    u = [0.0] * len(load)
    for i, k in place.items():
        u[i] = right[k]
    return u


def solve(matrix, load, fixed, bottom):
    """u >= 0 on the bottom, by the active set method."""
    touching = set()
    for _ in range(50):
        u = solve_linear(matrix, load, fixed | touching)
        force = {i: sum(a * u[j] for j, a in matrix[i].items()) - load[i] for i in bottom}
        after = {i for i in bottom if force[i] - 1e3 * u[i] > 0}
        if after == touching:
            return u
        touching = after
    raise SystemExit("independent.py: the active set does not settle")


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def main(folder):
    vertices = [(float(row["x"]), float(row["y"])) for row in read(folder + "/vertices.csv")]
    rows = read(folder + "/cells.csv")
    cells = [[int(row[k]) for k in "abcd"] for row in rows]
    regions = [int(row["region"]) for row in rows]
    theirs = read(folder + "/second_opinion.csv")
    worst = 0.0
    for name, method in METHODS.items():
        unknowns, size, fixed, bottom = numbering(cells, vertices, method.functions)
        matrix, load = assemble(method, cells, regions, vertices, unknowns, size)
        u = solve(matrix, load, fixed, bottom)
        own = [u[i] for dofs in unknowns for i in dofs]
        other = [float(row["u"]) for row in theirs if row["switch"] == name]
        if len(own) != len(other):
            raise SystemExit(f"{name}: {len(own)} values here, {len(other)} there")
        largest = max(abs(value) for value in own)
        difference = max(abs(a - b) for a, b in zip(own, other)) / largest
        worst = max(worst, difference)
        print(f"{name}: largest u {largest:.6g}, difference {difference:.1e} of it")
    if not worst < ACCEPTED:
        raise SystemExit(f"difference {worst:.1e}; accepted: {ACCEPTED:.0e}")


if __name__ == "__main__":
    main(sys.argv[1])
