#pragma once
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "antilock/form/gradient_forms.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"
#include "course/chapter.hpp"
#include "course/rubber.hpp"

namespace antilock::tutorial {

/// -p; on crossed triangles, which carry a checkerboard in every square, the mean over the
/// square.
inline Eigen::VectorXd pressure(const Rubber& rubber, const Solution& solution) {
  Eigen::VectorXd p = -solution.p;
  if (rubber.file == "p1_crossed")
    for (Eigen::Index square = 0; square < p.size() / 4; ++square)
      p.segment<4>(4 * square).setConstant(p.segment<4>(4 * square).mean());
  return p;
}

/// The deformed block with its pressure -lambda div u.
inline void write_block(const std::filesystem::path& out, const Rubber& rubber,
                        const VectorSpace& space, const Solution& solution) {
  write_deformed_vtu(out / (rubber.file + ".vtu"), space, solution.u,
                     pressure(rubber, solution));
  if (rubber.file == "p1_right") write_freefem_mesh(out / "mesh.freefem.msh", rubber.mesh);
}

/// Writes force.csv, and obstacle.csv of the picture; prints the tables of the chapter.
inline void show_rubber(const std::filesystem::path& out, const Table& checks,
                        const Table& forces, const Profile& gap) {
  checks.print("", 2);
  forces.filter("known", 1)
      .pivot("element", "lambda", "percent")
      .print("error of the contact force in %, by lambda");
  forces.pivot("element", "lambda", "corrections").print("corrections, by lambda");
  forces.select({"element", "lambda", "epsilon", "force", "corrections"})
      .write(out / "force.csv");
  Table obstacle({"x", "y"});
  for (int i = 0; i <= 40; ++i) obstacle.add({-0.1 + 0.03 * i, -gap(-0.1 + 0.03 * i)});
  obstacle.write(out / "obstacle.csv");
}

/// u = (s g', -s' g) with s = sin^2(pi x) and g = y^3 (1 - y)^2: a field that keeps the
/// volume, without traction on y = 0, and 0 on the other sides of the unit square. The load
/// -lap u belongs to it at every lambda, with the pressure 0.
struct Swirl {
  static std::array<double, 4> s(double x) {  ///< s and its derivatives
    using std::numbers::pi;
    const double sine = std::sin(2 * pi * x), cosine = std::cos(2 * pi * x);
    return {(1 - cosine) / 2, pi * sine, 2 * pi * pi * cosine, -4 * pi * pi * pi * sine};
  }
  static std::array<double, 4> g(double y) {
    return {y * y * y * (1 - y) * (1 - y), y * y * (3 - 8 * y + 5 * y * y),
            y * (6 - 24 * y + 20 * y * y), 6 - 48 * y + 60 * y * y};
  }
  static double load_x(double x, double y) {
    return -s(x)[2] * g(y)[1] - s(x)[0] * g(y)[3];
  }
  static double load_y(double x, double y) { return s(x)[3] * g(y)[0] + s(x)[1] * g(y)[2]; }
  static Eigen::Matrix2d gradient(double x, double y) {  ///< a row per component
    Eigen::Matrix2d rows;
    rows << s(x)[1] * g(y)[1], s(x)[0] * g(y)[2], -s(x)[2] * g(y)[0], -s(x)[1] * g(y)[1];
    return rows;
  }
};

/// Returns the squared error of the gradient of one component in L2.
inline double squared_gradient_error(const Space& space, const Eigen::VectorXd& u,
                                     int component) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = triangle_rule(8);
  double squared = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d lambda = rule.points.row(q);
      const Eigen::Vector2d x = point_in(mesh, t, lambda);
      const Eigen::RowVector2d discrete = u(space.cell_dofs().row(t)).transpose() *
                                          space.element().derivative(lambda) *
                                          barycentric_gradients(mesh, t);
      const Eigen::RowVector2d off = Swirl::gradient(x(0), x(1)).row(component) - discrete;
      squared += mesh.area(t) * rule.weights(q) * off.squaredNorm();
    }
  return squared;
}

}  // namespace antilock::tutorial
