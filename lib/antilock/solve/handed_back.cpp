#include "antilock/solve/handed_back.hpp"

#include "antilock/core/error.hpp"

namespace antilock {

Solution handed_back(const VariationalInequality& problem, const BoundedUnknowns& basis, Solution of_w,
                     const TrustLevels& levels) {
  if (of_w.u.size() != basis.t.cols() || of_w.lambda.size() != basis.scale.size() || problem.size() != basis.t.rows() ||
      problem.bound_count() != basis.scale.size())
    throw Error("handed back: the answer is of another problem; accepted: that of the basis made of this problem");
  of_w.u = basis.t * of_w.u;
  of_w.lambda.array() *= basis.scale.array();
  certify(problem, of_w, levels);
  return of_w;
}

}  // namespace antilock
