#pragma once
// Meshes, forms of the mesh, and pictures of 39_three_dimensions.
#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "antilock/analysis/kernel.hpp"
#include "antilock/exact/exact_solution_in_space.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/cell_map.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// The slopes q_i = d/dz lambda_i of the four hat functions of a tetrahedron, and its
/// matrix Q = sum_i q_i p_i p_i^T, p_i the corners seen from above.
struct Bending {
  Eigen::Vector4d slopes;
  Eigen::Matrix2d matrix;  ///< a length
};
inline Bending bending(const Mesh& mesh, int t) {
  const CellMap<CellKind::tetrahedron> map(mesh, t);
  Bending bend{map.at(Eigen::Vector4d::Constant(0.25)).gradient.col(2),
               Eigen::Matrix2d::Zero()};
  for (int i = 0; i < 4; ++i) {
    // Q does not depend on the origin. A corner of the cell saves digits.
    const Eigen::Vector2d p = (map.corners().col(i) - map.corners().col(0)).head<2>();
    bend.matrix += bend.slopes(i) * p * p.transpose();
  }
  return bend;
}

/// Returns the mean over the layer of a number of each tetrahedron, weighted by volumes.
inline double layer_mean(const Mesh& mesh, const std::function<double(int)>& value) {
  double sum = 0, volume = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    sum += mesh.measure(t) * value(t);
    volume += mesh.measure(t);
  }
  return sum / volume;
}

/// Returns the bending length k of a mesh in space: k^2 is a quarter of the mean of
/// (e . Q e)^2 over the layer and over all horizontal directions e.
inline double bending_length_in_space(const Mesh& mesh) {
  const auto mean_square = [&](int t) {
    const Eigen::Matrix2d q = bending(mesh, t).matrix;
    return q.trace() * q.trace() / 8 + q.squaredNorm() / 4;
  };
  return std::sqrt(layer_mean(mesh, mean_square) / 4);
}

/// Returns the integral over the layer of (d/dz I_h w)^2 for w = sin ax sin by, from the
/// matrices Q alone: 1/16 of the mean of (a^2 Q_11 + b^2 Q_22)^2 + (2 ab Q_12)^2.
inline double squared_slope_of_ridge(const Mesh& mesh, double a, double b) {
  return layer_mean(mesh,
                    [&](int t) {
                      const Eigen::Matrix2d q = bending(mesh, t).matrix;
                      return std::pow(a * a * q(0, 0) + b * b * q(1, 1), 2) +
                             std::pow(2 * a * b * q(0, 1), 2);
                    }) /
         16;
}

/// Whether two vertices of a tetrahedron lie on one vertical line.
inline bool has_vertical_edge(const Mesh& mesh, int t) {
  const auto place = [&](int i) {
    return Eigen::Vector2d(mesh.vertices.row(mesh.triangles(t, i)).head<2>());
  };
  for (const auto& [i, j] : mesh.reference().edge)
    if ((place(i) - place(j)).norm() < 1e-9) return true;
  return false;
}

/// The number of faces of each kind around the layer.
struct LayerFaces {
  int sigma = 0, bottom = 0, sides = 0;
};
inline LayerFaces layer_faces(const Mesh& mesh) {
  LayerFaces faces;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool of_layer = mesh.region[mesh.edge_triangles(e, 0)] == Region::layer;
    if (mesh.edge_tag[e] == EdgeTag::sigma) ++faces.sigma;
    if (mesh.edge_tag[e] == EdgeTag::contact) ++faces.bottom;
    if (is_dirichlet(mesh.edge_tag[e]) && of_layer) ++faces.sides;
  }
  return faces;
}

/// The size of a Cholesky factor L: its entries, and the multiplications that compute it,
/// the sum of the squares of the numbers of entries in its columns.
struct FactorSize {
  double unknowns = 0, entries = 0, multiplications = 0;
};
/// Factors A1 + B' M B on the free unknowns in the order of Eigen's AMD, a minimum degree
/// ordering.
inline FactorSize factor_size(const VariationalInequality& problem) {
  const SparseMatrix free = free_prolongation(problem);
  const SparseMatrix b = SparseMatrix(problem.b) * free;
  const SparseMatrix k = SparseMatrix(free.transpose() * problem.a1 * free) +
                         SparseMatrix(b.transpose() * problem.m.asDiagonal() * b);
  const Eigen::SimplicialLLT<SparseMatrix> cholesky(k);
  const auto& factor = cholesky.matrixL().nestedExpression();
  FactorSize size{static_cast<double>(k.rows())};
  for (Eigen::Index j = 0; j < factor.cols(); ++j) {
    const double column = factor.outerIndexPtr()[j + 1] - factor.outerIndexPtr()[j];
    size.entries += column;
    size.multiplications += column * column;
  }
  return size;
}

/// Returns the values of u at the four corners of a cell, seen from inside of it.
inline Eigen::Vector4d corner_values(const Space& space, const Eigen::VectorXd& u, int t) {
  Eigen::Vector4d values;
  for (int i = 0; i < 4; ++i) {
    const Eigen::VectorXd basis =
        space.element().basis(reference_vertex(CellKind::tetrahedron, i));
    values(i) = basis.dot(u(space.cell_dofs().row(t)));
  }
  return values;
}

/// Writes u on Gamma_C as a VTU file of triangles in the plane, with jumps between faces.
inline void write_contact_surface(const std::filesystem::path& path, const Space& space,
                                  const Eigen::VectorXd& u) {
  const Mesh& mesh = space.mesh();
  std::vector<int> faces;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::contact) faces.push_back(e);
  const auto count = static_cast<int>(faces.size());
  Mesh bottom;
  bottom.vertices = mesh.vertices.leftCols(2);
  bottom.triangles.resize(count, 3);
  bottom.region.assign(faces.size(), Region::layer);
  Eigen::MatrixX3d heights(count, 3);
  for (int k = 0; k < count; ++k) {
    const int t = mesh.edge_triangles(faces[k], 0);
    const Eigen::Vector4d values = corner_values(space, u, t);
    for (int i = 0; i < 3; ++i) {
      const int local = mesh.reference().facet[local_edge(mesh, t, faces[k])][i];
      bottom.triangles(k, i) = mesh.triangles(t, local);
      heights(k, i) = values(local);
    }
  }
  write_vtu(path, bottom, heights);
}

}  // namespace antilock::tutorial
