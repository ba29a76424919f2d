#pragma once
#include <string>
#include <utility>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Wall seconds of a run by stage: the scene and its mesh, the discrete problem with a look at its load, the factor, the
/// rest of the solve with the checks of the result. The files are timed where they are written.
struct RunSeconds {
  double mesh = 0, assemble = 0, factor = 0, solve = 0;
};

/// A problem and its solution in the form in which the class is studied: own_rows_summed, and p of the rows that are left.
struct ClassForm {
  VariationalInequality problem;
  Solution solution;
};
inline ClassForm own_rows_summed(const VariationalInequality& problem, Solution solution) {
  const Eigen::Index first = problem.class_rows();
  Eigen::Index left = first;
  for (Eigen::Index k = 0; k < problem.own_compliances.size(); ++k)
    if (problem.own_compliances(k) == 0) {
      solution.p(left) = solution.p(first + k);
      ++left;
    }
  solution.p.conservativeResize(left);
  return {own_rows_summed(problem), std::move(solution)};
}

/// A discrete solution with its space and its problem, from which everything is measured, proved, drawn and written.
struct Result {
  Space space;
  VariationalInequality problem;
  Solution solution;
  RunSeconds seconds;
  std::string warning;  ///< empty, or one line: the reason to distrust the result
};

}  // namespace antilock
