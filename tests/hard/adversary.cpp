#include "hard/adversary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "antilock/core/error.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"

namespace antilock::hard {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  bool one_in(int n) { return below(n) == 0; }
  /// 0 to 1; the same on every machine, unlike the standard's distributions
  double uniform() { return engine_() / 4294967296.0; }
  double symmetric() { return 2 * uniform() - 1; }
  /// 10^-decades/2 to 10^decades/2
  double decades(double d) { return std::pow(10.0, d * (uniform() - 0.5)); }

 private:
  std::mt19937 engine_;
};

/// A few binary digits: sums and small multiples of such numbers are exact, often zero or equal.
double few_digits(double x) { return std::round(128 * x) / 128; }

}  // namespace

VariationalInequality random_problem(unsigned seed) {
  Dice dice(seed);
  const int n = 1 + dice.below(6), rows = dice.one_in(4) ? 0 : 1 + dice.below(4);
  const auto spread = [&] { return std::vector{0.0, 0.0, 3.0, 6.0, 12.0}[dice.below(5)]; };
  const double of_a1 = spread(), of_b = spread(), of_m = spread(), of_load = spread(),
               of_bounds = spread();

  Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(
      n, n, [&](auto, auto) { return dice.one_in(3) ? 0.0 : few_digits(dice.symmetric()); });
  Eigen::MatrixXd a1 = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
  const double whole = dice.decades(of_a1);
  const Eigen::VectorXd unit = Eigen::VectorXd::NullaryExpr(
      n, [&](auto) { return dice.one_in(2) ? 1.0 : dice.decades(of_a1 / 2); });
  a1 = whole * (unit.asDiagonal() * a1 * unit.asDiagonal());
  a1 = a1.triangularView<Eigen::Upper>().toDenseMatrix().selfadjointView<Eigen::Upper>();
  if (rows > 0 && dice.one_in(5)) {  // held by B alone
    const int i = dice.below(n);
    a1.row(i).setZero();
    a1.col(i).setZero();
  }

  VariationalInequality problem;
  problem.a1 = a1.sparseView();
  Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(
      rows, n, [&](auto, auto) { return dice.one_in(2) ? 0.0 : few_digits(dice.symmetric()); });
  for (int r = 0; r < rows; ++r) {
    if (r > 0 && dice.one_in(4)) b.row(r) = b.row(0) * (1 + dice.below(3));  // dependent
    if (r > 1 && dice.one_in(4)) b.row(r) = b.row(0) - 2 * b.row(1);         // the same, hidden
    b.row(r) *= dice.one_in(2)
                    ? 1.0
                    : std::exp2(std::round(std::log2(dice.decades(of_b))));  // stays dependent
  }
  problem.b = b.sparseView();
  problem.m = Eigen::VectorXd::NullaryExpr(rows, [&](auto) { return dice.decades(of_m); });
  const int kind = dice.below(8);
  problem.compliance = kind < 3    ? 0
                       : kind == 3 ? 1
                       : kind == 4 ? dice.decades(6)
                                   : std::pow(10.0, -16 * dice.uniform());

  const double size = dice.decades(of_load);
  problem.load = Eigen::VectorXd::NullaryExpr(n, [&](auto) {
    return dice.one_in(4)
               ? 0.0
               : dice.symmetric() * size * (dice.one_in(2) ? 1.0 : dice.decades(of_load));
  });
  if (dice.one_in(12)) problem.load(dice.below(n)) = -std::pow(10.0, 18 * dice.uniform());
  const double far = dice.decades(of_bounds);
  std::vector<int> bounded;
  std::vector<double> values, lower;
  for (int i = 0; i < n; ++i) {
    const int role = dice.below(6);
    const double value =
        few_digits(dice.symmetric()) * far * (dice.one_in(2) ? 1.0 : dice.decades(of_bounds));
    if (role == 0 && static_cast<int>(problem.dirichlet_dofs.size()) < n - 1) {
      problem.dirichlet_dofs.push_back(i);
      values.push_back(dice.one_in(2) ? 0 : value);
    } else if (role < 4) {
      bounded.push_back(i);
      lower.push_back(dice.one_in(3) ? 0 : dice.one_in(2) ? -std::abs(value) : value);
    }
  }
  problem.dirichlet_values =
      Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  problem.bounds = Bounds::lower_on(
      bounded, Eigen::Map<Eigen::VectorXd>(lower.data(), static_cast<Eigen::Index>(lower.size())));
  problem.a1.makeCompressed();
  problem.b.makeCompressed();
  return problem;
}

