#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/exact/exact_solution.hpp"
#include "antilock/measure/contact_edges.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// mesh, series, epsilon, degree, h away from the end of contact, unknowns; h1: the H1
/// error; contact, below: OnContact; end: where contact begins; seconds of mesh, assembly
/// and solve.
inline const std::vector<std::string> hp_columns{"mesh",  "series",   "epsilon", "degree",
                                                 "h",     "unknowns", "h1",      "contact",
                                                 "below", "end",      "seconds"};

/// Between the unknowns of Gamma_C, 32 points per edge, over the largest u there:
/// the largest error of u_h, and how far u_h is below 0.
struct OnContact {
  double error, below;
};
inline OnContact on_contact(const Space& space, const Eigen::VectorXd& u,
                            const ExactSolution& exact) {
  const Eigen::MatrixX3d trace = contact_trace(space, u);
  double error = 0;
  for (Eigen::Index i = 0; i < trace.rows(); ++i)
    error = std::max(error, std::abs(trace(i, 1) - exact.value(trace(i, 0), -1)));
  const double largest = exact.max_on_contact();
  return {error / largest, std::max(0.0, -trace.col(1).minCoeff()) / largest};
}

/// Prints the levels of hp at epsilon = 1 and 0; writes results.csv, picture.csv (a panel
/// per mesh, hp on both) and graded.msh. `results` has the columns above.
inline void write_hp(const std::filesystem::path& out, const Table& results,
                     const TriangleMesh& drawn) {
  for (const double epsilon : {1.0, 0.0})
    results.filter("epsilon", epsilon)
        .filter("series", "hp")
        .print(fmt::format("hp, epsilon = {}", epsilon), 3);
  Table picture({"panel", "series", "epsilon", "unknowns", "h1", "contact"});
  for (const Table& row : results.rows())
    for (const char* panel : {"equal cells", "graded"})
      if (row.entry("mesh") == panel || row.entry("series") == "hp")
        picture.add({panel, row.entry("series"), row.entry("epsilon"),
                     row.entry("unknowns"), row.entry("h1"), row.entry("contact")});
  picture.write(out / "picture.csv");
  results.write(out / "results.csv");
  write_msh(out / "graded.msh", drawn);
}

}  // namespace antilock::tutorial
