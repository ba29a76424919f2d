#include "antilock/runner/scene_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <variant>

#include "antilock/analysis/locking.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/runner/obstacle_check.hpp"

namespace antilock {
namespace {

/// The barycentric coordinates of point k in a simplex: a sequence of low discrepancy in the unit
/// square or cube (Roberts 2018), folded to the simplex. No two points of a run have the same x or
/// the same y, so that strips are found as well as spots. The fold of the cube keeps volumes
/// (C. Rocchini and P. Cignoni, J. Graphics Tools 5(4), 2000).
ReferencePoint spread_point(double k, int dimension) {
  if (dimension == 3) {
    constexpr double harmonious = 1.22074408460575947536;  // g^4 = g + 1
    double a = std::fmod(0.5 + k * (1 / harmonious), 1);
    double b = std::fmod(0.5 + k * (1 / (harmonious * harmonious)), 1);
    double c = std::fmod(0.5 + k * (1 / (harmonious * harmonious * harmonious)), 1);
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    const double height = c;
    if (b + height > 1) {
      c = 1 - a - b;
      b = 1 - height;
    } else if (a + b + height > 1) {
      c = a + b + height - 1;
      a = 1 - b - height;
    }
    return Eigen::Vector4d(1 - a - b - c, a, b, c);
  }
  constexpr double plastic = 1.32471795724474602596;
  double a = std::fmod(0.5 + k * (1 / plastic), 1);
  double b = std::fmod(0.5 + k * (1 / (plastic * plastic)), 1);
  if (a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  return Eigen::Vector3d(1 - a - b, a, b);
}

/// Up to 10 numbers, without memory from the heap.
using Monomials = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 10, 1>;

/// The monomials up to degree 2 of the barycentric coordinates but the first one, a and b in the
/// plane: 1, a, b, a a, a b, b b.
Monomials quadratics(const ReferencePoint& lambda) {
  const Eigen::Index d = lambda.size() - 1;
  Monomials monomials((d + 1) * (d + 2) / 2);
  monomials(0) = 1;
  monomials.segment(1, d) = lambda.tail(d);
  Eigen::Index next = d + 1;
  for (Eigen::Index i = 1; i <= d; ++i)
    for (Eigen::Index j = i; j <= d; ++j) monomials(next++) = lambda(i) * lambda(j);
  return monomials;
}

/// From the values at the points of a rule to the quadratic that fits them best.
Eigen::MatrixXd quadratic_fit(const Quadrature& rule) {
  const Eigen::Index d = rule.points.cols() - 1;
  Eigen::MatrixXd at_points(rule.weights.size(), (d + 1) * (d + 2) / 2);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    at_points.row(q) = quadratics(rule.points.row(q)).transpose();
  return pseudo_inverse(at_points);
}

/// V values: the displacement that is prescribed at a vertex, not a number where none is.
Eigen::VectorXd prescribed(const SceneFile& file, const TriangleMesh& mesh) {
  const Eigen::VectorXd given = std::visit(
      [&](const auto& model) { return model.dirichlet_values(file.scene, mesh); }, file.model);
  Eigen::VectorXd values = Eigen::VectorXd::Constant(mesh.vertex_count(), NAN);
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e))
      if (is_dirichlet(mesh.edge_tag[e])) values(v) = given(v);
  return values;
}

double body_measure(const Mesh& mesh) {
  double measure = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::body) measure += mesh.measure(t);
  return measure;
}

/// 1, x, y and, in space, z.
Monomials affine_functions(const Position& x) {
  Monomials values(1 + x.size());
  values << 1, x.transpose();
  return values;
}

