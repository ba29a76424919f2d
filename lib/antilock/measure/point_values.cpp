#include "antilock/measure/point_values.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/space/cell_map.hpp"

namespace antilock {
namespace {

template <int d>
constexpr CellKind simplex = d == 2 ? CellKind::triangle : CellKind::tetrahedron;

template <int d>
auto gradients_of_coordinates(const Mesh& mesh, int t) {
  using Map = CellMap<simplex<d>>;
  return Map(mesh, t).at(Map::Coordinates::Zero()).gradient;  // the same at each point
}

/// Asked by Eigen's walk through the boxes: the cell of the smallest number that holds x.
template <int d>
struct Search {
  using Point = Eigen::Matrix<double, d, 1>;
  using Box = Eigen::AlignedBox<double, d>;

  const Mesh& mesh;
  Point x;
  double outside, beyond;  ///< of a cell's size, and of its box
  PointValues::Location found{-1, {}};

  /// The rounding of the coordinates, which far from the origin is more than `outside`.
  double ulp() const { return (std::numeric_limits<double>::epsilon() * x.cwiseAbs()).sum(); }

  bool intersectVolume(const Box& box) const {
    return box.exteriorDistance(x) <= beyond * box.diagonal().norm() + ulp() * 4;
  }
  bool intersectObject(int t) {
    const Point corner = mesh.vertices.row(mesh.triangles(t, 0));
    const Eigen::Matrix<double, d + 1, d> slopes = gradients_of_coordinates<d>(mesh, t);
    Eigen::Matrix<double, d + 1, 1> lambda = slopes * (x - corner);
    lambda(0) += 1;
    if (lambda.minCoeff() >= -outside - ulp() * slopes.cwiseAbs().maxCoeff() &&
        (found.triangle < 0 || t < found.triangle))
      found = {t, lambda};
    return false;  // on to the next
  }
};

template <int d>
void init(Eigen::KdBVH<double, d, int>& tree, const Mesh& mesh) {
  std::vector<int> cells(std::max(2, mesh.triangle_count()));  // a tree has two leaves or more
  std::vector<Eigen::AlignedBox<double, d>> boxes(cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    cells[k] = std::min(static_cast<int>(k), mesh.triangle_count() - 1);
    for (const int v : mesh.triangles.row(cells[k]))
      boxes[k].extend(mesh.vertices.row(v).transpose());
  }
  tree.init(cells.begin(), cells.end(), boxes.begin(), boxes.end());
}

template <int d>
PointValues::Location nearest_cell(const Eigen::KdBVH<double, d, int>& tree, const Mesh& mesh,
                                   const Eigen::Vector3d& x, double outside) {
  // a point with lambda >= -outside lies at most d outside diameters beyond the cell, and lambda is
  // rounded
  Search<d> search{mesh, x.head<d>(), outside, d * outside + 1e-9};
  Eigen::BVIntersect(tree, search);
  return search.found;
}

template <int d>
Eigen::Vector3d gradient_in(const Space& space, const Eigen::VectorXd& u,
                            const PointValues::Location& at) {
  const Eigen::Matrix<double, Eigen::Dynamic, d + 1> derivative =
      space.element().derivative(at.lambda);
  const Eigen::Matrix<double, Eigen::Dynamic, d> slopes =
      derivative * gradients_of_coordinates<d>(space.mesh(), at.triangle);
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  gradient.head<d>() = slopes.transpose() * u(space.cell_dofs().row(at.triangle));
  return gradient;
}

}  // namespace

PointValues::PointValues(const Space& space) : space_(space) {
  const Mesh& mesh = space.mesh();
  if (!mesh.reference().simplex)
    throw Error(std::string("values at points: a mesh of ") + mesh.reference().plural +
                "; accepted: triangles and tetrahedra");
  if (mesh.dimension() == 3) tree_.emplace<Tree<3>>();
  std::visit([&](auto& tree) { init(tree, mesh); }, tree_);
}

std::optional<PointValues::Location> PointValues::locate(const Eigen::Vector3d& x,
                                                         double outside) const {
  const Location found = std::visit(
      [&](const auto& tree) { return nearest_cell(tree, space_.mesh(), x, outside); }, tree_);
  return found.triangle >= 0 ? std::optional(found) : std::nullopt;
}

double PointValues::value(const Eigen::VectorXd& u, const Location& at) const {
  return space_.element().basis(at.lambda).dot(u(space_.cell_dofs().row(at.triangle)));
}

Eigen::Vector3d PointValues::gradient(const Eigen::VectorXd& u, const Location& at) const {
  if (space_.mesh().dimension() == 3) return gradient_in<3>(space_, u, at);
  return gradient_in<2>(space_, u, at);
}

}  // namespace antilock
