#include "support/exact_rational.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

namespace antilock::test {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Number = boost::multiprecision::cpp_rational;
using Vector = std::vector<Number>;
using Matrix = std::vector<Vector>;  // rows

Matrix zeros(std::size_t rows, std::size_t columns) {
  return Matrix(rows, Vector(columns, Number(0)));
}

/// Gauss-Jordan on the first `columns` columns: the column of each pivot row; rows beyond have
/// zeros there.
std::vector<std::size_t> reduce(Matrix& a, std::size_t columns) {
  std::vector<std::size_t> pivots;
  for (std::size_t column = 0; column < columns && pivots.size() < a.size(); ++column) {
    const std::size_t row = pivots.size();
    std::size_t found = row;
    while (found < a.size() && a[found][column] == 0) ++found;
    if (found == a.size()) continue;
    std::swap(a[row], a[found]);
    const Number inverse = 1 / a[row][column];
    for (Number& entry : a[row]) entry *= inverse;
    for (std::size_t other = 0; other < a.size(); ++other) {
      if (other == row || a[other][column] == 0) continue;
      const Number factor = a[other][column];
      for (std::size_t k = column; k < a[row].size(); ++k) a[other][k] -= factor * a[row][k];
    }
    pivots.push_back(column);
  }
  return pivots;
}

/// The numbers times the least whole number that makes all of them whole.
std::vector<Integer> whole(const Vector& numbers) {
  Integer common = 1;
  for (const Number& x : numbers)
    if (common % denominator(x) != 0) common = lcm(common, denominator(x));
  std::vector<Integer> multiples;
  multiples.reserve(numbers.size());
  for (const Number& x : numbers) multiples.push_back(numerator(x) * (common / denominator(x)));
  return multiples;
}

/// x_i = numerators[i] / denominator, denominator > 0.
struct Fractions {
  std::vector<Integer> numerators;
  Integer denominator;
};

/// The solution of a square system; empty where it is singular. Gauss-Jordan without fractions
/// (Bareiss): what a step divides by is a factor of every entry. Fractions would be reduced at each
/// operation, and that takes ten times as long.
std::optional<Fractions> solve(const Matrix& a, const Vector& b) {
  const std::size_t n = b.size();
  std::vector<std::vector<Integer>> rows;
  for (std::size_t i = 0; i < n; ++i) {
    Vector row = a[i];
    row.push_back(b[i]);
    rows.push_back(whole(row));
  }
  Integer last = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t found = k;
    while (found < n && rows[found][k] == 0) ++found;
    if (found == n) return std::nullopt;
    std::swap(rows[k], rows[found]);
    const Integer pivot = rows[k][k];
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const Integer factor = rows[i][k];
      for (std::size_t j = k + 1; j <= n; ++j)
        rows[i][j] = (pivot * rows[i][j] - factor * rows[k][j]) / last;
    }
    last = pivot;
  }
  Fractions x{{}, abs(last)};  // the diagonal is `last` in every row by now
  for (std::size_t i = 0; i < n; ++i)
    x.numerators.push_back(last < 0 ? Integer(-rows[i][n]) : rows[i][n]);
  return x;
}

bool positive_definite(Matrix a) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k][k] <= 0) return false;
    for (std::size_t i = k + 1; i < a.size(); ++i) {
      const Number factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < a.size(); ++j) a[i][j] -= factor * a[k][j];
    }
  }
  return true;
}

/// c z >= bound, one side of bound number `number`; a side that bears `most` gives way to more.
struct Side {
  Vector c;
  Number bound;
  int number;
  std::optional<Number> most;
};

/// What a side does: nothing (its condition holds), it holds (0 <= force <= most), it has given way
/// (force = most).
enum State { idle, holds, gave_way };

/// The next of all sets of states; false after the last.
bool next_set(std::vector<State>& states, const std::vector<Side>& sides) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const State last = sides[i].most ? gave_way : holds;
    if (states[i] != last) {
      states[i] = static_cast<State>(states[i] + 1);
      return true;
    }
    states[i] = idle;
  }
  return false;
}

