#include "antilock/runner/scene_checks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
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
#include "antilock/models/anti_plane.hpp"

namespace antilock {
namespace {

/// The place of point k in a triangle: a sequence of low discrepancy in the unit square (Roberts
/// 2018, the plastic number), folded to the triangle. No two points of a run have the same x or the
/// same y, so that strips are found as well as spots.
Eigen::Vector3d spread_point(double k) {
  constexpr double plastic = 1.32471795724474602596;
  double a = std::fmod(0.5 + k * (1 / plastic), 1);
  double b = std::fmod(0.5 + k * (1 / (plastic * plastic)), 1);
  if (a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  return {1 - a - b, a, b};
}

/// 1, a, b, a a, a b, b b at a point of a triangle with the barycentric coordinates (1 - a - b, a,
/// b).
Eigen::Matrix<double, 6, 1> quadratics(const Eigen::Vector3d& lambda) {
  const double a = lambda(1), b = lambda(2);
  return Eigen::Matrix<double, 6, 1>(1, a, b, a * a, a * b, b * b);
}

/// From the values at the points of a rule to the quadratic that fits them best.
Eigen::MatrixXd quadratic_fit(const Quadrature& rule) {
  Eigen::MatrixXd at_points(rule.weights.size(), 6);
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

double body_area(const TriangleMesh& mesh) {
  double area = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::body) area += mesh.area(t);
  return area;
}

/// The load f on the body by samples, which stand for the same area each: a triangle may have many,
/// or none.
class LoadSamples {
 public:
  LoadSamples(const Space& space, const Field& f)
      : space_(space), f_(f), area_(body_area(space.mesh())) {
    const Quadrature& rule = load_rule(space.element());
    const Eigen::MatrixXd fit = quadratic_fit(rule);
    const TriangleMesh& mesh = space.mesh();
    double due = 0;  // samples, of the triangles so far, that have not been taken
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.region[t] != Region::body) continue;
      due += points * mesh.area(t) / area_;
      const int here = static_cast<int>(due);
      due -= here;
      if (here == 0) continue;
      // f is fitted on as many triangles as leave its values at the points of the rule no more than
      // the samples
      const bool fits = at_points_ <= count_;
      Eigen::VectorXd quadratic;
      if (fits) quadratic = fit * values_at(rule, t);
      for (int i = 0; i < here; ++i) add_sample(t, fits, quadratic);
    }
  }

  double count() const { return count_; }
  const Eigen::Vector3d& integrals() const { return sampled_; }  ///< of f (1, x, y)
  const Eigen::Vector3d& sizes() const { return size_; }         ///< of |f| (1, |x|, |y|)
  /// Whether the integral of |f - q| is above a quarter of that of |f|, on the triangles that are
  /// fitted. q is the quadratic that fits f best at the points of the rule.
  bool is_unseen() const { return unseen_ > 0.25 * fitted_; }
  double unseen_percent() const { return 100 * unseen_ / fitted_; }

 private:
  static constexpr int points = 1 << 18;

  Eigen::VectorXd values_at(const Quadrature& rule, int t) {
    Eigen::VectorXd values(rule.weights.size());
    for (Eigen::Index q = 0; q < values.size(); ++q) {
      const Eigen::Vector2d x = point_in(space_.mesh(), t, rule.points.row(q));
      values(q) = f_(x(0), x(1));
    }
    at_points_ += values.size();
    return values;
  }

  void add_sample(int t, bool fits, const Eigen::VectorXd& quadratic) {
    ++count_;
    const Eigen::Vector3d lambda = spread_point(count_);
    const Eigen::Vector2d x = point_in(space_.mesh(), t, lambda);
    const double part = f_(x(0), x(1)) * area_ / points;
    if (fits) {
      unseen_ += std::abs(part - quadratics(lambda).dot(quadratic) * area_ / points);
      fitted_ += std::abs(part);
    }
    sampled_ += part * Eigen::Vector3d(1, x(0), x(1));
    size_ += std::abs(part) * Eigen::Vector3d(1, std::abs(x(0)), std::abs(x(1)));
  }

