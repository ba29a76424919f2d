#pragma once
#include <Eigen/Core>
#include <array>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// The kinds of cells. All cells of a mesh are of one kind.
enum class CellKind { triangle, quadrilateral, tetrahedron };

/// The reference cell of a kind, whose points have c coordinates xi:
///
/// - triangle, tetrahedron: the barycentric coordinates, c = n; vertex i is the i-th unit vector
/// - quadrilateral: (s, t) in the unit square, c = 2; its vertices are (0, 0), (1, 0), (1, 1),
///   (0, 1)
///
/// The map to a cell with the vertices x_i is x = sum_i N_i(xi) x_i. The N_i are the vertex
/// functions (space/cell_map.hpp). They are the barycentric coordinates of a simplex, and bilinear
/// on a square. A facet is an edge of a plane cell and a triangle of a tetrahedron, so that it is a
/// simplex with d vertices.
struct ReferenceCell {
  const char* name;
  const char* plural;
  int dimension;                           ///< d
  int vertices;                            ///< n
  int edges;                               ///< in the plane they are the facets
  int facets;                              ///< f
  int coordinates;                         ///< c
  bool simplex;                            ///< the map is affine
  std::array<std::array<int, 2>, 6> edge;  ///< row i: the local vertices of edge i
  /// Row i: the d local vertices of facet i. In a positively oriented cell their order gives an
  /// outward normal. Facet i of a simplex is opposite vertex i.
  std::array<std::array<int, 3>, 4> facet;
};

inline constexpr std::array<ReferenceCell, 3> reference_cells{
    {{"triangle",
      "triangles",
      2,
      3,
      3,
      3,
      3,
      true,
      {{{1, 2}, {2, 0}, {0, 1}}},
      {{{1, 2}, {2, 0}, {0, 1}}}},
     {"quadrilateral",
      "quadrilaterals",
      2,
      4,
      4,
      4,
      2,
      false,
      {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
      {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}}},
     {"tetrahedron",
      "tetrahedra",
      3,
      4,
      6,
      4,
      4,
      true,
      {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}},
      {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}}}}};

constexpr const ReferenceCell& reference_cell(CellKind kind) {
  return reference_cells[static_cast<int>(kind)];
}

/// A point of a reference cell: its c coordinates xi.
using ReferencePoint = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 4, 1>;
/// A row of c numbers per point, or per basis function.
using ReferencePoints =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Eigen::Dynamic, 4>;

/// Returns vertex i of a reference cell.
inline ReferencePoint reference_vertex(CellKind kind, int i) {
  const ReferenceCell& cell = reference_cell(kind);
  if (cell.simplex) return ReferencePoint::Unit(cell.coordinates, i);
  return Eigen::Vector2d(i == 1 || i == 2, i >= 2);
}
/// Returns whether a point of the reference cell lies on facet i.
inline bool lies_on_facet(CellKind kind, int i, const ReferencePoint& xi) {
  if (reference_cell(kind).simplex) return xi(i) == 0;
  const std::array<bool, 4> on{xi(1) == 0, xi(0) == 1, xi(1) == 1, xi(0) == 0};
  return on[i];
}

/// Returns body.operator()<kind>(). The kind is a constant there, so that a loop over cells is
/// compiled for each kind with matrices of a fixed size:
/// `with_kind(mesh.kind, [&]<CellKind kind>() { ... })`.
template <class Body>
decltype(auto) with_kind(CellKind kind, Body&& body) {
  if (kind == CellKind::triangle) return body.template operator()<CellKind::triangle>();
  if (kind == CellKind::quadrilateral) return body.template operator()<CellKind::quadrilateral>();
  return body.template operator()<CellKind::tetrahedron>();
}

}  // namespace antilock
