#pragma once
#include <Eigen/Core>
#include <compare>
#include <functional>
#include <string>
#include <vector>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/core/error.hpp"
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

/// n x 2, coordinates x, y
using Points = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
/// n x 3, indices from 0
using Triples = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
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

/// A conforming mesh of Omega (Figure 2): positively oriented triangles, numbered edges, tagged
/// boundary. Lengths are in the unit of the coordinates (body_size). In the generated meshes of
/// Figure 2 the side of the body is 1.
struct TriangleMesh {
  Points vertices;             ///< V x 2
  Triples triangles;           ///< T x 3 vertices, counterclockwise
  std::vector<Region> region;  ///< T
  Pairs edges;                 ///< E x 2 vertices, the smaller index first
  Triples triangle_edges;      ///< T x 3 edges; edge i lies opposite vertex i
  Pairs edge_triangles;        ///< E x 2 triangles; the second is -1 on the boundary
  /// E; sigma between body and layer; never interior on the boundary
  std::vector<EdgeTag> edge_tag;
  Geometry geometry = {};  ///< the curves on which the boundary of the body has its vertices

  /// T, where the layer follows a curved Sigma; else empty
  std::vector<CurvedColumn> curved_columns = {};

  bool curved() const { return !curved_columns.empty(); }
  int vertex_count() const { return static_cast<int>(vertices.rows()); }
  int triangle_count() const { return static_cast<int>(triangles.rows()); }
  int edge_count() const { return static_cast<int>(edges.rows()); }
  /// Twice the signed area; positive for every triangle of a checked mesh.
  double twice_area(int triangle) const;
  double area(int triangle) const { return 0.5 * twice_area(triangle); }
  double edge_length(int edge) const;
  /// The location of a vertex as text, "(x, y)", for messages.
  std::string location_text(int vertex) const;
  /// The longest edge: the paper's h (1/cells times sqrt(2) on a structured mesh).
  double diameter() const;
};

/// An edge of the input that carries a physical group.
struct TaggedEdge {
  int from, to;  ///< vertices
  EdgeTag tag;
};

/// Returns the number i = 0, 1, 2 of an edge in a triangle: it is opposite local vertex i. Throws
/// Error unless it is an edge of the triangle.
int local_edge(const TriangleMesh& mesh, int triangle, int edge);

/// Returns the longer side of the box around the triangles of the body, in the unit of the
/// coordinates of the mesh. A mesh has the unit of its file. Therefore tolerances of lengths are
/// fractions of this size. For a mesh without a body it is the longer side of the whole box.
double body_size(const TriangleMesh& mesh);

/// Numbers the edges and checks all properties on which a finite element relies. `surface` gives
/// for each triangle the number (0, 1, ...) of its surface. If all triangles of a surface have the
/// wrong orientation, they are turned round. Where `surface` is empty, the regions are the
/// surfaces. `where` is the beginning of every message (a file name, or the name of a generator).
///
/// Throws Error for indices out of range, values that are not finite, a single inverted triangle,
/// degenerate triangles (twice the area below 1e-14 of the longest edge squared), unused vertices,
/// two vertices at one place unless they are on edges of two named groups, edges of three triangles
/// or of overlapping ones, boundary edges without a tag (as at a hanging node), tagged edges that
/// are no edge of the mesh, a mesh without a body, and a mesh without an edge that is clamped or in
/// a named group.
TriangleMesh make_triangle_mesh(Points vertices, Triples triangles, std::vector<Region> region,
                                const std::vector<TaggedEdge>& tagged_edges,
                                const std::string& where, const std::vector<int>& surface = {});

/// Returns a triangle of a component without an edge that is `held` (a floating subdomain in the
/// words of FETI), or -1 if there is none. Components are connected by edges, not by vertices.
int find_floating_component(const TriangleMesh& mesh, const std::function<bool(int edge)>& held);

/// Fills edges, triangle_edges and edge_triangles from vertices and triangles, in linear time where
/// no vertex has many neighbours. Every edge_tag becomes interior, or sigma between body and layer.
/// `where` is the beginning of the message of the Error for an edge of three triangles.
void number_edges(TriangleMesh& mesh, const std::string& where);

/// Returns the mesh of a generator, whose triangles are counterclockwise and need no check. Regions
/// and tags follow from the positions (Figure 2): the layer lies below y = 0, the lowest line is
/// Gamma_C, all other sides are clamped.
TriangleMesh tag_by_position(Points vertices, Triples triangles);

}  // namespace antilock
