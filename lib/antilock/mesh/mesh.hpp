#pragma once
#include <Eigen/Core>
#include <array>
#include <compare>
#include <functional>
#include <string>
#include <vector>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/core/error.hpp"
#include "antilock/mesh/cell_kind.hpp"
#include "antilock/mesh/geometry.hpp"

namespace antilock {

/// An Error about a mesh. Its message does not say what is accepted, because this depends on the
/// problem, which the caller knows.
struct MeshError : Error {
  using Error::Error;
};

/// The physical groups of the triangles, Figure 2 of [SR04] (cited in
/// problem/variational_inequality.hpp). The numbers are those of the MSH and FreeFEM files.
enum class Region { body = 1, layer = 2 };

/// The kind of an edge and, for an edge of a named group, the number of that group. Tags are
/// ordered by kind, then by group.
struct EdgeTag {
  enum class Kind {
    interior,
    sigma,      ///< Sigma, the edges between body and layer
    clamped,    ///< u = 0
    contact,    ///< Gamma_C, the bottom of the layer or, without one, of the body
    free,       ///< no condition
    natural,    ///< of a named group without Dirichlet data: free, a traction or a spring
    dirichlet,  ///< of a named group with Dirichlet data
  };
  Kind kind = Kind::interior;
  /// The index k = 0, 1, ... of a named group in Scene::edges(); -1 for the other kinds.
  int group = -1;

  static const EdgeTag interior, sigma, clamped, contact, free;
  auto operator<=>(const EdgeTag&) const = default;
};
inline constexpr EdgeTag EdgeTag::interior{Kind::interior};
inline constexpr EdgeTag EdgeTag::sigma{Kind::sigma};
inline constexpr EdgeTag EdgeTag::clamped{Kind::clamped};
inline constexpr EdgeTag EdgeTag::contact{Kind::contact};
inline constexpr EdgeTag EdgeTag::free{Kind::free};

constexpr EdgeTag natural_group(int k) { return {EdgeTag::Kind::natural, k}; }
constexpr EdgeTag dirichlet_group(int k) { return {EdgeTag::Kind::dirichlet, k}; }
constexpr bool is_dirichlet(EdgeTag tag) {
  return tag.kind == EdgeTag::Kind::clamped || tag.kind == EdgeTag::Kind::dirichlet;
}

/// n x d, coordinates x, y and, in space, z
using Points =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, Eigen::Dynamic, 3>;
/// The d coordinates of one point.
using Position = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 3>;
/// n x k, k <= 4 indices from 0 in a row
using IndexRows =
    Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, Eigen::Dynamic, 4>;
using Triples = IndexRows;  ///< n x 3, the vertices of triangles
/// n x 2, indices from 0
using Pairs = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The geometry of a column below an edge of a curved Sigma, which is y = intercept + slope x
/// (mesh/layered.hpp).
struct CurvedColumn {
  double intercept = 0, slope = 0;
  double curvature = 0;  ///< of Sigma; above 0 where the normals out of the body diverge

  /// The Jacobian 1 + thickness * curvature * depth at a point.
  double jacobian(const Eigen::Vector2d& x, double thickness) const {
    return 1 + thickness * curvature * (intercept + slope * x(0) - x(1));
  }
};

/// A conforming mesh of Omega (Figure 2) with V vertices and T cells of one kind: positively
/// oriented cells, numbered facets, tagged boundary. The letters d, n and f are those of its
/// reference cell. The last coordinate, y in the plane and z in space, is the one across the layer.
/// Lengths are in the unit of the coordinates (body_size). In the generated meshes of Figure 2 the
/// side of the body is 1.
struct Mesh {
  CellKind kind = CellKind::triangle;
  Points vertices;             ///< V x d
  IndexRows triangles;         ///< T x n vertices, positively oriented
  std::vector<Region> region;  ///< T
  IndexRows edges;             ///< E x d vertices of each facet, ascending
  IndexRows triangle_edges;    ///< T x f facets, in the order of the reference cell
  Pairs edge_triangles;        ///< E x 2 cells; the second is -1 on the boundary
  /// E; sigma between body and layer; never interior on the boundary
  std::vector<EdgeTag> edge_tag;
  Geometry geometry = {};  ///< the curves on which the boundary of the body has its vertices

  /// T, where the layer follows a curved Sigma; else empty
  std::vector<CurvedColumn> curved_columns = {};

