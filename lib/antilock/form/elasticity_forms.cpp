#include "antilock/form/elasticity_forms.hpp"

#include <algorithm>

namespace antilock {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// The basis functions of a component on a triangle: derivatives by the barycentric coordinates at each point of a rule
/// (the same on every triangle), and the unknowns in the whole vector.
class Component {
 public:
  Component(const Space& space, int first, const Quadrature& rule) : space_(space), first_(first) {
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
      derivative_.push_back(space.element().derivative(rule.points.row(q)));
  }
  int unknowns() const { return space_.element().unknowns(); }
  Eigen::VectorXi unknown(int t) const { return (space_.unknowns().row(t).transpose().array() + first_).matrix(); }
  /// m x 2
  Eigen::MatrixX2d gradient(Eigen::Index q, const Eigen::Matrix<double, 3, 2>& barycentric) const {
    return derivative_[q] * barycentric;
  }

 private:
  const Space& space_;
  int first_;
  std::vector<Eigen::MatrixX3d> derivative_;
};

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

const Quadrature& divergence_rule(const VectorSpace& space) {
  return triangle_rule(2 * (std::max(space.x.element().degree(), space.y.element().degree()) - 1));
}

Eigen::SparseMatrix<double> strain_form(const VectorSpace& space) {
  const TriangleMesh& mesh = space.x.mesh();
  const Quadrature& rule = divergence_rule(space);
  const Component x(space.x, 0, rule), y(space.y, space.x.size(), rule);
  const int m = x.unknowns(), n = y.unknowns();
  Triplets entries;
  Eigen::VectorXi unknown(m + n);
  Eigen::Matrix3Xd strain = Eigen::Matrix3Xd::Zero(3, m + n);
  Eigen::MatrixXd local(m + n, m + n);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> barycentric = barycentric_gradients(mesh, t);
    local.setZero();
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::MatrixX2d of_x = x.gradient(q, barycentric), of_y = y.gradient(q, barycentric);
      // rows: eps_xx, eps_yy, 2 eps_xy; 2 eps:eps = 2 eps_xx^2 + 2 eps_yy^2 + (2 eps_xy)^2
      strain.row(0).head(m) = of_x.col(0).transpose();
      strain.row(1).tail(n) = of_y.col(1).transpose();
      strain.row(2) << of_x.col(1).transpose(), of_y.col(0).transpose();
      local += rule.weights(q) * mesh.area(t) * strain.transpose() * Eigen::Vector3d(2, 2, 1).asDiagonal() * strain;
    }
    unknown << x.unknown(t), y.unknown(t);
    for (int i = 0; i < m + n; ++i)
      for (int j = 0; j < m + n; ++j) entries.emplace_back(unknown(i), unknown(j), local(i, j));
  }
  return sum(space, entries);
}

FactoredForm divergence(const VectorSpace& space) {
  const TriangleMesh& mesh = space.x.mesh();
  const Quadrature& rule = divergence_rule(space);
  const Component x(space.x, 0, rule), y(space.y, space.x.size(), rule);
  const auto points = static_cast<int>(rule.weights.size());
  FactoredForm b;
  Triplets entries;
  b.m.resize(mesh.triangle_count() * points);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> barycentric = barycentric_gradients(mesh, t);
    for (int q = 0; q < points; ++q) {
      const int row = t * points + q;
      for (const auto& [part, direction] : {std::pair{&x, 0}, {&y, 1}}) {
        const Eigen::MatrixX2d gradient = part->gradient(q, barycentric);
        const Eigen::VectorXi unknown = part->unknown(t);
        for (int i = 0; i < part->unknowns(); ++i) entries.emplace_back(row, unknown(i), gradient(i, direction));
      }
      b.m(row) = rule.weights(q) * mesh.area(t);
      b.cell.push_back(t);
    }
  }
  b.b.resize(b.m.size(), space.size());
  b.b.setFromTriplets(entries.begin(), entries.end());
  return b;
}

Eigen::SparseMatrix<double> jump_form(const VectorSpace& space, double weight, bool clamped_in_x) {
  const TriangleMesh& mesh = space.x.mesh();
  Triplets entries;
  for (const auto& [part, first] : {std::pair<const Space*, int>{&space.x, 0}, {&space.y, space.x.size()}}) {
    if (part->element().conforming()) continue;  // no steps
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
