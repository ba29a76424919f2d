#pragma once
#include "antilock/analysis/inf_sup.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/study/sweep.hpp"
#include "course/course.hpp"
#include "course/rubber.hpp"

namespace antilock::tutorial {

/// A discretisation of rubber: one element for both components.
struct Mixed {
  std::string name, file;  ///< file: of the deformed body; empty: it is not drawn
  const Element& element;
  bool pressure_per_vertex;  ///< else one per triangle
};

inline TriangleMesh block(int cells) {
  return with_free_sides(structured_mesh(cells, Domain{0}));
}

/// The block of chapter 26 at 1/lambda = 0, pushed down on its obstacle.
inline VariationalInequality rubber(const Mixed& way, const Space& space,
                                    double push = 0.1) {
  const BlockLoading press{.prescribed_displacement = push,
                           .gap = [](double x) { return (x - 0.5) * (x - 0.5); },
                           .jump_weight = way.element.conforming() ? 0.0 : 1.0};
  return assemble(PlaneStrain{press, 0, way.pressure_per_vertex}, {space, space});
}

/// The inf-sup constant of the stress of (23)'s layer, in the dual norm, which is taken on
/// the mesh cut twice.
inline double layer_inf_sup(const Method& method, int n) {
  const auto gram = [](const Space& space, int merged) {
    return multiplier_gram(assemble(paper_scene(0), space),
                           gradient_form(space, {1, 1}, {1, 1}), merged);
  };
  const Space space = method.space(n), almost_all(refined(refined(space.mesh())), p1());
  return inf_sup(gram(space, 1), gram(almost_all, 16));
}

/// One row per lambda: the contact force against chapter 26's reference, in per cent. Draws
/// the incompressible block.
inline const std::vector<std::string> force_columns{
    "name", "h", "unknowns", "epsilon", "percent", "pressure", "corrections", "seconds"};
inline Table push(const Mixed& way, int cells, const Options& options) {
  const Space space(block(cells), way.element);
  Sweep sweep(rubber(way, space));
  Table rows(force_columns);
  for (const double epsilon : {0.0, 1.0, 1e-2, 1e-4, 1e-8, 1e-20}) {
    sweep.set_compliance(epsilon);
    const Solution solution = sweep.solve();
    if (epsilon == 0 && cells == options.cells && !way.file.empty()) {
      Eigen::VectorXd pressure(space.mesh().triangle_count());
      for (int t = 0; t < space.mesh().triangle_count(); ++t)
        pressure(t) = -solution.p(space.mesh().triangles.row(t)).mean();
      write_deformed_vtu(options.out / (way.file + ".vtu"), {space, space}, solution.u,
                         pressure);
    }
    rows.add({way.name, 1.0 / cells, sweep.problem().free_count(), epsilon,
              percent_too_large(solution.lambda.sum(), epsilon),
              solution.p.lpNorm<Eigen::Infinity>(), solution.counters.corrections,
              solution.seconds.total()});
  }
  return rows;
}

/// Prints the tables; writes inf_sup.csv, forces.csv, gradients.csv, obstacle.csv.
inline void show_pressure(const std::filesystem::path& out, const Table& beta,
                          const Table& forces, const Table& worst, const Table& by_lambda) {
  for (const TableEntry& held : beta.unique("held"))
    beta.filter("held", held)
        .pivot("name", "h", "beta")
        .print("inf-sup constant, held: " + held.text() + ", by h", 3);
  const Table finest = forces.filter("h", forces.min("h"));
  finest.pivot("name", "epsilon", "percent")
      .print("error of the contact force in %, by 1/lambda", 2);
  finest.filter("epsilon", 0)
      .select({"name", "unknowns", "pressure", "corrections", "seconds"})
      .print("incompressible");
  worst.pivot("name", "h", "moved").print("moved by the worst gradient of norm 1, by h", 3);
  by_lambda.pivot("name", "lambda", "moved")
      .print("moved by one gradient, 1/h = 16, by lambda", 3);
  beta.filter_number("beta", [](double value) { return value > 0; })
      .write(out / "inf_sup.csv");  // to be drawn
  forces.write(out / "forces.csv");
  by_lambda.write(out / "gradients.csv");
  Table obstacle({"x", "y"});
  for (int i = 0; i <= 40; ++i)
    obstacle.add({-0.1 + 0.03 * i, -std::pow(-0.6 + 0.03 * i, 2)});
  obstacle.write(out / "obstacle.csv");
}

/// Loads grad psi of norm 1 that are orthogonal, psi ~ sin(k pi x) sin((m - 1/2) pi y), k,
/// m = 1 ... waves: one column per load. `on_fluxes`: the test function is replaced by the
/// Raviart-Thomas field with its fluxes.
inline Eigen::MatrixXd gradient_loads(const Space& space, int waves, bool on_fluxes) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = triangle_rule(12);
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(2 * space.size(), waves * waves);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> normals =
        -barycentric_gradients(mesh, t);  // times 2 |T|: outward, as long as edges
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const Eigen::VectorXd phi = space.element().basis(rule.points.row(q));
      for (int j = 0; j < loads.cols(); ++j) {
        const int across = j / waves, along = j % waves;
        const double a = (across + 1) * std::numbers::pi,
                     b = (along + 0.5) * std::numbers::pi;
        const Eigen::Vector2d f =
            mesh.area(t) * rule.weights(q) * 2 / std::hypot(a, b) *
            Eigen::Vector2d(a * std::cos(a * x(0)) * std::sin(b * x(1)),
                            b * std::sin(a * x(0)) * std::cos(b * x(1)));
        for (int i = 0; i < phi.size(); ++i)
          for (const int c : {0, 1})
            loads(space.cell_dofs()(t, i) + c * space.size(), j) +=
                on_fluxes
                    ? normals(i, c) *
                          f.dot(x - mesh.vertices.row(mesh.triangles(t, i)).transpose())
                    : f(c) * phi(i);
      }
    }
  }
  return loads;
}

/// The inf-sup constant over all v_h, over those that are 0 on the contact set, and over
/// those that are 0 on all of Gamma_C.
inline Table inf_sup_constants(const Mixed& way) {
  Table rows({"name", "h", "held", "beta"});
  for (const int n : {4, 8, 12, 16}) {
    const TriangleMesh mesh = block(n);
    const VariationalInequality problem = rubber(way, Space(mesh, way.element));
    const std::size_t bounds = problem.bounds.unknowns.size();
    for (const auto& [held, marks] :
         {std::pair{"nothing", std::vector<bool>(bounds)},
          {"contact set", active_set(problem).active},
          {"all of Gamma_C", std::vector<bool>(bounds, true)}}) {
      const VariationalInequality linear = equality_constrained(problem, marks);
      rows.add({way.name, 1.0 / n, held,
                inf_sup(multiplier_gram(linear, linear.a1),
                        Eigen::MatrixXd(linear.m.asDiagonal()))});
    }
  }
  return rows;
}

}  // namespace antilock::tutorial