  const Space& space_;
  const Field& f_;
  double area_;
  double count_ = 0;
  double at_points_ = 0;  ///< values of f at points of the rule
  Eigen::Vector3d sampled_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_ = Eigen::Vector3d::Zero();
  double unseen_ = 0;  ///< the integral of |f - q|
  double fitted_ = 0;  ///< the integral of |f| on the same triangles
};

/// The integrals of f (1, x, y) by the quadrature: the basis sums to 1, and with the places of the
/// unknowns as weights to x and to y.
Eigen::Vector3d integrals_by_quadrature(const SceneFile& file, const Space& space,
                                        const VariationalInequality& problem) {
  const bool alone = beyond_the_paper(file).empty();  // else edges and the layer load, too
  const Eigen::VectorXd load = alone ? problem.load : load_vector(space, file.scene.body().load);
  const Points& at = space.dof_coordinates();
  return {load.sum(), load.dot(at.col(0)), load.dot(at.col(1))};
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

}  // namespace

void check_on_mesh(const SceneFile& file, const TriangleMesh& mesh) {
  const Field& f = file.scene.body().load;
  const auto body = [&](int t) { return t >= 0 && mesh.region[t] == Region::body; };
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!body(mesh.edge_triangles(e, 0)) && !body(mesh.edge_triangles(e, 1))) continue;
    const Eigen::RowVector2d from = mesh.vertices.row(mesh.edges(e, 0)),
                             to = mesh.vertices.row(mesh.edges(e, 1));
    for (const double s : {0.0, 0.5, 1.0})
      f((1 - s) * from(0) + s * to(0), (1 - s) * from(1) + s * to(1));
  }
  if (const auto* bodies = std::get_if<TwoBodyModel>(&file.model))
    check_gap_between_bodies(file, bodies->between, mesh);
  if (!file.scene.contact()) return;
  const auto& [gap, zero_at, upper_obstacle] = *file.scene.contact();
  const Eigen::VectorXd values = prescribed(file, mesh);
  double largest = 0;  // |gap|: u may be in a unit in which 1e-12 is much
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const double a = mesh.vertices(mesh.edges(e, 0), 0), b = mesh.vertices(mesh.edges(e, 1), 0);
    for (int i = 0; i <= 32; ++i) {
      const double x = a + (b - a) * i / 32;
      largest = std::max(largest, std::abs(gap(x)));
      try {
        check_upper_obstacle(*file.scene.contact(), x);
      } catch (const ObstacleError& error) {
        throw InputError(file.name + ": contact.ceiling: " + error.what());
      }
    }
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const double a = mesh.vertices(mesh.edges(e, 0), 0), b = mesh.vertices(mesh.edges(e, 1), 0);
    for (const int v : mesh.edges.row(e)) {
      const double x = mesh.vertices(v, 0);
      const double scale = std::max(largest, std::abs(values(v)));
      const double round_off =
          std::min(1e-12 * std::max(1.0, std::abs(gap((a + b) / 2))), 1e-6 * scale);
      for (const auto& [name, bound, sign] :
           {std::tuple("gap", &gap, -1), {"ceiling", &upper_obstacle, 1}})
        if (*bound && sign * values(v) > (*bound)(x) + round_off)
          throw InputError(
              fmt::format("{0}: contact.{1}: {1}({2:.6g}) = {3:.6g}, but u = {4:.6g} is prescribed "
                          "there; accepted: "
                          "{1} >= {5}u where Gamma_C meets an edge with a given u",
                          file.name, name, x, (*bound)(x), values(v), sign < 0 ? "-" : ""));
    }
  }
}