/// The load f on the body by samples, which stand for the same area or volume each: a cell may have
/// many, or none.
class LoadSamples {
 public:
  LoadSamples(const Space& space, const Field& f)
      : space_(space),
        f_(f),
        measure_(body_measure(space.mesh())),
        sampled_(Eigen::VectorXd::Zero(1 + space.mesh().dimension())),
        size_(sampled_) {
    const Quadrature& rule = load_rule(space.element());
    const Eigen::MatrixXd fit = quadratic_fit(rule);
    const TriangleMesh& mesh = space.mesh();
    double due = 0;  // samples, of the cells so far, that have not been taken
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.region[t] != Region::body) continue;
      due += points * mesh.measure(t) / measure_;
      const int here = static_cast<int>(due);
      due -= here;
      if (here == 0) continue;
      // f is fitted on as many cells as leave its values at the points of the rule no more than
      // the samples
      const bool fits = at_points_ <= count_;
      Eigen::VectorXd quadratic;
      if (fits) quadratic = fit * values_at(rule, t);
      for (int i = 0; i < here; ++i) add_sample(t, fits, quadratic);
    }
  }

  double count() const { return count_; }
  const Eigen::VectorXd& integrals() const { return sampled_; }  ///< of f (1, x, y, z)
  const Eigen::VectorXd& sizes() const { return size_; }         ///< of |f| (1, |x|, |y|, |z|)
  /// Whether the integral of |f - q| is above a quarter of that of |f|, on the cells that are
  /// fitted. q is the quadratic that fits f best at the points of the rule.
  bool is_unseen() const { return unseen_ > 0.25 * fitted_; }
  double unseen_percent() const { return 100 * unseen_ / fitted_; }

 private:
  static constexpr int points = 1 << 18;

  Position point(int t, const ReferencePoint& lambda) const {
    const Mesh& mesh = space_.mesh();
    return position(mesh, t, lambda).head(mesh.dimension()).transpose();
  }

  Eigen::VectorXd values_at(const Quadrature& rule, int t) {
    Eigen::VectorXd values(rule.weights.size());
    for (Eigen::Index q = 0; q < values.size(); ++q)
      values(q) = field_value(f_, point(t, rule.points.row(q)));
    at_points_ += values.size();
    return values;
  }

  void add_sample(int t, bool fits, const Eigen::VectorXd& quadratic) {
    ++count_;
    const ReferencePoint lambda = spread_point(count_, space_.mesh().dimension());
    const Position x = point(t, lambda);
    const double part = field_value(f_, x) * measure_ / points;
    if (fits) {
      unseen_ += std::abs(part - quadratics(lambda).dot(quadratic) * measure_ / points);
      fitted_ += std::abs(part);
    }
    sampled_ += part * affine_functions(x);
    size_ += std::abs(part) * affine_functions(x.cwiseAbs());
  }

  const Space& space_;
  const Field& f_;
  double measure_;
  double count_ = 0;
  double at_points_ = 0;  ///< values of f at points of the rule
  Eigen::VectorXd sampled_;
  Eigen::VectorXd size_;
  double unseen_ = 0;  ///< the integral of |f - q|
  double fitted_ = 0;  ///< the integral of |f| on the same cells
};

/// The integrals of f (1, x, y, z) by the quadrature: the basis sums to 1, and with the places of
/// the unknowns as weights to x, y and z.
Eigen::VectorXd integrals_by_quadrature(const SceneFile& file, const Space& space,
                                        const VariationalInequality& problem) {
  const bool alone = beyond_the_paper(file).empty();  // else edges and the layer load, too
  const Eigen::VectorXd load = alone ? problem.load : load_vector(space, file.scene.body().load);
  const Points& at = space.dof_coordinates();
  Eigen::VectorXd integrals(1 + at.cols());
  integrals(0) = load.sum();
  for (Eigen::Index k = 0; k < at.cols(); ++k) integrals(1 + k) = load.dot(at.col(k));
  return integrals;
}

/// Whether the body beside an edge of its boundary lies above the line of this edge.
bool is_below_its_body(const TriangleMesh& mesh, int e) {
  const int t = mesh.edge_triangles(e, 0);
  Eigen::Vector2d from = mesh.vertices.row(mesh.edges(e, 0));
  Eigen::Vector2d to = mesh.vertices.row(mesh.edges(e, 1));
  if (from(0) > to(0)) std::swap(from, to);
  const Eigen::Vector2d inside = mesh.vertices.row(mesh.triangles(t, local_edge(mesh, t, e)));
  const Eigen::Vector2d along = to - from, across = inside - from;
  return along(0) * across(1) - along(1) * across(0) > 0;
}

