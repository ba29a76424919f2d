#include "hard/quad_reference.hpp"

#include <Eigen/Sparse>
#include <tuple>
#include <utility>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock::hard {
namespace {

using QuadMatrix = Eigen::SparseMatrix<Quad>;

/// y += A x, y -= A x and y += A' x, with the matrix's own doubles and every operation in quadruple
/// precision.
template <class Matrix>
void add_product(QuadVector& y, const Matrix& a, const QuadVector& x) {
  for (Eigen::Index k = 0; k < a.outerSize(); ++k)
    for (typename Matrix::InnerIterator it(a, k); it; ++it)
      y(it.row()) += Quad(it.value()) * x(it.col());
}
template <class Matrix>
void subtract_product(QuadVector& y, const Matrix& a, const QuadVector& x) {
  for (Eigen::Index k = 0; k < a.outerSize(); ++k)
    for (typename Matrix::InnerIterator it(a, k); it; ++it)
      y(it.row()) -= Quad(it.value()) * x(it.col());
}
template <class Matrix>
void add_transposed_product(QuadVector& y, const Matrix& a, const QuadVector& x) {
  for (Eigen::Index k = 0; k < a.outerSize(); ++k)
    for (typename Matrix::InnerIterator it(a, k); it; ++it)
      y(it.col()) += Quad(it.value()) * x(it.row());
}

/// r1 = L - A1 u - B' M p and r2 = compliance p - B u in quadruple precision.
std::pair<QuadVector, QuadVector> quad_residual(const VariationalInequality& problem,
                                                const QuadVector& u, const QuadVector& p) {
  QuadVector r1 = problem.load.cast<Quad>(), r2 = Quad(problem.compliance) * p;
  const QuadVector minus_stress = -problem.m.cast<Quad>().cwiseProduct(p);
  subtract_product(r1, problem.a1, u);
  add_transposed_product(r1, problem.b, minus_stress);
  subtract_product(r2, problem.b, u);
  return {r1, r2};
}

/// Iterates u += du, p += dp in quadruple precision with any approximate inverse of K = A1 +
/// delta^-1 B' M B: the limit depends on the residual alone, which is formed in quadruple precision
/// and in split form, and not on the start.
QuadSolution refine(const VariationalInequality& problem, const std::vector<bool>& active,
                    const QuadSolution& start, double delta, const std::vector<int>& unknown,
                    const std::function<QuadVector(const QuadVector&)>& inverse, double tolerance,
                    int most) {
  const VariationalInequality linear = equality_constrained(problem, active);
  QuadSolution s;
  s.active = active;
  s.u = start.u.size() > 0 ? start.u : QuadVector(QuadVector::Zero(problem.size()));
  s.p = start.u.size() > 0 ? start.p : QuadVector(QuadVector::Zero(problem.b.rows()));
  for (std::size_t i = 0; i < linear.dirichlet_dofs.size(); ++i)
    s.u(linear.dirichlet_dofs[i]) = linear.dirichlet_values(static_cast<Eigen::Index>(i));
  const QuadVector weight = problem.m.cast<Quad>() / Quad(delta);
  QuadVector r1, r2;
  while (true) {
    std::tie(r1, r2) = quad_residual(problem, s.u, s.p);
    QuadVector r = r1;
    add_transposed_product(r, problem.b, weight.cwiseProduct(r2));
    QuadVector free(static_cast<Eigen::Index>(unknown.size())), free1 = free;
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      free(static_cast<Eigen::Index>(i)) = r(unknown[i]);
      free1(static_cast<Eigen::Index>(i)) = r1(unknown[i]);
    }
    const Quad u_scale = std::max<Quad>(largest(s.u), Quad(1e-300));
    s.residual = static_cast<double>(
        std::max<Quad>(largest(free1) / largest(problem.load.cast<Quad>()),
                       problem.b.rows() == 0 ? Quad(0) : largest(r2) / u_scale));
    if ((s.refinements > 0 && s.residual < tolerance) || s.refinements == most) break;
    ++s.refinements;
    const QuadVector x = inverse(free);
    QuadVector du = QuadVector::Zero(problem.size());
    for (std::size_t i = 0; i < unknown.size(); ++i)
      du(unknown[i]) = x(static_cast<Eigen::Index>(i));
    s.u += du;
    QuadVector dp = -r2;
    add_product(dp, problem.b, du);
    s.p += dp / Quad(delta);
  }
  s.lambda = QuadVector::Zero(static_cast<Eigen::Index>(problem.bounds.unknowns.size()));
  Quad min_gap = 0, min_pressure = 0;
  for (std::size_t i = 0; i < problem.bounds.unknowns.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    if (active[i]) s.lambda(k) = -r1(problem.bounds.unknowns[i]);
    min_gap =
        std::min<Quad>(min_gap, s.u(problem.bounds.unknowns[i]) - Quad(problem.bounds.lower(k)));
    min_pressure = std::min<Quad>(min_pressure, s.lambda(k));
  }
  s.min_gap = static_cast<double>(min_gap / std::max<Quad>(largest(s.u), Quad(1e-300)));
  s.min_pressure = static_cast<double>(min_pressure / largest(problem.load.cast<Quad>()));
  return s;
}

}  // namespace

