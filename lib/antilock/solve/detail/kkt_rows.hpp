#pragma once
#include <functional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/solve/stairs.hpp"

namespace antilock {

/// What the report of kkt.hpp compares, unknown by unknown. Of a problem in pieces each part is the sum over the pieces;
/// strain is their maximum.
struct KktParts {
  Eigen::VectorXd load;      ///< N, L
  Eigen::VectorXd terms;     ///< N, t: the sum of the absolute values of all terms of r1 but lambda
  Eigen::VectorXd moderate;  ///< N, A1 u
  Eigen::VectorXd borne;     ///< N, B' M p
  Eigen::VectorXd diagonal;  ///< N, of A1
  Eigen::VectorXd stiff;     ///< N, the diagonal of B' M B
  double strain = 0;         ///< the largest |r2| in units of its row
};
/// In one walk over A1 and one over B. u: N entries, p: R.
KktParts kkt_parts(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p);

/// The report, row by row. Three callers' data differ: what a maximum is taken over (all ranks), which unknowns are fixed,
/// and what is bounded.
struct KktRows {
  double u = 0;            ///< U of kkt.hpp
  Eigen::VectorXd forces;  ///< N: the force that no unknown would overlook, infinite where fixed
  double residual = 0;     ///< of the equations

  /// `bounds`: N, the sum of the forces of all bounds on each unknown; `largest_bound`: N, the largest of one bound;
  /// `fixed`: N, not 0 where the value is prescribed; `largest_u`: the larger of max |u| and 1e-6 of its size before it
  /// locked; `over_all`: the maximum over all pieces.
  KktRows(const KktParts& parts, const Eigen::VectorXd& bounds, const Eigen::VectorXd& largest_bound,
          const std::vector<char>& fixed, double largest_u, double reaction,
          const std::function<double(double)>& over_all);
  /// The rows of bound i, whose value is `value`: each gap by its own bound, so that a far obstacle hides no near one.
  /// `strain`: what the bounded value is at most where no |u| is above 1; `force`: a lambda that nobody would overlook.
  void note_bound(Kkt& kkt, const Stairs& stairs, int i, double value, double lambda, double strain,
                  double force) const;
};

}  // namespace antilock
