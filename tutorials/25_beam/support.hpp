#pragma once
#include "antilock/exact/exact_beam.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"
#include "course/chapter.hpp"

namespace antilock::tutorial {

/// For the picture: deflections and nodal forces, one row per node.
inline Table draw_beam(const Beam& beam, const Solution& full, const Solution& reduced) {
  const ExactBeam exact(beam);
  Table table({"x", "w_full", "w_reduced", "w_exact", "force_full", "force_reduced"});
  for (int i = 0; i <= beam.cells; ++i) {
    const double x = i * (1.0 / beam.cells);
    const bool inside = i > 0 && i < beam.cells;
    table.add({x, full.u(2 * i), reduced.u(2 * i), exact.deflection(x),
               inside ? full.lambda(i - 1) : 0.0, inside ? reduced.lambda(i - 1) : 0.0});
  }
  return table;
}

}  // namespace antilock::tutorial
