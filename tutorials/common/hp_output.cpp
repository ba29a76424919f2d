#include "common/hp_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/io/writers.hpp"
#include "antilock/measure/contact_trace.hpp"
#include "antilock/space/element.hpp"

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

void judge_hp(const Table& results, const Exact& exact, Report& report) {
  const std::string here = fmt::format("epsilon = {:g}, ", exact.epsilon);
  const Table rows = results.where("epsilon", exact.epsilon), own = rows.where("series", "hp");
  const auto at = [&](int p, const char* column) { return own.where("degree", p).number(column); };
  const auto order = [&](int p) {  // in 1/N, from one level to the next
    return std::log(at(p, "h1") / at(p + 1, "h1")) / std::log(at(p + 1, "unknowns") / at(p, "unknowns"));
  };
  report.claim_within(std::pow(at(2, "h1") / at(6, "h1"), 0.25), 6, 10,
                      here + "hp: per level the H1 error falls by a factor of");
  report.claim(order(5) > 2 * order(2), "{}hp: no power of N, order {:.1f} and then {:.1f}", here, order(2), order(5));
  if (exact.epsilon == 1e-20)
    return report.claim_within(at(6, "h1") / results.where("epsilon", 0).where("series", "hp").last("h1"), 0.999, 1.001,
                               here + "hp: H1 error over that at epsilon = 0");
  report.claim_within(at(6, "end") - exact.contact_from(), -2e-5, 2e-5, here + "hp: end of contact, less the truth's");
  for (int p = 1; p <= 4; ++p) {
    const double h1 = rows.where("mesh", "graded").where("series", lagrange(p).name()).order("h1", "h");
    report.claim(h1 > p - 0.25, "{}graded P{}: h^{:.2f} in H1", here, p, h1);
  }
  // Where $c$ lies in its cell changes from mesh to mesh: 1/2 on either side of what theory says.
  const Table p4 = rows.where("mesh", "equal cells").where("series", "P4");
  report.claim_within(p4.order("contact", "h"), 1, 2.5, here + "P4, equal cells, on Gamma_C (3/2 to 2): order");
  if (exact.epsilon < 1) report.claim_within(p4.order("h1", "h"), 1, 2, here + "P4, equal cells, in H1 (3/2): order");
  const double gain = p4.last("contact") / at(6, "contact"), fewer = p4.last("unknowns") / at(6, "unknowns");
  report.claim(gain > 50 && fewer > 1, "{}on Gamma_C hp has 1/{:.0f} of that error, 1/{:.1f} of the unknowns", here,
               gain, fewer);
}

}  // namespace antilock::tutorial