Quad largest(const QuadVector& v) {
  Quad most = 0;
  for (Eigen::Index i = 0; i < v.size(); ++i) most = std::max<Quad>(most, abs(v(i)));
  return most;
}

QuadSolution RefinedReference::operator()(const VariationalInequality& problem,
                                          const std::vector<bool>& active,
                                          const QuadSolution& start) {
  const VariationalInequality linear = equality_constrained(problem, active);
  const double delta = std::max(1e-8, problem.compliance);
  if (factor_ && factor_->delta() == delta && active_ == active)
    factor_->check_fits(linear);
  else
    factor_.emplace(linear, delta);
  active_ = active;
  const auto inverse = [&](const QuadVector& r) {
    const double scale = static_cast<double>(largest(r));
    if (scale == 0) return r;
    const Eigen::VectorXd rounded = (r / Quad(scale)).cast<double>();
    return QuadVector(
        factor_->cholesky().backward(factor_->cholesky().forward(rounded)).cast<Quad>() *
        Quad(scale));
  };
  return refine(problem, active, start, delta, factor_->ordering().dof, inverse, 1e-22, 200);
}

QuadSolution quad_reference(const VariationalInequality& problem, const std::vector<bool>& active,
                            const QuadSolution& start) {
  const double delta = std::max(problem.compliance, 1e-14);
  const VariationalInequality linear = equality_constrained(problem, active);
  const DofOrdering ordering(linear);
  const int size = static_cast<int>(ordering.dof.size());
  std::vector<Eigen::Triplet<Quad>> entries;
  const auto add = [&](int i, int j, const Quad& value) {
    if (ordering.position[i] >= 0 && ordering.position[j] >= 0)
      entries.emplace_back(ordering.position[i], ordering.position[j], value);
  };
  for (int j = 0; j < problem.a1.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(problem.a1, j); a; ++a)
      add(static_cast<int>(a.row()), j, a.value());
  for (int row = 0; row < problem.b.rows(); ++row)
    for (RowMatrix::InnerIterator i(problem.b, row); i; ++i)
      for (RowMatrix::InnerIterator j(problem.b, row); j; ++j)
        add(static_cast<int>(i.col()), static_cast<int>(j.col()),
            Quad(i.value()) * Quad(problem.m(row)) * Quad(j.value()) / Quad(delta));
  QuadMatrix k(size, size);
  k.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<QuadMatrix> factor(k);
  return refine(
      problem, active, start, delta, ordering.dof,
      [&](const QuadVector& r) { return QuadVector(factor.solve(r)); }, 1e-26, 60);
}

QuadSolution settle(const VariationalInequality& problem, std::vector<bool> active,
                    const Reference& reference, const QuadSolution& neighbour) {
  for (int sets = 1;; ++sets) {
    const bool of_neighbour = active == neighbour.active;
    QuadSolution s = reference(problem, active, of_neighbour ? neighbour : QuadSolution());
    s.sets = sets;
    if (sets == 100 || std::min(s.min_gap, s.min_pressure) >= -1e-18) return s;
    if (sets == 1 && neighbour.u.size() > 0 && !of_neighbour) {
      active = neighbour.active;
      continue;
    }
    const Quad gap_slack = Quad(1e-18) * largest(s.u),
               pressure_slack = Quad(1e-18) * largest(problem.load.cast<Quad>());
    for (std::size_t i = 0; i < active.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const bool wrong =
          active[i] ? s.lambda(k) < -pressure_slack
                    : s.u(problem.bounds.unknowns[i]) - Quad(problem.bounds.lower(k)) < -gap_slack;
      if (wrong) active[i] = !active[i];
    }
  }
}

double distance(const Eigen::VectorXd& u, const QuadVector& exact) {
  return static_cast<double>(largest(u.cast<Quad>() - exact) / largest(exact));
}

}  // namespace antilock::hard
