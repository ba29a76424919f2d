#include "common/beam.hpp"

#include <cmath>

#include "antilock/study/sweep.hpp"

namespace antilock::tutorial {

double nodal_error(const Beam& beam, const Solution& solution) {
  const BeamTruth truth(beam);
  double largest = 0;
  for (int i = 0; i <= beam.cells; ++i)
    largest = std::max(largest, std::abs(solution.u(2 * i) - truth.deflection(static_cast<double>(i) / beam.cells)));
  return largest;
}

Table beam_errors(const std::vector<int>& cells_of_meshes) {
  Table table({"integration", "cells", "epsilon", "error"});
  for (const auto& [shear, name] :
       {std::pair{ShearIntegration::full, "full integration"}, {ShearIntegration::reduced, "reduced integration"}})
    for (const int cells : cells_of_meshes) {
      Beam beam{.cells = cells, .shear = shear};
      Sweep sweep(assemble(beam));
      for (int k = 4; k <= 16; ++k) {
        beam.epsilon = std::pow(10.0, -0.5 * k);
        sweep.set_compliance(beam.epsilon);
        table.add({name, cells, beam.epsilon, nodal_error(beam, sweep.solve())});
      }
    }
  return table;
}

Table draw_beam(const Beam& beam, const Solution& full, const Solution& reduced) {
  const BeamTruth truth(beam);
  Table table({"x", "w_full", "w_reduced", "w_exact", "force_full", "force_reduced"});
  for (int i = 0; i <= beam.cells; ++i) {
    const double x = i * (1.0 / beam.cells);
    const bool inside = i > 0 && i < beam.cells;
    table.add({x, full.u(2 * i), reduced.u(2 * i), truth.deflection(x), inside ? full.lambda(i - 1) : 0.0,
               inside ? reduced.lambda(i - 1) : 0.0});
  }
  return table;
}

}  // namespace antilock::tutorial