VariationalInequality random_bounds(unsigned seed) {
  VariationalInequality problem = random_problem(seed);
  Dice dice(seed ^ 0x5bd1e995u);
  const int n = problem.size();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double scale = problem.bounds.lower.size() > 0
                           ? std::max(problem.bounds.lower.cwiseAbs().maxCoeff(), 1e-3)
                           : 1.0;
  std::vector<double> lower(problem.bounds.lower.begin(), problem.bounds.lower.end()),
      upper(lower.size(), infinity);
  // a handful of bounds in all: rational arithmetic tries every set of them
  const int most = 6 - static_cast<int>(problem.bounds.unknowns.size());
  const int rows = problem.free_count() > 0 && !dice.one_in(4) ? std::min(most, dice.below(3)) : 0;
  // most rows keep an unknown to themselves
  for (int row = 0; row < rows && !dice.one_in(10); ++row)
    if (std::ssize(problem.bounds.unknowns) + std::ssize(problem.dirichlet_dofs) + row >= n &&
        !problem.bounds.unknowns.empty()) {
      problem.bounds.unknowns.pop_back();
      lower.erase(lower.begin() + std::ssize(problem.bounds.unknowns));
      upper.pop_back();
    }
  std::set<int> loose;  // neither fixed nor bounded
  for (int j = 0; j < n; ++j) loose.insert(j);
  for (const std::vector<int>* list : {&problem.dirichlet_dofs, &problem.bounds.unknowns})
    for (const int j : *list) loose.erase(j);
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < rows; ++row) {
    const double unit = dice.one_in(2) ? 1 : dice.decades(6);
    const bool again = row > 0 && dice.one_in(20);  // depends on the row before
    const std::vector<Eigen::Triplet<double>> before = entries;
    if (again) {
      for (const auto& entry : before)
        if (entry.row() == row - 1) entries.emplace_back(row, entry.col(), -2 * entry.value());
    } else {
      std::vector<char> named(n, 0);
      for (int k = 0, count = 1 + dice.below(4); k < count || entries.size() == before.size();
           ++k) {
        int j = dice.below(n);
        while (k == 0 && !loose.empty() && loose.count(j) == 0) j = dice.below(n);
        const double value =
            dice.one_in(3) ? (dice.one_in(2) ? 1 : -1) : few_digits(dice.symmetric());
        if (value != 0 && named[j]++ == 0) entries.emplace_back(row, j, value * unit);
      }
    }
    const double value = few_digits(dice.symmetric()) * scale * unit;
    lower.push_back(dice.one_in(3) ? 0 : dice.one_in(2) ? -std::abs(value) : value);
    upper.push_back(infinity);
  }
  RowMatrix constraints(rows, n);
  constraints.setFromTriplets(entries.begin(), entries.end());
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const double size = lower[i] != 0 ? std::abs(lower[i]) : scale;
    const int kind = dice.below(6);
    if (kind == 0 || kind == 1) {  // from above alone
      upper[i] = lower[i];
      lower[i] = -infinity;
    } else if (kind == 2 || kind == 3) {
      upper[i] =
          lower[i] +
          (dice.one_in(6) ? 0 : size * few_digits(dice.uniform()) * (dice.one_in(4) ? 1e-8 : 1));
    }
  }
  const auto given = [](const std::vector<double>& limits) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(limits.data(), static_cast<Eigen::Index>(limits.size())));
  };
  problem.bounds = {problem.bounds.unknowns, {given(lower), given(upper)}, constraints};
  return problem;
}

