#pragma once
#include <algorithm>
#include <filesystem>
#include <map>

#include "antilock/exact/exact_norms.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// The H1 errors of the four methods of Figure 9 from epsilon = 1 to 1e-6 on 1/8, ...,
/// 1/finest, and the right side of (28) with C = 1: method, cells, epsilon, h1, bound. The
/// picture `estimates` shows them on the coarsest and the finest mesh, the bounds with the
/// smallest C that makes them true: estimates.csv.
inline Table errors_and_bounds(const std::filesystem::path& out, int finest) {
  std::vector<double> epsilons;
  for (int k = 0; k <= 24; k += 2) epsilons.push_back(std::pow(10.0, -0.25 * k));
  const std::vector<Exact> exact_solution = exact_solutions(epsilons, 14);
  Table all({"method", "cells", "epsilon", "h1", "bound"}),
      curves({"element", "mesh", "curve", "epsilon", "h1"});
  for (const Method& method : methods()) {
    Table own(all.columns());
    for (int n = 8; n <= finest; n *= 2) {
      const Space space = method.space(n);
      SceneSweep sweep(paper_scene(1), space);
      for (const Exact& exact : exact_solution) {
        sweep.set_epsilon(exact.epsilon);
        own.add(
            {method.name(), n, exact.epsilon, exact.errors(space, sweep.solve()).h1,
             std::pow(exact.epsilon, -2) * std::pow(n, -0.75) * h2_norm(exact.solution)});
      }
    }
    double c = 0;  // the smallest that makes (28) or (31) true
    for (const Table& row : own.rows())
      c = std::max(c, row.number("h1") / row.number("bound"));
    for (const double n : {own.min("cells"), own.max("cells")})
      for (const Table& row : own.filter("cells", n).rows())
        for (const auto& [what, value] :
             {std::pair{"error", row.number("h1")}, {"estimate", c * row.number("bound")}})
          curves.add({method.element->name(), method.family.name,
                      fmt::format("{} $h = 1/{}$", what, n), row.number("epsilon"), value});
    all.add(own);
  }
  curves.write(out / "estimates.csv");
  return all;
}

/// all.csv, and lost.csv for the picture `lost`: what is lost over what is kept against
/// 5.84 k / epsilon on the finest mesh, under the names that gmsh gives to its meshers.
inline void write_lost(const std::filesystem::path& out, const Table& lost) {
  lost.select({"family", "cells", "epsilon", "wall / epsilon", "x"}).write(out / "all.csv");
  Table picture({"family", "law", "lost"});
  const std::map<std::string, std::string> names{{"unstructured", "Frontal-Delaunay"},
                                                 {"delaunay", "Delaunay"},
                                                 {"meshadapt", "MeshAdapt"}};
  for (const Table& row : lost.filter("cells", lost.max("cells")).rows()) {
    const std::string family = row.entry("family").text();
    picture.add({names.count(family) ? names.at(family) : family,
                 row.number("wall / epsilon"), row.number("x")});
  }
  picture.write(out / "lost.csv");
}

}  // namespace antilock::tutorial