/// An edge of a facet, in the plane the facet itself.
struct FacetEdge {
  int facet, from, to;
};

/// The edges of the facets at which a displacement is prescribed.
std::vector<FacetEdge> dirichlet_edges(const Mesh& mesh) {
  std::vector<FacetEdge> edges;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!is_dirichlet(mesh.edge_tag[e])) continue;
    edges.push_back({e, mesh.edges(e, 0), mesh.edges(e, 1)});
    if (mesh.dimension() == 2) continue;
    edges.push_back({e, mesh.edges(e, 1), mesh.edges(e, 2)});
    edges.push_back({e, mesh.edges(e, 2), mesh.edges(e, 0)});
  }
  return edges;
}

/// The ends of the edges with a tag at which a displacement is prescribed.
std::set<int> prescribed_ends(const TriangleMesh& mesh, EdgeTag tag,
                              const Eigen::VectorXd& values) {
  std::set<int> ends;
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e))
      if (mesh.edge_tag[e] == tag && !std::isnan(values(v))) ends.insert(v);
  return ends;
}

/// The gap of two bodies along the slave side. Where displacements are prescribed at one place of
/// both sides, it must hold there: else no function of finite energy satisfies it.
void check_gap_between_bodies(const SceneFile& file, const TwoBodyContact& between,
                              const TriangleMesh& mesh) {
  bool is_slave_above = true;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != between.slave) continue;
    is_slave_above = is_below_its_body(mesh, e);
    const Eigen::Vector2d from = mesh.vertices.row(mesh.edges(e, 0));
    const Eigen::Vector2d to = mesh.vertices.row(mesh.edges(e, 1));
    for (int i = 0; i <= 32; ++i) {
      const Eigen::Vector2d x = from + (to - from) * i / 32;
      between.gap(x(0), x(1));  // throws where it is not finite
    }
  }
  const Eigen::VectorXd values = prescribed(file, mesh);
  const double slack = 1e-6 * body_size(mesh);  // as form/mortar.cpp takes two places for one
  for (const int a : prescribed_ends(mesh, between.slave, values))
    for (const int b : prescribed_ends(mesh, between.master, values)) {
      if ((mesh.vertices.row(a) - mesh.vertices.row(b)).norm() > slack) continue;
      const double x = mesh.vertices(a, 0);
      const double gap = between.gap(x, mesh.vertices(a, 1));
      const double jump = is_slave_above ? values(a) - values(b) : values(b) - values(a);
      const double scale = std::max({std::abs(gap), std::abs(values(a)), std::abs(values(b))});
      if (jump + gap < -1e-6 * scale)  // the two places may differ by as much
        throw InputError(fmt::format(
            "{}: contact.gap: gap({:.6g}) = {:.6g}, but u above - u below = {:.6g} is prescribed "
            "there; accepted: gap >= -(u above - u below) where both bodies have a given u",
            file.name, x, gap, jump));
    }
}

/// Points of a facet, the corners of its parts where each of its edges is cut into `parts`.
std::vector<Position> facet_lattice(const Mesh& mesh, int e, int parts) {
  const auto corner = [&](int k) -> Position { return mesh.vertices.row(mesh.edges(e, k)); };
  const Position from = corner(0), along = corner(1) - from;
  std::vector<Position> points;
  if (mesh.dimension() == 2) {
    for (int i = 0; i <= parts; ++i) points.emplace_back(from + along * i / parts);
    return points;
  }
  const Position across = corner(2) - from;
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; i + j <= parts; ++j)
      points.emplace_back(from + along * i / parts + across * j / parts);
  return points;
}

/// "x", or "x, y": the place along Gamma_C.
std::string place_on_contact(const Position& x) {
  return fmt::format("{:.6g}", fmt::join(x.data(), x.data() + x.size() - 1, ", "));
}

