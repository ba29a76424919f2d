#include "common/hp_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/io/writers.hpp"
#include "antilock/measure/contact_trace.hpp"

namespace antilock::tutorial {

OnContact on_contact(const Space& space, const Eigen::VectorXd& u, const Truth& truth) {
  const Eigen::MatrixX3d trace = contact_trace(space, u);
  double error = 0;
  for (Eigen::Index i = 0; i < trace.rows(); ++i)
    error = std::max(error, std::abs(trace(i, 1) - truth.value(trace(i, 0), -1)));
  const double largest = truth.max_on_contact();
  return {error / largest, std::max(0.0, -trace.col(1).minCoeff()) / largest};
}

void write_hp(const std::filesystem::path& out, const Table& results, const TriangleMesh& drawn) {
  for (const double epsilon : {1.0, 0.0})
    results.where("epsilon", epsilon).where("series", "hp").print(fmt::format("hp, epsilon = {}", epsilon), 3);
  Table picture({"panel", "series", "epsilon", "unknowns", "h1", "contact"});
  for (const Table& row : results.rows())
    for (const char* panel : {"equal cells", "graded"})
      if (row.entry("mesh") == panel || row.entry("series") == "hp")
        picture.add({panel, row.entry("series"), row.entry("epsilon"), row.entry("unknowns"), row.entry("h1"),
                     row.entry("contact")});
  picture.write(out / "picture.csv");
  results.write(out / "results.csv");
  write_msh(out / "graded.msh", drawn);
}

}  // namespace antilock::tutorial