VariationalInequality random_friction(unsigned seed) {
  VariationalInequality problem = random_bounds(seed);
  Dice dice(seed ^ 0x2545f491u);
  const auto rows = std::min<Eigen::Index>(problem.bounds.constraints.rows(), 4);
  const auto contact = std::min(std::ssize(problem.bounds.unknowns), 4 - rows),
             before = std::ssize(problem.bounds.unknowns);
  const auto kept = [&](const Eigen::VectorXd& bound) {
    Eigen::VectorXd some(contact + rows);
    some << bound.head(contact), bound.segment(before, rows);
    return some;
  };
  std::vector<int> unknowns = problem.bounds.unknowns;
  unknowns.resize(contact);
  const RowMatrix constraints = problem.bounds.constraints.topRows(rows);
  problem.bounds = {
      unknowns, {kept(problem.bounds.lower), kept(problem.bounds.upper)}, constraints};
  Eigen::VectorXd &lower = problem.bounds.lower, &upper = problem.bounds.upper;
  const double size = std::max(problem.load.lpNorm<Eigen::Infinity>(), 1e-6);
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (dice.one_in(4)) continue;
    if (!dice.one_in(3)) lower(i) = upper(i) = dice.one_in(3) ? std::min(lower(i), 1e3) : 0;
    if (std::isinf(lower(i)) && std::isinf(upper(i))) lower(i) = upper(i) = 0;
    problem.bounds.force_limit(i) = dice.one_in(10) ? 0
                                    : dice.one_in(4)
                                        ? std::abs(problem.load(dice.below(problem.size())))
                                    : dice.one_in(2) ? few_digits(dice.uniform()) * size
                                                     : dice.decades(6) * size;
  }
  return problem;
}

VariationalInequality random_corner(unsigned seed) {
  Dice dice(seed ^ 0x9e3779b9u);
  const unsigned kind = seed % 4;
  VariationalInequality problem = kind == 3 ? random_bounds(seed) : random_problem(seed);
  const int n = problem.size(), rows = static_cast<int>(problem.b.rows());
  if (rows == 0) return problem;
  Eigen::MatrixXd a1 = problem.a1, b = problem.b;
  if (kind == 0) {  // B u = g
    for (double& value : problem.dirichlet_values) value = few_digits(dice.symmetric());
    b.row(0).setZero();
    for (const int i : problem.dirichlet_dofs) b(0, i) = 1 + dice.below(3);
  } else if (kind == 1 && rows > 1) {
    a1.setIdentity();  // in other units of an unknown, rows that differ may count as equal
    problem.m.setOnes();
    b.row(rows - 1) = b.row(0);
    b(rows - 1, dice.below(n)) *= 1 + std::exp2(-10 - dice.below(30));
    problem.compliance = 0;
  } else if (kind == 2) {
    const Eigen::VectorXd flat =
        Eigen::VectorXd::NullaryExpr(n, [&](auto) { return few_digits(dice.symmetric()); });
    a1 =
        flat * flat.transpose() + std::exp2(-20 - dice.below(20)) * Eigen::MatrixXd::Identity(n, n);
  }
  if (kind == 0 || kind == 3) problem.compliance = 1e-14;
  problem.a1 = a1.sparseView();
  problem.b = b.sparseView();
  problem.a1.makeCompressed();
  problem.b.makeCompressed();
  return problem;
}

Judgement judge(const VariationalInequality& problem, const test::ExactAnswer& exact, By solver) {
  Judgement judgement;
  const bool solvable = exact.what == test::Exactly::solved;
  try {
    UzawaOptions options;
    options.max_iterations = 20'000;
    const Solution s = solver == By::active_set ? active_set(problem) : uzawa(problem, options);
    judgement.error = std::numeric_limits<double>::infinity();
    if (solvable) {
      const double difference = (s.u - exact.u).lpNorm<Eigen::Infinity>();
      // a locked u tends to 0: then to 1e-15 of its size before it locks; numbers below the
      // smallest normal one are 0
      judgement.error =
          difference < std::numeric_limits<double>::min()
              ? 0
              : difference / std::max(exact.u.lpNorm<Eigen::Infinity>(), 1e-9 * s.penalised_max_u);
      if (judgement.error > 0 && s.warning.empty())
        judgement.over_claim = difference / (s.error * s.u.lpNorm<Eigen::Infinity>());
    }
    judgement.reason = s.warning;
    if (!s.warning.empty())
      judgement.outcome = Outcome::warned;
    else
      judgement.outcome = judgement.error <= 1e-6 ? Outcome::right : Outcome::quietly_wrong;
  } catch (const Error& error) {
    judgement.reason = error.what();
    judgement.outcome = solvable ? Outcome::refused : Outcome::rightly;
  }
  return judgement;
}

}  // namespace antilock::hard