/// The edges of a mesh in space at which a face of Gamma_C meets a face with a given u, with the
/// number of the latter.
std::vector<FacetEdge> held_edges_of_contact(const Mesh& mesh) {
  std::set<std::pair<int, int>> of_contact;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    for (int i = 0; i < 3; ++i)
      of_contact.insert(std::minmax({mesh.edges(e, i), mesh.edges(e, (i + 1) % 3)}));
  }
  std::vector<FacetEdge> edges = dirichlet_edges(mesh);
  std::erase_if(edges, [&](const FacetEdge& edge) {
    return of_contact.count(std::minmax({edge.from, edge.to})) == 0;
  });
  return edges;
}

/// The gap and the ceiling along Gamma_C are finite, and leave room for u, also where u is given.
/// In space u is given along edges of Gamma_C, and not at their ends alone: a function of finite
/// energy has no jump along a part of an edge.
void check_contact_on_mesh(const SceneFile& file, const Mesh& mesh) {
  const UnilateralContact& contact = *file.scene.contact();
  // no structured binding: before version 16 clang captures none in a lambda
  const Profile &gap = contact.gap, &upper_obstacle = contact.upper_obstacle;
  const bool in_space = mesh.dimension() == 3;
  const int parts = in_space ? 8 : 32;
  const Eigen::VectorXd values = prescribed(file, mesh);
  double largest = 0;  // |gap|: u may be in a unit in which 1e-12 is much
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    for (const Position& x : facet_lattice(mesh, e, parts)) {
      largest = std::max(largest, std::abs(profile_value(gap, x)));
      try {
        check_upper_obstacle_at(contact, x(0), x(1), mesh.dimension());
      } catch (const ObstacleError& error) {
        throw InputError(file.name + ": contact.ceiling: " + error.what());
      }
    }
  }
  const auto require_room = [&](const Position& x, double u, const Position& middle) {
    const double scale = std::max(largest, std::abs(u));
    const double round_off =
        std::min(1e-12 * std::max(1.0, std::abs(profile_value(gap, middle))), 1e-6 * scale);
    for (const auto& [name, bound, sign] :
         {std::tuple("gap", &gap, -1), {"ceiling", &upper_obstacle, 1}})
      if (*bound && sign * u > profile_value(*bound, x) + round_off)
        throw InputError(fmt::format(
            "{0}: contact.{1}: {1}({2}) = {3:.6g}, but u = {4:.6g} is prescribed there; "
            "accepted: {1} >= {5}u where Gamma_C meets {6} with a given u",
            file.name, name, place_on_contact(x), profile_value(*bound, x), u, sign < 0 ? "-" : "",
            in_space ? "a face" : "an edge"));
  };
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const Position middle = mesh.vertices(mesh.edges.row(e), Eigen::indexing::all).colwise().mean();
    for (const int v : mesh.edges.row(e)) require_room(mesh.vertices.row(v), values(v), middle);
  }
  if (!in_space) return;
  for (const auto& [facet, from, to] : held_edges_of_contact(mesh)) {
    const Position start = mesh.vertices.row(from), along = mesh.vertices.row(to) - start;
    for (int i = 1; i < parts; ++i) {
      const Position x = start + along * i / parts;
      require_room(x, prescribed_on(file.scene, mesh, facet, x), start + along / 2);
    }
  }
}

/// The point of Gamma_C at which u violates a bound by most.
class DeepestPoint {
 public:
  /// `size` is the largest |u|.
  DeepestPoint(const UnilateralContact& contact, double size)
      : contact_(contact), size_(size), largest_(size) {}

  void visit(const Position& x, double u) {
    for (const auto& [name, bound, sign] :
         {std::tuple("gap", &contact_.gap, -1), {"ceiling", &contact_.upper_obstacle, 1}})
      if (*bound) {
        const double at = profile_value(*bound, x);
        const double depth = sign * u - at;
        largest_ = std::max(largest_, std::abs(at));
        if (depth > deepest_) std::tie(deepest_, where_, missed_) = std::tuple(depth, x, name);
      }
  }

  std::string warning() const {
    if (deepest_ <= significance * size_ || deepest_ < 1e-12 * largest_) return "";
    return fmt::format(
        "contact.{}: between its contact unknowns the mesh misses the obstacle: u sinks {:.3g} "
        "deep into it at {} = {} (max |u| is {:.3g}): a finer mesh is needed there",
        missed_, deepest_, where_.size() == 3 ? "x, y" : "x", place_on_contact(where_), size_);
  }