/// Whether two sides of one bound do something: where both hold they depend on each other.
bool both_sides(const std::vector<State>& states, const std::vector<Side>& sides) {
  for (std::size_t k = 1; k < sides.size(); ++k)
    if (states[k] != idle && states[k - 1] != idle && sides[k].number == sides[k - 1].number)
      return true;
  return false;
}

/// min z' h z / 2 - g' z + the work of the sides that give way, subject to the others, by trying
/// all sets of states. Two sides of one number are neighbours.
std::optional<Vector> minimise(const Matrix& h, const Vector& g, const std::vector<Side>& sides) {
  const std::size_t n = g.size();
  std::vector<State> states(sides.size(), idle);
  std::vector<std::vector<Integer>> whole_sides;  // c and bound
  for (const Side& side : sides) {
    Vector row = side.c;
    row.push_back(side.bound);
    whole_sides.push_back(whole(row));
  }
  do {
    std::vector<std::size_t> held;
    Vector rhs = g;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      if (states[i] == holds) held.push_back(i);
      if (states[i] == gave_way)
        for (std::size_t j = 0; j < n; ++j) rhs[j] += *sides[i].most * sides[i].c[j];
    }
    if (held.size() > n || both_sides(states, sides)) continue;
    Matrix kkt = zeros(n + held.size(), n + held.size());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) kkt[i][j] = h[i][j];
    for (std::size_t k = 0; k < held.size(); ++k) {
      for (std::size_t i = 0; i < n; ++i) {
        kkt[n + k][i] = sides[held[k]].c[i];
        kkt[i][n + k] = -sides[held[k]].c[i];
      }
      rhs.push_back(sides[held[k]].bound);
    }
    const std::optional<Fractions> x = solve(kkt, rhs);
    if (!x) continue;  // dependent bounds: a smaller set does as well
    bool right = true;
    for (std::size_t k = 0; k < held.size(); ++k) {
      const Integer& force = x->numerators[n + k];
      const std::optional<Number>& most = sides[held[k]].most;
      right = right && force >= 0 &&
              (!most || force * denominator(*most) <= numerator(*most) * x->denominator);
    }
    for (std::size_t i = 0; right && i < sides.size(); ++i) {
      Integer above = -whole_sides[i][n] * x->denominator;
      for (std::size_t j = 0; j < n; ++j) above += whole_sides[i][j] * x->numerators[j];
      right = states[i] == gave_way ? above <= 0 : above >= 0;
    }
    if (!right) continue;
    Vector z;
    for (std::size_t j = 0; j < n; ++j) z.emplace_back(x->numerators[j], x->denominator);
    return z;
  } while (next_set(states, sides));
  return std::nullopt;
}

}  // namespace