  const ReferenceCell& reference() const { return reference_cell(kind); }
  int dimension() const { return reference().dimension; }
  /// The coordinate across the layer: 1 in the plane, 2 in space.
  int vertical() const { return dimension() - 1; }
  bool curved() const { return !curved_columns.empty(); }
  int vertex_count() const { return static_cast<int>(vertices.rows()); }
  int triangle_count() const { return static_cast<int>(triangles.rows()); }
  int edge_count() const { return static_cast<int>(edges.rows()); }
  /// Twice the signed area of a triangle; positive in a checked mesh. Throws Error for another
  /// cell.
  double twice_area(int triangle) const;
  /// The area or the volume of a cell.
  double measure(int cell) const;
  double area(int triangle) const { return 0.5 * twice_area(triangle); }
  /// The length of an edge or the area of a facet in space.
  double facet_measure(int facet) const;
  /// The length of an edge in the plane. Throws Error in space.
  double edge_length(int edge) const;
  /// The location of a vertex as text, "(x, y)" or "(x, y, z)", for messages.
  std::string location_text(int vertex) const;
  /// The longest edge: the paper's h (1/cells times sqrt(2) on a structured mesh of triangles).
  double diameter() const;
};

/// A facet of the input that carries a physical group.
struct TaggedEdge {
  TaggedEdge(int from, int to, EdgeTag group) : vertices{from, to, -1}, tag(group) {}
  TaggedEdge(int a, int b, int c, EdgeTag group) : vertices{a, b, c}, tag(group) {}
  std::array<int, 3> vertices;  ///< d of them; of an edge the third is -1
  EdgeTag tag;
};

/// Returns the number i = 0, 1, ... of a facet in a cell, in the order of its reference cell. Facet
/// i of a simplex is opposite vertex i. Throws Error unless it is a facet of the cell.
int local_edge(const Mesh& mesh, int cell, int edge);

/// Returns the longest side of the box around the cells of the body, in the unit of the
/// coordinates of the mesh. A mesh has the unit of its file. Therefore tolerances of lengths are
/// fractions of this size. For a mesh without a body it is the longer side of the whole box.
double body_size(const Mesh& mesh);

/// Numbers the facets and checks all properties on which a finite element relies. The cells are
/// triangles where the points have two coordinates, and tetrahedra where they have three. `surface`
/// gives for each cell the number (0, 1, ...) of its surface, in space of its volume. If all cells
/// of a surface have the wrong orientation, they are turned round. Where `surface` is empty, the
/// regions are the surfaces. `where` is the beginning of every message (a file name, or the name of
/// a generator).
///
/// Throws Error for indices out of range, values that are not finite, a single inverted cell,
/// degenerate cells (at each vertex the determinant of the edges there is at most 1e-14 times the
/// product of their lengths, or the area or volume is round-off; a thin cell along an axis is
/// none), unused vertices, two vertices at one place
/// unless they are on facets of two named groups, facets of three cells or of overlapping ones,
/// boundary facets without a tag (as at a hanging node), tagged facets that are no facet of the
/// mesh, a mesh without a body, and a mesh without a facet that is clamped or in a named group.
Mesh make_mesh(Points vertices, IndexRows cells, std::vector<Region> region,
               const std::vector<TaggedEdge>& tagged_edges, const std::string& where,
               const std::vector<int>& surface = {});

/// Throws Error where the cells are no triangles. `who` is the beginning of the message.
void require_triangles(const Mesh& mesh, const char* who);

/// Returns a cell of a component without a facet that is `held` (a floating subdomain in the words
/// of FETI), or -1 if there is none. Components are connected by facets, not by vertices.
int find_floating_component(const Mesh& mesh, const std::function<bool(int facet)>& held);

/// Fills edges, triangle_edges and edge_triangles from vertices and cells, in linear time where no
/// vertex has many neighbours. Every edge_tag becomes interior, or sigma between body and layer.
/// `where` is the beginning of the message of the Error for a facet of three cells.
void number_edges(Mesh& mesh, const std::string& where);

/// The numbers of the edges of the cells. Tetrahedra share edges without sharing a facet, so a mesh
/// of them does not number its edges. A space with unknowns on edges does.
struct CellEdges {
  int count = 0;  ///< the number of edges of the mesh
  /// T x (edges of the reference cell), in its order
  Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> of_cell;
};
/// Returns the edges of the cells of a mesh of tetrahedra. Throws Error for a mesh in the plane,
/// whose edges are its facets.
CellEdges cell_edges(const Mesh& mesh);

/// Returns the mesh of a generator, whose cells are positively oriented and need no check. Regions
/// and tags follow from the positions (Figure 2): the layer lies below 0 in the last coordinate,
/// the lowest facets are Gamma_C, all other sides are clamped.
Mesh tag_by_position(Points vertices, IndexRows cells, CellKind kind = CellKind::triangle);

}  // namespace antilock