 private:
  const UnilateralContact& contact_;
  double size_;
  double largest_;  ///< of u and its bounds
  double deepest_ = 0;
  Position where_;
  const char* missed_ = "";
};

/// A warning compares u with its bounds at about this number of points of Gamma_C.
constexpr int contact_places = 100'000;

/// Visits points between the contact unknowns and the held ends of Gamma_C, where u is linear.
/// `held` are the values that are prescribed at vertices.
void visit_line(const Space& space, const Eigen::VectorXd& u, const Eigen::VectorXd& held,
                DeepestPoint& deepest) {
  const Mesh& mesh = space.mesh();
  std::vector<std::pair<double, double>> line;  // x and u
  for (const int i : space.contact_dofs()) line.emplace_back(space.dof_coordinates()(i, 0), u(i));
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e))
      if (mesh.edge_tag[e] == EdgeTag::contact && !std::isnan(held(v)))
        line.emplace_back(mesh.vertices(v, 0), held(v));
  std::sort(line.begin(), line.end());
  const auto edges =
      static_cast<int>(std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::contact));
  const int places = std::max(32, contact_places / std::max(edges, 1));
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const double a = mesh.vertices(mesh.edges(e, 0), 0), b = mesh.vertices(mesh.edges(e, 1), 0);
    for (int i = 0; i < places; ++i) {
      const double x = a + (b - a) * (i + 0.5) / places;
      const auto right = std::upper_bound(line.begin(), line.end(), std::pair(x, 0.0));
      if (right == line.begin() || right == line.end()) continue;
      const auto [x0, u0] = *(right - 1);
      const auto [x1, u1] = *right;
      deepest.visit(Eigen::RowVector2d(x, 0), x1 > x0 ? u0 + (u1 - u0) * (x - x0) / (x1 - x0) : u0);
    }
  }
}

/// A face of Gamma_C: its tetrahedron and the number of the face there.
struct ContactFace {
  int cell, local;
};

std::vector<ContactFace> contact_faces(const Mesh& mesh) {
  std::vector<ContactFace> faces;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::contact)
      faces.push_back({mesh.edge_triangles(e, 0), local_edge(mesh, mesh.edge_triangles(e, 0), e)});
  return faces;
}

/// The affine function that fits values around a point best, by the normal equations.
class AffineFit {
 public:
  /// Adds a value at an offset from the point. The unit of lengths is the first offset.
  void add(const Eigen::Vector2d& offset, double value) {
    if (unit_ == 0) unit_ = offset.norm();
    const Eigen::Vector3d row(1, offset(0) / unit_, offset(1) / unit_);
    matrix_ += row * row.transpose();
    right_ += value * row;
  }
  /// Returns its value at the point itself; not a number where fewer than three values, or values
  /// on one line, leave it open.
  double value() const {
    const Eigen::FullPivLU<Eigen::Matrix3d> factor(matrix_);
    return factor.isInvertible() ? factor.solve(right_)(0) : NAN;
  }

 private:
  double unit_ = 0;
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
};

/// V values on Gamma_C: the prescribed one, or that of u_h. Crouzeix-Raviart's u_h has many values
/// there, and only those at centroids of faces are bounded. So the affine function that fits these
/// best around the vertex gives the value, or NaN.
Eigen::VectorXd vertex_values(const Space& space, const Eigen::VectorXd& u,
                              const Eigen::VectorXd& held) {
  const Mesh& mesh = space.mesh();
  Eigen::VectorXd values = held;
  std::map<int, AffineFit> fits;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const Eigen::RowVector2d centre =
        mesh.vertices(mesh.edges.row(e), Eigen::indexing::all).colwise().mean().head<2>();
    for (const int v : mesh.edges.row(e)) {
      if (!std::isnan(held(v))) continue;
      if (space.element().dofs_per_vertex() > 0) {
        values(v) = u(v);  // the first unknowns are those of vertices
        continue;
      }
      const Eigen::RowVector2d offset = centre - mesh.vertices.row(v).head<2>();
      fits[v].add(offset.transpose(), u(e));  // the unknowns are those of faces
    }
  }
  for (const auto& [v, fit] : fits) values(v) = fit.value();
  return values;
}

