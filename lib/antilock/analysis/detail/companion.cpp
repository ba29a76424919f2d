#include "antilock/analysis/detail/companion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

/// The vertices whose value is known: ends of fixed and of clamped edges.
std::vector<char> held_vertices(const Space& space, const VariationalInequality& problem) {
  const TriangleMesh& mesh = space.mesh();
  std::vector<char> held(mesh.vertex_count(), 0);
  for (const std::vector<int>* list : {&problem.fixed, &space.clamped()})
    for (const int e : *list) held[mesh.edges(e, 0)] = held[mesh.edges(e, 1)] = 1;
  return held;
}

/// The mean of u_CR over the body's triangles at each vertex; the known values where they are known.
Eigen::VectorXd averages(const Scene& scene, const Space& space, const Solution& solution,
                         const std::vector<char>& held) {
  const TriangleMesh& mesh = space.mesh();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh.vertex_count()), count = sum;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::body) continue;
    const Eigen::Vector3d u = solution.u(space.unknowns().row(t));
    const double stiffness = stiffness_on(scene.body().stiffness, mesh, t);
    for (int i = 0; i < 3; ++i) {
      sum(mesh.triangles(t, i)) += stiffness * (u.sum() - 2 * u(i));  // phi_i = 1 - 2 lambda_i
      count(mesh.triangles(t, i)) += stiffness;
    }
  }
  const Eigen::VectorXd known = prescribed_values(scene, mesh);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (held[v])
      sum(v) = known(v);
    else if (count(v) > 0)
      sum(v) /= count(v);
  }
  return sum;
}

/// The triangles of the mesh that a strip solve needs, as a mesh of their own, with the old numbers of its vertices.
struct CutOut {
  TriangleMesh mesh;
  std::vector<int> old_vertex;
};

/// The body's triangles with a vertex on `line`, and the layer's where it is to be kept.
CutOut cut_out(const TriangleMesh& mesh, const std::vector<char>& line, bool keep_layer) {
  CutOut piece;
  std::vector<int> kept, number(mesh.vertex_count(), -1), owners(mesh.edge_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const auto v = mesh.triangles.row(t);
    if (mesh.region[t] == Region::layer ? !keep_layer : !(line[v(0)] || line[v(1)] || line[v(2)])) continue;
    kept.push_back(t);
    for (int i = 0; i < 3; ++i) ++owners[mesh.triangle_edges(t, i)];
  }
  Triples triangles(static_cast<Eigen::Index>(kept.size()), 3);
  std::vector<Region> region;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    region.push_back(mesh.region[kept[k]]);
    for (int i = 0; i < 3; ++i) {
      const int v = mesh.triangles(kept[k], i);
      if (number[v] < 0) {
        number[v] = static_cast<int>(piece.old_vertex.size());
        piece.old_vertex.push_back(v);
      }
      triangles(static_cast<Eigen::Index>(k), i) = number[v];
    }
  }
  Points points(static_cast<Eigen::Index>(piece.old_vertex.size()), 2);
  for (std::size_t i = 0; i < piece.old_vertex.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = mesh.vertices.row(piece.old_vertex[i]);
  std::vector<TaggedEdge> tagged;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (owners[e] == 0) continue;
    EdgeTag tag = mesh.edge_tag[e];
    if (owners[e] == 1 && tag == EdgeTag::interior) tag = EdgeTag::clamped;  // the cut
    if (owners[e] == 1 && tag == EdgeTag::sigma) tag = EdgeTag::contact;     // the layer is left out
    if (tag != EdgeTag::interior) tagged.push_back({number[mesh.edges(e, 0)], number[mesh.edges(e, 1)], tag});
  }
  piece.mesh = make_triangle_mesh(std::move(points), std::move(triangles), std::move(region), tagged, "certificate");
  return piece;
}

/// Whether the layer of `mesh` has the same triangles as the columns, in the same order.
bool same_layer(const TriangleMesh& mesh, const TriangleMesh& columns) {
  const auto first = [](const TriangleMesh& m) {
    return static_cast<int>(std::find(m.region.begin(), m.region.end(), Region::layer) - m.region.begin());
  };
  const int ours = first(mesh), theirs = first(columns), count = mesh.triangle_count() - ours;
  if (count != columns.triangle_count() - theirs) return false;
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < 3; ++i)
      if (mesh.vertices.row(mesh.triangles(ours + k, i)) != columns.vertices.row(columns.triangles(theirs + k, i)))
        return false;
  return true;
}

}  // namespace

