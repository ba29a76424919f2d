#pragma once
// What chapter 12 draws.
#include <string>
#include <vector>

#include "antilock/measure/contact_edges.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// One row per quantity (to_k, to_k0, c_h, k_h), method and mesh, without what is 0 up to
/// round-off.
inline Table by_quantity(const Table& results) {
  Table table({"quantity", "element", "mesh", "cells", "h", "value"});
  for (const Table& row : results.rows())
    for (const auto& [quantity, column] : {std::pair{"distance from $u$ to $K_h$", "to_k"},
                                           {"distance from $u^0$ to $K_{0h}$", "to_k0"},
                                           {"$c_h$: part below 0", "c_h"},
                                           {"$k_h$: slope across, $K_{0h}$", "k_h"}})
      if (row.number(column) >
          1e-6)  // P1 has nothing below 0, and conforming methods no hidden slope
        table.add({quantity, row.entry("element"), row.entry("mesh"), row.number("cells"),
                   row.number("h"), row.number(column)});
  return table;
}

/// u_h on Gamma_C around the end of contact, of P1, CR (unstructured: it slopes) and P2,
/// beside the truth.
inline Table traces(const Exact& u, int cells) {
  std::vector<Eigen::MatrixX3d> trace;
  for (const Method& method : {Method{&p1(), structured()},
                               {&crouzeix_raviart(), unstructured()},
                               {&p2(), structured()}}) {
    const Space space = method.space(cells);
    trace.push_back(
        contact_trace(space, active_set(assemble(paper_scene(u.epsilon), space)).u));
  }
  Table table({"x", "truth", "p1", "cr", "p2"});
  for (Eigen::Index k = 0; k < trace.front().rows(); ++k)
    if (const double x = trace.front()(k, 0); x > 0.55 && x < 0.85)
      table.add({x, u.table.value(x, -1), trace[0](k, 1), trace[1](k, 1), trace[2](k, 1)});
  return table;
}

/// results.csv, trace.csv, and dip.csv: a v_h of Crouzeix-Raviart on Gamma_C.
inline void write_contact_sets(const std::filesystem::path& out, const Table& results,
                               const Exact& u, const Eigen::MatrixX3d& dip) {
  by_quantity(results).write(out / "results.csv");
  traces(u, 16).write(out / "trace.csv");
  Table table({"x", "v"});
  for (Eigen::Index i = 0; i < dip.rows(); ++i) table.add({dip(i, 0), dip(i, 1)});
  table.write(out / "dip.csv");
}

}  // namespace antilock::tutorial
