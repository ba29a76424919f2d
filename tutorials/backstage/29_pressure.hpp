#pragma once
#include "antilock/analysis/inf_sup.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/study/sweep.hpp"
#include "backstage/26_checks.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// A discretisation of rubber: one element for both components.
struct Mixed {
  std::string name, file;  ///< file: of the deformed body; empty: it is not drawn
  const Element& element;
  bool pressure_per_vertex;  ///< else one per triangle
};

inline TriangleMesh block(int cells) { return with_free_sides(structured_mesh(cells, Domain{0})); }

/// The block of chapter 26 at 1/lambda = 0, pushed down on its obstacle.
inline VariationalInequality rubber(const Mixed& way, const Space& space, double push = 0.1) {
  const Press press{.push = push,
                    .gap = [](double x) { return (x - 0.5) * (x - 0.5); },
                    .jump_weight = way.element.conforming() ? 0.0 : 1.0};
  return assemble(PlaneStrain{press, 0, way.pressure_per_vertex}, {space, space});
}

/// The inf-sup constant of the stress of (23)'s layer, in the dual norm, which is taken on the mesh cut twice.
inline double layer_inf_sup(const Method& method, int n) {
  const auto gram = [](const Space& space, int merged) {
    return multiplier_gram(assemble(paper_scene(0), space), gradient_form(space, {1, 1}, {1, 1}), merged);
  };
  const Discretisation on = method.on(n), almost_all(refined(refined(on.mesh())), p1());
  return inf_sup(gram(on.space(), 1), gram(almost_all.space(), 16));
}

/// One row per lambda: the contact force against chapter 26's reference, in per cent. Draws the incompressible block.
inline const std::vector<std::string> force_columns{"name",    "h",        "unknowns",    "epsilon",
                                                    "percent", "pressure", "corrections", "seconds"};
inline Table push(const Mixed& way, int cells, const Options& options) {
  const TriangleMesh mesh = block(cells);
  const Space space(mesh, way.element);
  Sweep sweep(rubber(way, space));
  Table rows(force_columns);
  for (const double epsilon : {0.0, 1.0, 1e-2, 1e-4, 1e-8, 1e-20}) {
    sweep.set_compliance(epsilon);
    const Solution solution = sweep.solve();
    if (epsilon == 0 && cells == options.cells && !way.file.empty()) {
      Eigen::VectorXd pressure(mesh.triangle_count());
      for (int t = 0; t < mesh.triangle_count(); ++t) pressure(t) = -solution.p(mesh.triangles.row(t)).mean();
      write_deformed_vtu(options.out / (way.file + ".vtu"), {space, space}, solution.u, pressure);
    }
    rows.add({way.name, 1.0 / cells, sweep.problem().free_count(), epsilon,
              percent_too_large(solution.lambda.sum(), epsilon), solution.p.lpNorm<Eigen::Infinity>(),
              solution.counters.corrections, solution.seconds.total()});
  }
  return rows;
}

/// Prints the tables; writes inf_sup.csv, forces.csv, gradients.csv, obstacle.csv.
inline void show_pressure(const std::filesystem::path& out, const Table& beta, const Table& forces, const Table& worst,
                          const Table& by_lambda) {
  for (const Entry& held : beta.different("held"))
    beta.where("held", held).pivot("name", "h", "beta").print("inf-sup constant, held: " + held.text() + ", by h", 3);
  const Table finest = forces.where("h", forces.least("h"));
  finest.pivot("name", "epsilon", "percent").print("error of the contact force in %, by 1/lambda", 2);
  finest.where("epsilon", 0).select({"name", "unknowns", "pressure", "corrections", "seconds"}).print("incompressible");
  worst.pivot("name", "h", "moved").print("moved by the worst gradient of norm 1, by h", 3);
  by_lambda.pivot("name", "lambda", "moved").print("moved by one gradient, 1/h = 16, by lambda", 3);
  beta.where_number("beta", [](double value) { return value > 0; }).write(out / "inf_sup.csv");  // to be drawn
  forces.write(out / "forces.csv");
  by_lambda.write(out / "gradients.csv");
  Table obstacle({"x", "y"});
  for (int i = 0; i <= 40; ++i) obstacle.add({-0.1 + 0.03 * i, -std::pow(-0.6 + 0.03 * i, 2)});
  obstacle.write(out / "obstacle.csv");
}

}  // namespace antilock::tutorial
