#pragma once
#include <set>

#include "antilock/analysis/load_ascent.hpp"
#include "antilock/analysis/worst_load.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/study/method.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// Draws a load of the ball on a mesh of the body, out/ELEMENT_FAMILY.vtu, over its largest
/// value, in the place of u. Of f and -f it takes the one with the larger pull upwards on
/// one arch and two.
inline void draw_load(const std::filesystem::path& out, const Method& method,
                      const LoadModes& modes, Eigen::VectorXd f) {
  if (f.dot(modes.constant_in_y(1, 1) + modes.constant_in_y(2, 1)) < 0) f = -f;
  const Space space(structured_mesh(48, Domain{0}), p1());
  Eigen::VectorXd values(space.size());
  for (int i = 0; i < space.size(); ++i)
    values(i) =
        modes.value(f, space.dof_coordinates()(i, 0), space.dof_coordinates()(i, 1));
  values /= values.cwiseAbs().maxCoeff();
  write_vtu(out / fmt::format("{}_{}.vtu", method.element->name(), method.family.name),
            space, values);
}

/// With contact, epsilon = 0: a climb over loads of four waves, by the error against the
/// exact solution. A lower bound.
inline double climb_in_contact(const Method& method, int cells) {
  const Space space = method.space(cells);
  SceneSweep sweep(paper_scene(0), space);
  const auto error = [&](const Eigen::VectorXd& coefficients) {
    const SineLoad load = load_of_modes(coefficients);
    sweep.set_load(load);
    const ExactTable exact(ExactSolution(load, 0, true, 9),
                           1 << 8);  // to some thousandths: the climb has to be quick
    return measure_errors(space, sweep.solve(), 0, reference(exact)).energy;
  };
  return ascend(error, {Eigen::Vector4d::Unit(0), Eigen::Vector4d(1, 1, 0, 0)});
}

/// The unknowns of the body that are not clamped.
inline int unknowns_of_body(const Space& space) {
  std::set<int> all;
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    for (int i = 0; space.mesh().region[t] == Region::body && i < space.element().dofs();
         ++i)
      all.insert(space.cell_dofs()(t, i));
  for (const int i : space.dirichlet_dofs()) all.erase(i);
  return static_cast<int>(all.size());
}

/// One row per h of the errors under the worst loads, the largest over epsilon: over the
/// width, over that at epsilon = 1.
inline Table suprema_over_epsilon(const Table& worst) {
  Table suprema({"h", "supremum", "over_width", "ratio"});
  for (const TableEntry& h : worst.unique("h")) {
    const Table here = worst.filter("h", h);
    suprema.add({h, here.max("error"), here.max("over_width"),
                 here.max("error") / here.filter("epsilon", 1).number("error")});
  }
  return suprema;
}

/// Prints the errors at epsilon = 0 by h. Writes errors.csv (the rows at epsilon = 0) and
/// epsilon.csv (those at this h with epsilon > 0, in their order).
inline void show_worst_errors(const std::filesystem::path& out, const Table& results,
                              double h) {
  const Table rigid = results.filter("epsilon", 0);
  Table errors(results.columns()), by_epsilon({"load", "method", "epsilon", "error"});
  for (const TableEntry& load : rigid.unique("load")) {
    rigid.filter("load", load)
        .pivot("method", "h", "error")
        .print(load.text() + ", epsilon = 0");
    if (load.text() != "p arches, no contact") errors.add(rigid.filter("load", load));
  }
  for (const std::string load : {"our load", "worst load of the ball"})
    for (const double epsilon : {1.0, 0.3, 0.1, 0.03, 1e-2, 1e-3, 1e-4, 1e-6})
      for (const Table& row : results.filter("h", h).filter("epsilon", epsilon).rows())
        if (row.entry("load").text().starts_with(load))
          by_epsilon.add({load, row.entry("method"), epsilon, row.entry("error")});
  errors.write(out / "errors.csv");
  by_epsilon.write(out / "epsilon.csv");
}

}  // namespace antilock::tutorial