ExactAnswer exact_answer(const VariationalInequality& problem) {
  const auto size = static_cast<std::size_t>(problem.size());
  const Eigen::MatrixXd a1 = problem.a1, b = problem.b;
  std::vector<int> place(size, 0);
  for (const int i : problem.dirichlet_dofs) place[i] = -1;
  std::vector<int> free;
  for (std::size_t i = 0; i < size; ++i)
    if (place[i] == 0) {
      place[i] = static_cast<int>(free.size());
      free.push_back(static_cast<int>(i));
    }
  const std::size_t n = free.size(), rows = b.rows();
  Vector u(size, Number(0));
  for (std::size_t k = 0; k < problem.dirichlet_dofs.size(); ++k)
    u[problem.dirichlet_dofs[k]] = Number(problem.dirichlet_values(static_cast<Eigen::Index>(k)));

  // a = A1 + weight B' M B of all unknowns
  const auto sum = [&](const Number& weight) {
    Matrix a = zeros(size, size);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        a[i][j] = Number(a1(i, j));
        for (std::size_t r = 0; r < rows; ++r)
          a[i][j] += weight * Number(problem.m(r)) * Number(b(r, i)) * Number(b(r, j));
      }
    return a;
  };
  const Matrix held = sum(1);
  Matrix on_free = zeros(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) on_free[i][j] = held[free[i]][free[j]];
  ExactAnswer answer;
  if (!positive_definite(on_free)) return answer;
  answer.what = Exactly::infeasible;

  // u = start + basis z: all free unknowns, or the solutions of B u = 0
  Matrix basis = zeros(n, n);
  Vector start(n, Number(0));
  for (std::size_t i = 0; i < n; ++i) basis[i][i] = 1;
  const bool limit = problem.compliance == 0 && rows > 0;
  if (limit) {
    Matrix equations = zeros(rows, n + 1);
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t i = 0; i < n; ++i) equations[r][i] = Number(b(r, free[i]));
      for (const int i : problem.dirichlet_dofs) equations[r][n] -= Number(b(r, i)) * u[i];
    }
    const std::vector<std::size_t> pivots = reduce(equations, n);
    for (std::size_t r = pivots.size(); r < rows; ++r)
      if (equations[r][n] != 0) return answer;
    std::vector<char> is_pivot(n, 0);
    for (std::size_t r = 0; r < pivots.size(); ++r) {
      is_pivot[pivots[r]] = 1;
      start[pivots[r]] = equations[r][n];
    }
    Matrix columns;
    for (std::size_t i = 0; i < n; ++i) {
      if (is_pivot[i]) continue;
      Vector column(n, Number(0));
      column[i] = 1;
      for (std::size_t r = 0; r < pivots.size(); ++r) column[pivots[r]] = -equations[r][i];
      columns.push_back(column);
    }
    basis = zeros(n, columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (std::size_t i = 0; i < n; ++i) basis[i][k] = columns[k][i];
  }
  const Matrix a = sum(limit || rows == 0 ? Number(0) : Number(1 / Number(problem.compliance)));
  for (std::size_t i = 0; i < n; ++i) u[free[i]] = start[i];
  const std::size_t dimension = basis.empty() ? 0 : basis[0].size();
  Matrix h = zeros(dimension, dimension), a_basis = zeros(n, dimension);
  Vector g(dimension, Number(0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < dimension; ++k)
      for (std::size_t j = 0; j < n; ++j) a_basis[i][k] += a[free[i]][free[j]] * basis[j][k];
  for (std::size_t i = 0; i < n; ++i) {
    Number force = Number(problem.load(free[i]));
    for (std::size_t j = 0; j < size; ++j) force -= a[free[i]][j] * u[j];
    for (std::size_t k = 0; k < dimension; ++k) {
      g[k] += basis[i][k] * force;
      for (std::size_t l = 0; l < dimension; ++l) h[k][l] += basis[i][k] * a_basis[i][l];
    }
  }
  std::vector<Side> sides;
  const Eigen::MatrixXd constraints = problem.bounds.constraints;
  for (int k = 0; k < problem.bounds.count(); ++k) {
    const int contact = static_cast<int>(problem.bounds.unknowns.size());
    Vector row(dimension, Number(0));
    Number start_value = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const Number entry = k < contact ? Number(static_cast<int>(i) == problem.bounds.unknowns[k])
                                       : Number(constraints(k - contact, i));
      if (entry == 0) continue;
      start_value += entry * u[i];
      if (place[i] < 0) continue;
      for (std::size_t l = 0; l < dimension; ++l) row[l] += entry * basis[place[i]][l];
    }
    const auto add = [&](int sign, double value) {
      if (std::isinf(value)) return;
      Side side{row, sign * (Number(value) - start_value), k, std::nullopt};
      for (Number& entry : side.c) entry *= sign;
      if (std::isfinite(problem.bounds.force_limit(k)))
        side.most = Number(problem.bounds.force_limit(k));
      sides.push_back(side);
    };
    add(1, problem.bounds.lower(k));
    add(-1, problem.bounds.upper(k));
  }
  const std::optional<Vector> z = minimise(h, g, sides);
  if (!z) return answer;
  answer.what = Exactly::solved;
  answer.u.resize(problem.size());
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < dimension; ++k) u[free[i]] += basis[i][k] * (*z)[k];
  for (std::size_t i = 0; i < size; ++i)
    answer.u(static_cast<Eigen::Index>(i)) = static_cast<double>(u[i]);
  return answer;
}

}  // namespace antilock::test