/// Visits points of the faces of Gamma_C. There u is the function that has the value of u_h at the
/// centroid of each face, the vertex_values, and is affine on the three triangles between them. For
/// P1 it is u_h.
void visit_faces(const Space& space, const Eigen::VectorXd& u, const Eigen::VectorXd& held,
                 DeepestPoint& deepest) {
  const Mesh& mesh = space.mesh();
  const std::vector<ContactFace> faces = contact_faces(mesh);
  const Eigen::VectorXd at_vertex = vertex_values(space, u, held);
  // each of the three triangles of a face has parts (parts + 1) / 2 points
  const double per_triangle = contact_places / (3.0 * std::max<std::size_t>(faces.size(), 1));
  const int parts = std::clamp(static_cast<int>(std::sqrt(2 * per_triangle)), 4, 64);
  for (const auto& [t, i] : faces) {
    const ReferencePoint middle = on_facet(mesh.kind, i, Eigen::Vector3d::Constant(1.0 / 3));
    const Position centre = position(mesh, t, middle).transpose();
    const double at_centre = space.element().basis(middle).dot(u(space.cell_dofs().row(t)));
    const std::array<int, 3>& corners = mesh.reference().facet[i];
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles(t, corners[k]), w = mesh.triangles(t, corners[(k + 1) % 3]);
      if (std::isnan(at_vertex(v)) || std::isnan(at_vertex(w))) continue;
      for (int a = 0; a < parts; ++a)
        for (int b = 0; a + b < parts; ++b) {
          const double to_v = (a + 1.0 / 3) / parts, to_w = (b + 1.0 / 3) / parts;
          const double to_centre = 1 - to_v - to_w;
          deepest.visit(
              to_centre * centre + to_v * mesh.vertices.row(v) + to_w * mesh.vertices.row(w),
              to_centre * at_centre + to_v * at_vertex(v) + to_w * at_vertex(w));
        }
    }
  }
}

}  // namespace

void check_on_mesh(const SceneFile& file, const Mesh& mesh) {
  const Field& f = file.scene.body().load;
  const auto body = [&](int t) { return t >= 0 && mesh.region[t] == Region::body; };
  // the reader of scenes has asked the load of a mesh that is made here
  for (int e = 0; file.mesh.from_file() && e < mesh.edge_count(); ++e) {
    if (!body(mesh.edge_triangles(e, 0)) && !body(mesh.edge_triangles(e, 1))) continue;
    for (const Position& x : facet_lattice(mesh, e, 2)) field_value(f, x);
  }
  if (const auto* bodies = std::get_if<TwoBodyModel>(&file.model))
    check_gap_between_bodies(file, bodies->between, mesh);
  if (file.scene.contact()) check_contact_on_mesh(file, mesh);
}

std::string load_warning(const SceneFile& file, const Space& space,
                         const VariationalInequality& problem) {
  const LoadSamples samples(space, file.scene.body().load);
  const Eigen::VectorXd seen = integrals_by_quadrature(file, space, problem);
  const Eigen::VectorXd& sampled = samples.integrals();
  const Eigen::VectorXd& size = samples.sizes();
  for (Eigen::Index i = 0; i < seen.size(); ++i)
    if (std::abs(seen(i) - sampled(i)) > significance * std::max(size(i), std::abs(seen(i))))
      return fmt::format(
          "load.f: the quadrature of this mesh misses the load: the integral of {} is {:.3g} by "
          "the quadrature, {:.3g} "
          "by {:.0f} points (that of its absolute value {:.3g}): a finer mesh is needed where the "
          "load lives",
          std::array{"f", "x f", "y f", "z f"}[static_cast<std::size_t>(i)], seen(i), sampled(i),
          samples.count(), size(i));
  // integrals may agree by chance: what lives between the points of the rule, triangle by triangle,
  // is seen by none
  if (samples.is_unseen())
    return fmt::format(
        "load.f: the quadrature of this mesh misses the load: {:.0f} % of the integral of |f| lie "
        "between its points, "
        "by {:.0f} samples: a finer mesh is needed where the load lives",
        samples.unseen_percent(), samples.count());
  return "";
}