Eigen::VectorXd admissible_bounds(const UnilateralContact& contact, const Space& space, const Field& near) {
  constexpr int samples = 32;
  const TriangleMesh& mesh = space.mesh();
  std::vector<int> bound_of(mesh.vertex_count(), -1);  // -1: v is prescribed there
  for (std::size_t i = 0; i < space.contact().size(); ++i) bound_of[space.contact()[i]] = static_cast<int>(i);
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(space.contact().size()),
                                                    -std::numeric_limits<double>::infinity());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    std::array<double, 2> x, at;  // of its two ends: v there, or a value near it
    std::array<int, 2> place;
    for (int end = 0; end < 2; ++end) {
      const int v = mesh.edges(e, end);
      x[end] = mesh.vertices(v, 0), at[end] = near ? near(x[end], mesh.vertices(v, 1)) : 0, place[end] = bound_of[v];
    }
    std::array<double, samples + 1> obstacle;
    for (int k = 0; k <= samples; ++k) {
      const double s = static_cast<double>(k) / samples, here = (1 - s) * x[0] + s * x[1], gap = contact.gap(here);
      if (!std::isfinite(gap)) throw Error(fmt::format("contact: gap({:.6g}) is not finite", here));
      obstacle[k] = -gap;
    }
    double raise = 0, most = obstacle[0];
    std::array<double, 2> beside{obstacle[0], obstacle[samples]};  // where the other end cannot help
    for (int k = 0; k <= samples; ++k) {
      const double s = static_cast<double>(k) / samples;
      raise = std::max(raise, obstacle[k] - (1 - s) * obstacle[0] - s * obstacle[samples]);
      most = std::max(most, obstacle[k]);
      if (k < samples) beside[0] = std::max(beside[0], (obstacle[k] - s * at[1]) / (1 - s));
      if (k > 0) beside[1] = std::max(beside[1], (obstacle[k] - (1 - s) * at[0]) / s);
    }
    const std::array<double, 2> smooth{obstacle[0] + raise, obstacle[samples] + raise}, level{most, most};
    const auto lifts = [&](const std::array<double, 2>& bound) {  // how far v is lifted, and the bounds themselves
      const double left = std::max(bound[0] - at[0], 0.0), right = std::max(bound[1] - at[1], 0.0);
      return std::pair(left * left + right * right, bound[0] + bound[1]);
    };
    const bool alone = place[0] < 0 || place[1] < 0;
    const std::array<double, 2>& bound = alone ? beside : lifts(level) < lifts(smooth) ? level : smooth;
    for (int end = 0; end < 2; ++end)
      if (double* const here = place[end] < 0 ? nullptr : &lower(place[end]); here != nullptr)
        *here = std::max(*here, bound[end]);
  }
  return lower;
}

Companion strip_companion(const Scene& scene, const Space& space, const VariationalInequality& problem,
                          const Solution& solution, bool on_mesh) {
  const TriangleMesh& mesh = space.mesh();
  const auto* stiff = on_mesh ? nullptr : std::get_if<StiffLayer>(&scene.layer());
  const std::vector<char> held = held_vertices(space, problem);
  Companion companion;
  companion.at_vertices = averages(scene, space, solution, held);

  const EdgeTag line_tag = scene.layer_depth() > 0 ? EdgeTag::sigma : EdgeTag::contact;
  std::vector<char> on_line(mesh.vertex_count(), 0);
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == line_tag) on_line[mesh.edges(e, 0)] = on_line[mesh.edges(e, 1)] = 1;
  CutOut piece = cut_out(mesh, on_line, stiff == nullptr);
  const TriangleMesh& cut = piece.mesh;
  const TriangleMesh columns = stiff != nullptr ? extruded(cut, stiff->epsilon) : cut;

  // the body's vertices off the line and the known values are fixed; the rest is solved for
  const Space p1_space(columns, p1());
  VariationalInequality strip = assemble(scene, p1_space);
  std::vector<char> fixed(columns.vertex_count(), 0);
  Eigen::VectorXd value = prescribed_values(scene, columns);
  for (const int v : p1_space.clamped()) fixed[v] = 1;
  for (int t = 0; t < columns.triangle_count(); ++t) {
    if (columns.region[t] != Region::body) continue;
    for (int i = 0; i < 3; ++i) {
      const int v = columns.triangles(t, i), old = piece.old_vertex[v];
      fixed[v] = !on_line[old] || held[old];
      if (fixed[v]) value(v) = companion.at_vertices(old);
    }
  }
  std::map<double, double> above;  // near v on Gamma_C is u_CR on Sigma, at the same x
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (on_line[v]) above[mesh.vertices(v, 0)] = companion.at_vertices(v);
  const Field near = [&](double x, double) {
    const auto found = above.find(x);
    return found != above.end() ? found->second : 0;
  };
  if (scene.contact()) strip.lower = admissible_bounds(*scene.contact(), p1_space, near);
  strip.fixed.clear();
  for (int v = 0; v < columns.vertex_count(); ++v)
    if (fixed[v]) strip.fixed.push_back(v);
  strip.fixed_values = value(strip.fixed);
  std::vector<int> contact;
  std::vector<double> lower;
  for (std::size_t i = 0; i < strip.contact.size(); ++i)
    if (!fixed[strip.contact[i]]) {
      contact.push_back(strip.contact[i]);
      lower.push_back(strip.lower(static_cast<Eigen::Index>(i)));
    }
  strip.contact = contact;
  strip.lower = Eigen::Map<const Eigen::VectorXd>(lower.data(), static_cast<Eigen::Index>(lower.size()));
  Solution answer;
  if (strip.free_count() > 0) {
    answer = active_set(strip);
  } else {
    answer.u = value;
    answer.p = Eigen::VectorXd::Zero(strip.b.rows());
  }
  companion.unknowns = strip.free_count();

  for (int v = 0; v < cut.vertex_count(); ++v) companion.at_vertices(piece.old_vertex[v]) = answer.u(v);
  if (stiff == nullptr) {
    companion.stress = std::move(answer.p);
    return companion;
  }
  if (same_layer(mesh, columns)) {
    companion.stress = answer.p;
    const int shift = mesh.triangle_count() - columns.triangle_count();
    for (int t = 0; t < columns.triangle_count(); ++t) {
      if (columns.region[t] != Region::layer) continue;
      for (int i = 0; i < 3; ++i)
        companion.at_vertices(mesh.triangles(t + shift, i)) = answer.u(columns.triangles(t, i));
    }
    return companion;
  }
  companion.layer.emplace(columns, std::move(answer.u), std::move(answer.p));
  return companion;
}

Companion p1_companion(const Solution& p1_solution) {
  return {.at_vertices = p1_solution.u, .stress = p1_solution.p, .layer = std::nullopt};
}

}  // namespace antilock
