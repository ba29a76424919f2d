#include "antilock/form/elasticity_forms.hpp"

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Gradients of the three basis functions of a component on a triangle, 3 x 2, and their unknowns in the whole vector.
struct Component {
  Eigen::Matrix<double, 3, 2> gradient;
  Eigen::Vector3i unknown;
};

Component component(const Space& space, int first, int t) {
  if (space.element().degree() != 1)
    throw Error("elasticity: element " + space.element().name() + " is not accepted; P1 or CR");
  const Eigen::Matrix3d derivative = space.element().derivative(Eigen::Vector3d::Constant(1.0 / 3));
  return {derivative * barycentric_gradients(space.mesh(), t),
          (space.unknowns().row(t).transpose().array() + first).matrix()};
}

Eigen::SparseMatrix<double> sum(const VectorSpace& space, const Triplets& entries) {
  Eigen::SparseMatrix<double> matrix(space.size(), space.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// The step of the component across edge e at its first end (on the boundary: from the prescribed midpoint value), as
/// coefficients of the unknowns. A CR function is affine along the edge and meets at the midpoint: at the other end it
/// is the opposite.
std::vector<std::pair<int, double>> jump(const Space& space, int first, int e) {
  const TriangleMesh& mesh = space.mesh();
  std::vector<std::pair<int, double>> coefficients;
  for (int side = 0; side < 2; ++side) {
    const int t = mesh.edge_triangles(e, side);
    if (t < 0) continue;
    Eigen::Vector3d end = Eigen::Vector3d::Zero(), middle = end;
    for (int i = 0; i < 3; ++i) {
      if (mesh.triangles(t, i) == mesh.edges(e, 0)) end(i) = 1;
      if (mesh.triangle_edges(t, i) != e) middle(i) = 0.5;
    }
    const Eigen::VectorXd basis = space.element().basis(end) - space.element().basis(middle);
    for (int i = 0; i < 3; ++i)
      coefficients.emplace_back(first + space.unknowns()(t, i), side == 0 ? basis(i) : -basis(i));
  }
  return coefficients;
}

}  // namespace

Eigen::SparseMatrix<double> strain_form(const VectorSpace& space) {
  const TriangleMesh& mesh = space.x.mesh();
  Triplets entries;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Component x = component(space.x, 0, t), y = component(space.y, space.x.size(), t);
    // rows: eps_xx, eps_yy, 2 eps_xy; 2 eps:eps = 2 eps_xx^2 + 2 eps_yy^2 + (2 eps_xy)^2
    Eigen::Matrix<double, 3, 6> strain = Eigen::Matrix<double, 3, 6>::Zero();
    strain.block<1, 3>(0, 0) = x.gradient.col(0).transpose();
    strain.block<1, 3>(1, 3) = y.gradient.col(1).transpose();
    strain.block<1, 3>(2, 0) = x.gradient.col(1).transpose();
    strain.block<1, 3>(2, 3) = y.gradient.col(0).transpose();
    const Eigen::Matrix<double, 6, 6> local =
        mesh.area(t) * strain.transpose() * Eigen::Vector3d(2, 2, 1).asDiagonal() * strain;
    Eigen::Matrix<int, 6, 1> unknown;
    unknown << x.unknown, y.unknown;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) entries.emplace_back(unknown(i), unknown(j), local(i, j));
  }
  return sum(space, entries);
}

FactoredForm divergence(const VectorSpace& space) {
  const TriangleMesh& mesh = space.x.mesh();
  FactoredForm b;
  Triplets entries;
  b.m.resize(mesh.triangle_count());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Component x = component(space.x, 0, t), y = component(space.y, space.x.size(), t);
    for (int i = 0; i < 3; ++i) {
      entries.emplace_back(t, x.unknown(i), x.gradient(i, 0));
      entries.emplace_back(t, y.unknown(i), y.gradient(i, 1));
    }
    b.m(t) = mesh.area(t);
    b.cell.push_back(t);
  }
  b.b.resize(mesh.triangle_count(), space.size());
  b.b.setFromTriplets(entries.begin(), entries.end());
  return b;
}

Eigen::SparseMatrix<double> jump_form(const VectorSpace& space, double weight, bool clamped_in_x) {
  const TriangleMesh& mesh = space.x.mesh();
  Triplets entries;
  for (const auto& [part, first] : {std::pair<const Space*, int>{&space.x, 0}, {&space.y, space.x.size()}}) {
    if (part->element().per_edge() == 0) continue;  // conforming: no steps
    for (int e = 0; e < mesh.edge_count(); ++e) {
      const bool interior = mesh.edge_triangles(e, 1) >= 0;
      const bool held = mesh.edge_tag[e] == EdgeTag::clamped && (clamped_in_x || part == &space.y);
      if (!interior && !held) continue;
      // |e|^-1 int_e of an affine function from s to -s squared: s^2 / 3; times 2 mu
      const auto step = jump(*part, first, e);
      for (const auto& [i, a] : step)
        for (const auto& [j, b] : step) entries.emplace_back(i, j, 2 * weight * a * b / 3);
    }
  }
  return sum(space, entries);
}

}  // namespace antilock