std::string displacement_warning(const SceneFile& file, const TriangleMesh& mesh) {
  if (file.scene.edges().empty()) return "";
  constexpr int parts =
      8;  // of an edge: a formula that jumps twice on one of them is a matter of the mesh
  constexpr double telling_jump = 1e-6;  // of the largest value: below, the formula's own rounding
  const auto at = [&](const FacetEdge& e, double s) {
    return Position((1 - s) * mesh.vertices.row(e.from) + s * mesh.vertices.row(e.to));
  };
  const auto value = [&](const FacetEdge& e, double s) {
    return prescribed_on(file.scene, mesh, e.facet, at(e, s));
  };
  const auto name = [&](const FacetEdge& e) {
    const int k = mesh.edge_tag[e.facet].group;
    return k < 0 ? std::string("clamped") : file.scene.edges()[k].group;
  };
  const auto line = [](const std::string& what, const Position& x, const std::string& more) {
    return fmt::format(
        "edge: {} at ({:.6g}){}: no function of finite energy has such values, and the energy "
        "grows with every refinement",
        what, fmt::join(x.data(), x.data() + x.size(), ", "), more);
  };
  const std::vector<FacetEdge> held = dirichlet_edges(mesh);
  double largest = 0;
  for (const FacetEdge& e : held)
    for (int i = 0; i <= parts; ++i)
      largest = std::max(largest, std::abs(value(e, static_cast<double>(i) / parts)));
  const auto apart = [&](double a, double b) { return std::abs(a - b) > telling_jump * largest; };

  std::map<int, std::pair<FacetEdge, double>> first;  // vertex -> an edge there, and its value
  for (const FacetEdge& e : held)
    for (const int end : {0, 1}) {
      const double here = value(e, end);
      const auto [other, alone] = first.try_emplace(end == 0 ? e.from : e.to, e, here);
      const auto& [other_edge, there] = other->second;
      if (!alone && apart(here, there))
        return line(fmt::format("the group {} gives u = {:.6g}, the group {} gives u = {:.6g}",
                                printable(name(other_edge)), there, printable(name(e)), here),
                    at(e, end), ", where they meet");
    }
  for (const FacetEdge& e : held)
    for (int i = 0; i < parts; ++i) {
      double low = static_cast<double>(i) / parts, high = static_cast<double>(i + 1) / parts;
      double from = value(e, low), to = value(e, high);
      while (apart(
          from,
          to)) {  // towards a jump, if there is one: the half that holds more of the difference
        const double middle = (low + high) / 2, between = value(e, middle);
        if (!(low < middle && middle < high)) {
          return line(fmt::format("the displacement of the group {} jumps from {:.6g} to {:.6g}",
                                  printable(name(e)), from, to),
                      at(e, low), "");
        }
        const bool upper = std::abs(to - between) > std::abs(between - from);
        (upper ? low : high) = middle;
        (upper ? from : to) = between;
      }
    }
  return "";
}

std::string polygon_warning(const SceneFile& file, const TriangleMesh& mesh) {
  if (!file.mesh.from_file() || !mesh.geometry.empty()) return "";
  constexpr double corner = 0.7071;  // the cosine of 45 degrees, what a regular octagon turns by
  std::vector<Eigen::RowVector2d> turn(mesh.vertex_count(), Eigen::RowVector2d::Zero());
  std::vector<double> cosine(mesh.vertex_count(), 1);  // of the turn at a vertex of the boundary
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_triangles(e, 1) >= 0) continue;
    const int a = mesh.edges(e, 0), b = mesh.edges(e, 1);
    const Eigen::RowVector2d along = (mesh.vertices.row(b) - mesh.vertices.row(a)).normalized();
    for (const auto& [vertex, away] :
         {std::pair(a, along), std::pair<int, Eigen::RowVector2d>(b, -along)}) {
      if (turn[vertex] == Eigen::RowVector2d::Zero())
        turn[vertex] = away;
      else
        cosine[vertex] = -turn[vertex].dot(away);
    }
  }
  const auto curved = std::count_if(cosine.begin(), cosine.end(),
                                    [&](double c) { return c > corner - 1e-4 && c < 1 - 1e-6; });
  if (curved < 6) return "";
  return fmt::format(
      "mesh.file: the boundary turns a little at {} vertices, as the mesh of a curve does; what is "
      "proved is proved of "
      "this polygon; with geometry = \"my.geo\" in [mesh] refinement returns to the curves of that "
      "file",
      curved);
}

