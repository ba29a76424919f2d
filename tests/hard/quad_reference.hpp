#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <boost/multiprecision/eigen.hpp>
#if __has_include(<quadmath.h>)
#include <boost/multiprecision/float128.hpp>
#else  // the same format, slower: no number of a test depends on which of the two it is
#include <boost/multiprecision/cpp_bin_float.hpp>
#endif
#include <functional>
#include <optional>
#include <vector>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/penalised_cholesky.hpp"

namespace antilock::hard {

#if __has_include(<quadmath.h>)
using Quad = boost::multiprecision::float128;  // 113 bits, 34 digits
#else
using Quad = boost::multiprecision::cpp_bin_float_quad;
#endif
using QuadVector = Eigen::Matrix<Quad, Eigen::Dynamic, 1>;

/// The largest absolute value; 0 for an empty vector.
Quad largest(const QuadVector& v);

/// The exact solution of the discrete problem, or the proof that it is not: u solves the equations
/// of the given contact set to `residual`, and where also gap and pressure are not negative it is
/// the one solution of the inequality.
struct QuadSolution {
  QuadVector u{}, p{}, lambda{};
  std::vector<bool> active{};
  double residual = 0;                   ///< split form, relative
  double min_gap = 0, min_pressure = 0;  ///< relative to the largest |u| and the largest |load|
  int refinements = 0;
  int sets = 1;  ///< contact sets tried, see settle
};

/// Solves the equations of one contact set, from the u and p of another answer or, where it is
/// empty, from 0. The start must belong to the same set: where the rows of B are dependent on the
/// unknowns that are free, a p from elsewhere keeps for long what no row of B makes.
using Reference = std::function<QuadSolution(
    const VariationalInequality&, const std::vector<bool>& active, const QuadSolution& start)>;

/// By a sparse Cholesky factor in double precision: iterative refinement, affordable on every mesh.
/// The factor is kept for the next question if that has the same set and the same delta; it must
/// then have the same A1, B and M, else Error.
class RefinedReference {
 public:
  QuadSolution operator()(const VariationalInequality& problem, const std::vector<bool>& active,
                          const QuadSolution& start);

 private:
  std::optional<PenalisedCholesky> factor_;
  std::vector<bool> active_;
};

/// By a sparse L D L' in quadruple precision, delta so small that nothing is left of it after three
/// corrections.
QuadSolution quad_reference(const VariationalInequality& problem, const std::vector<bool>& active,
                            const QuadSolution& start = {});

/// Exchanges contact unknowns on the wrong side until gap and pressure have their signs to 1e-18:
/// with that the answer of `reference` is proved to be the solution. The first set is `active`, the
/// second that of `neighbour`, if there is one: the answer at another epsilon, from which a
/// question with its set starts. A hundred sets at most; the caller looks at the signs.
QuadSolution settle(const VariationalInequality& problem, std::vector<bool> active,
                    const Reference& reference, const QuadSolution& neighbour = {});

/// Relative distance in the maximum norm.
double distance(const Eigen::VectorXd& u, const QuadVector& exact);

}  // namespace antilock::hard