std::string load_warning(const SceneFile& file, const Space& space,
                         const VariationalInequality& problem) {
  const LoadSamples samples(space, file.scene.body().load);
  const Eigen::Vector3d seen = integrals_by_quadrature(file, space, problem);
  const Eigen::Vector3d& sampled = samples.integrals();
  const Eigen::Vector3d& size = samples.sizes();
  for (int i = 0; i < 3; ++i)
    if (std::abs(seen(i) - sampled(i)) > significance * std::max(size(i), std::abs(seen(i))))
      return fmt::format(
          "load.f: the quadrature of this mesh misses the load: the integral of {} is {:.3g} by "
          "the quadrature, {:.3g} "
          "by {:.0f} points (that of its absolute value {:.3g}): a finer mesh is needed where the "
          "load lives",
          std::array{"f", "x f", "y f"}[i], seen(i), sampled(i), samples.count(), size(i));
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
  const auto at = [&](int e, double s) {
    return Eigen::RowVector2d((1 - s) * mesh.vertices.row(mesh.edges(e, 0)) +
                              s * mesh.vertices.row(mesh.edges(e, 1)));
  };
  const auto value = [&](int e, double s) { return prescribed_on(file.scene, mesh, e, at(e, s)); };
  const auto name = [&](int e) {
    const int k = mesh.edge_tag[e].group;
    return k < 0 ? std::string("clamped") : file.scene.edges()[k].group;
  };
  const auto line = [](const std::string& what, const Eigen::RowVector2d& x,
                       const std::string& more) {
    return fmt::format(
        "edge: {} at ({:.6g}, {:.6g}){}: no function of finite energy has such values, and the "
        "energy grows with every "
        "refinement",
        what, x(0), x(1), more);
  };
  std::vector<int> held;
  double largest = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!is_dirichlet(mesh.edge_tag[e])) continue;
    held.push_back(e);
    for (int i = 0; i <= parts; ++i)
      largest = std::max(largest, std::abs(value(e, static_cast<double>(i) / parts)));
  }
  const auto apart = [&](double a, double b) { return std::abs(a - b) > telling_jump * largest; };

  std::map<int, std::pair<int, double>> first;  // vertex -> an edge there, and its value
  for (const int e : held)
    for (const int end : {0, 1}) {
      const double here = value(e, end);
      const auto [other, alone] = first.try_emplace(mesh.edges(e, end), e, here);
      const auto& [other_edge, there] = other->second;
      if (!alone && apart(here, there))
        return line(fmt::format("the group {} gives u = {:.6g}, the group {} gives u = {:.6g}",
                                printable(name(other_edge)), there, printable(name(e)), here),
                    at(e, end), ", where they meet");
    }
  for (const int e : held)
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
  const auto& [kind, cells, path, refinements, geometry] = file.mesh;
  const bool refined = refinements > 0 || file.method.accuracy;
  if (!file.mesh.from_file() || !geometry.empty() || !refined || file.method.solver == "petsc")
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
  const auto& [gap, zero_at, upper_obstacle] = *file.scene.contact();
  const TriangleMesh& mesh = space.mesh();
  const Eigen::VectorXd values = prescribed(file, mesh);
  std::vector<std::pair<double, double>>
      line;  // x and u_h at the contact unknowns and at the held ends of Gamma_C
  for (const int i : space.contact_dofs())
    line.emplace_back(space.dof_coordinates()(i, 0), solution.u(i));
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e))
      if (mesh.edge_tag[e] == EdgeTag::contact && !std::isnan(values(v)))
        line.emplace_back(mesh.vertices(v, 0), values(v));
  std::sort(line.begin(), line.end());

  const double size = solution.u.lpNorm<Eigen::Infinity>();
  const auto edges =
      static_cast<int>(std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::contact));
  const int places = std::max(32, 100'000 / std::max(edges, 1));
  double deepest = 0, where = 0, largest = size;  // of u and its bounds
  const char* missed = "";
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const double a = mesh.vertices(mesh.edges(e, 0), 0), b = mesh.vertices(mesh.edges(e, 1), 0);
    for (int i = 0; i < places; ++i) {
      const double x = a + (b - a) * (i + 0.5) / places;
      const auto right = std::upper_bound(line.begin(), line.end(), std::pair(x, 0.0));
      if (right == line.begin() || right == line.end()) continue;
      const auto [x0, u0] = *(right - 1);
      const auto [x1, u1] = *right;
      const double u = x1 > x0 ? u0 + (u1 - u0) * (x - x0) / (x1 - x0) : u0;
      for (const auto& [name, bound, sign] :
           {std::tuple("gap", &gap, -1), {"ceiling", &upper_obstacle, 1}})
        if (*bound) {
          const double at = (*bound)(x);
          const double depth = sign * u - at;
          largest = std::max(largest, std::abs(at));
          if (depth > deepest) std::tie(deepest, where, missed) = std::tuple(depth, x, name);
        }
    }
  }
  if (deepest <= significance * size || deepest < 1e-12 * largest) return "";
  return fmt::format(
      "contact.{}: between its contact unknowns the mesh misses the obstacle: u sinks {:.3g} deep "
      "into it at x = "
      "{:.6g} (max |u| is {:.3g}): a finer mesh is needed there",
      missed, deepest, where, size);
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
      space.element().dofs_per_edge();  // the first unknowns, as none are at vertices
  Eigen::AlignedBox1d around, inside;   // u_h at the edges around the layer, and within it
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