std::string geometry_warning(const SceneFile& file) {
  const std::filesystem::path& path = file.mesh.file;
  const bool refined = file.mesh.refinements > 0 || file.method.accuracy;
  if (!file.mesh.from_file() || !file.mesh.geometry.empty() || !refined ||
      file.method.solver == "petsc")
    return "";
  for (const char* extension : {".geo", ".brep"}) {
    const std::filesystem::path beside = path.parent_path() / (path.stem().string() + extension);
    if (std::error_code ignored; !std::filesystem::exists(beside, ignored)) continue;
    // as the scene would name it; lexically_relative is not in the library of the page
    const std::string folder = std::filesystem::path(file.name).parent_path().string() + "/";
    const std::string whole = beside.string();
    const std::string named =
        folder != "/" && whole.rfind(folder, 0) == 0 ? whole.substr(folder.size()) : whole;
    return fmt::format(
        "mesh.geometry: {} lies beside the mesh file and was not read, since the scene does not "
        "name it; with geometry "
        "= \"{}\" in [mesh] refinement returns to its curves",
        printable(beside.filename().string(), 200), printable(named, 1000));
  }
  return "";
}

std::string gap_warning(const SceneFile& file, const Space& space, const Solution& solution) {
  if (!file.scene.contact() || traits_of(file.model).components > 1) return "";
  const Eigen::VectorXd values = prescribed(file, space.mesh());
  DeepestPoint deepest(*file.scene.contact(), solution.u.lpNorm<Eigen::Infinity>());
  if (space.mesh().dimension() == 3)
    visit_faces(space, solution.u, values, deepest);
  else
    visit_line(space, solution.u, values, deepest);
  return deepest.warning();
}

std::string range_warning(const SceneFile& file, const Space& space, const Solution& solution) {
  const auto* stiff = std::get_if<StiffLayer>(&file.scene.layer());
  if (stiff == nullptr || traits_of(file.model).components > 1 || space.element().conforming())
    return "";
  const auto pull = [&](const Field& f, Region region) {
    return load_vector(space, f, region).lpNorm<1>();
  };
  if (stiff->load &&
      pull(stiff->load, Region::layer) > 1e-3 * pull(file.scene.body().load, Region::body))
    return "";
  const TriangleMesh& mesh = space.mesh();
  const int per_edge =
      space.element().dofs_per_facet();  // the first unknowns, as none are at vertices
  Eigen::AlignedBox1d around, inside;    // u_h at the edges around the layer, and within it
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (const int t = mesh.edge_triangles(e, 0);
        mesh.region[t] == Region::layer || mesh.edge_tag[e] == EdgeTag::sigma)
      for (int k = 0; k < per_edge; ++k)
        (mesh.edge_tag[e] == EdgeTag::interior ? inside : around)
            .extend(Eigen::Matrix<double, 1, 1>(solution.u(per_edge * e + k)));
  const double size =
      solution.u.lpNorm<Eigen::Infinity>();  // an empty box is infinitely far from everything
  const double off = std::max(around.min()(0) - inside.min()(0), inside.max()(0) - around.max()(0));
  if (off <= significance * size) return "";
  return fmt::format(
      "layer: within it u is {:.0f} % of max |u| beyond the values around it, where no exact "
      "solution is: the layer is "
      "too soft along x for this element, or the mesh too coarse; remedy: a layer in columns (kind "
      "= \"layered\"), a "
      "finer mesh",
      100 * off / size);
}

}  // namespace antilock
