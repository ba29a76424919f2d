#pragma once
// The load of chapter 03, by a rule for triangles, and its files.
#include "antilock/io/write_csv.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// One row per corner of a triangle: x and y.
using Corners = Eigen::Matrix<double, 3, 2>;

/// Adds int f phi_i over a triangle of this area to the entries of its three vertices:
/// Radon's rule of seven points lambda, where phi_i(lambda) = lambda_i; f = 10 sin(2 pi x).
inline void add_loads(Eigen::VectorXd& load, const Eigen::RowVector3i& vertices,
                      const Corners& corners, double area) {
  for (Eigen::Index q = 0; q < radon_rule().weights.size(); ++q) {
    const Eigen::Vector3d lambda = radon_rule().points.row(q);
    const double x = corners.col(0).dot(lambda);
    load(vertices) += area * radon_rule().weights(q) * paper_load(x, 0) * lambda;
  }
}

/// Prints both tables; writes corrections.csv, and solution.csv and .vtu for the picture.
inline void show_by_hand(const std::filesystem::path& out, const Space& space,
                         const Eigen::VectorXd& u, const Table& corrections,
                         const Table& stresses) {
  corrections.print("the corrections");
  corrections.write(out / "corrections.csv");
  stresses.print("the layer stress");
  write_solution_csv(out / "solution.csv", space, u);
  write_vtu(out / "solution.vtu", space, u);
}

}  // namespace antilock::tutorial
