#include "common/uniform.hpp"

#include <cmath>

#include "antilock/analysis/nearest.hpp"
#include "antilock/models/anti_plane.hpp"
#include "common/paper_problem.hpp"

namespace antilock::tutorial {

std::vector<double> half_decades() {
  std::vector<double> list;
  for (int k = 0; k <= 20; ++k) list.push_back(std::pow(10.0, -0.5 * k));
  list.push_back(0);
  return list;
}

Table distances_to_limit(const Method& method, int finest) {
  const Exact u0(paper_scene(0), 15);
  Table rows({"h", "distance"});
  for (int n = finest / 4; n <= finest; n *= 2) {
    const Discretisation on = method.on(n);
    const auto problem = assemble(paper_scene(0), on.space());
    rows.add({1.0 / n, nearest(on.space(), problem, u0.reference(), Within::k_0h).distance});
  }
  return rows;
}

void judge_uniform(const Method& method, const Table& worst, Report& report) {
  const double order = worst.order("h1", "h"), energy = worst.order("energy", "h");
  // 0.9: first order is the best of P1 and CR, 0.1 for coarse meshes.
  report.claim(order > 0.9 && energy > 0.9,
               "{}, {} and Remark 4: the worst error falls like h^{:.2f} (H1), h^{:.2f} (energy)", method.name(),
               method.element->conforming() ? "Theorem 5" : "Theorem 7", order, energy);
  report.claim(worst.last("ratio") < 1.1, "{}: locking ratio {:.2f}, no more than 1.1", method.name(),
               worst.last("ratio"));
}

}  // namespace antilock::tutorial
