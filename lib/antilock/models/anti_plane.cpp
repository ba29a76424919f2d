#include "antilock/models/anti_plane.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "antilock/form/edge_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/models/detail/stiffness_range.hpp"

namespace antilock {
namespace {

/// A part of a mesh, as a process of a distributed run has it, ends inside the domain.
bool is_whole(const TriangleMesh& mesh) {
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_triangles(e, 1) < 0 && mesh.edge_tag[e] == EdgeTag::interior) return false;
  return true;
}

void check_fit(const Scene& scene, const TriangleMesh& mesh) {
  using Kind = BoundaryCondition::Kind;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const EdgeTag tag = mesh.edge_tag[e];
    const int k = tag.group;
    if (k >= static_cast<int>(scene.edges().size()))
      throw Error(fmt::format(
          "scene and mesh: the edge at {} is in the group {}, of which the scene says nothing; "
          "accepted: a condition per group",
          mesh.location_text(mesh.edges(e, 0)), k));
    if (k >= 0 && is_dirichlet(tag) != (scene.edges()[k].kind == Kind::displacement))
      throw Error("scene and mesh: the group " + scene.edges()[k].group +
                  " is held in one of the two alone; accepted: dirichlet_group for a displacement, "
                  "natural_group else");
  }
  const int loose = find_floating_component(mesh, [&](int e) {
    const int k = mesh.edge_tag[e].group;
    return is_dirichlet(mesh.edge_tag[e]) || (k >= 0 && scene.edges()[k].kind == Kind::spring);
  });
  if (loose >= 0 && is_whole(mesh))
    throw Error("scene and mesh: nothing holds the component of the mesh at " +
                mesh.location_text(mesh.triangles(loose, 0)) +
                "; accepted: a displacement or a spring on one of its edges");
  const auto& region = mesh.region;
  const bool mesh_has_layer =
      std::find(region.begin(), region.end(), Region::layer) != region.end();
  if (mesh_has_layer != (scene.layer_depth() > 0))
    throw Error("scene and mesh: " +
                std::string(mesh_has_layer
                                ? "the scene has no layer to mesh, the mesh has a group layer"
                                : "the scene has a layer, the mesh has no group layer") +
                "; accepted: both or none");
  if (mesh.curved()) return;
  constexpr double slack =
      1e-6;  // of the sizes of body and layer: formats with few digits place a vertex to 1e-8
  const double size = body_size(mesh);
  for (int e = 0; mesh_has_layer && e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e))
      if (mesh.edge_tag[e] == EdgeTag::sigma &&
          std::abs(mesh.vertices(v, mesh.vertical())) > slack * size)
        throw Error(
            "scene and mesh: Sigma has a vertex at " + mesh.location_text(v) +
            "; accepted: Sigma on the line y = 0, or a layer that is grown along its normals");
  // (22) and (23) differ by the depth of their meshes. A second body may lie below the layer.
  const int across = mesh.vertical();
  double lowest = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer)
      for (const int v : mesh.triangles.row(t)) lowest = std::min(lowest, mesh.vertices(v, across));
  const double wanted = -scene.layer_depth();
  const double off = slack * std::max(size, scene.layer_depth());
  if (mesh_has_layer && (lowest < wanted - off || (lowest > wanted + off && is_whole(mesh))))
    throw Error(
        fmt::format("scene and mesh: the mesh reaches down to y = {:.6g}; accepted: y = {:.6g}, "
                    "the lower side of the "
                    "layer of this scene",
                    lowest, wanted));
}

/// The layer below a curved Sigma: both forms in its own coordinates, as mesh/layered.hpp has them.
void follow_normals(VariationalInequality& problem, const StiffLayer& layer, const Space& space,
                    const StiffnessRange& range) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = strain_quadrature(space.element());
  FactoredForm along =
      layer_strain(space, [&](int t) { return Eigen::Vector2d(1, mesh.curved_columns[t].slope); });
  Eigen::VectorXd stiffness(along.m.size());
  for (Eigen::Index row = 0; row < along.m.size(); ++row) {
    const int t = along.cell[row];
    const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(row % rule.weights.size()));
    const double j = mesh.curved_columns[t].jacobian(x, layer.epsilon),
                 length = std::hypot(1, mesh.curved_columns[t].slope);
    problem.m(row) *= length * j;
    stiffness(row) = layer.s / (length * j);
  }
  if (!range.fits_in_a1(layer.s))
    return range.append(problem, {std::move(along), std::move(stiffness)});
  along.m.array() *= stiffness.array();
  problem.a1 += Eigen::SparseMatrix<double>(along.b.transpose() * along.m.asDiagonal() * along.b);
}

/// T: the stiffness of each triangle in A1, `layer` that of the layer's.
std::vector<Stiffness> stiffness_of_triangles(const Scene& scene, const TriangleMesh& mesh,
                                              const Stiffness& layer) {
  std::vector<Stiffness> of_triangle;
  of_triangle.reserve(mesh.triangle_count());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const double k =
        mesh.region[t] == Region::layer ? 0 : stiffness_on(scene.body().stiffness, mesh, t);
    of_triangle.push_back(mesh.region[t] == Region::layer ? layer : Stiffness{k, k});
  }
  return of_triangle;
}

/// A form for each group of springs.
std::vector<WeightedFactoredForm> springs_of(const Scene& scene, const Space& space) {
  std::vector<WeightedFactoredForm> springs;
  for (int k = 0; k < static_cast<int>(scene.edges().size()); ++k)
    if (const BoundaryCondition& edge = scene.edges()[k];
        edge.kind == BoundaryCondition::Kind::spring)
      springs.push_back(edge_rows(space, natural_group(k), edge.value));
  return springs;
}

/// Springs hold a component of the mesh that no displacement holds.
bool springs_alone_hold_a_component(const TriangleMesh& mesh) {
  return find_floating_component(mesh, [&](int e) { return is_dirichlet(mesh.edge_tag[e]); }) >= 0;
}

/// Adds springs to A1, or to B where their entries are far above those of A1. Throws Error where
/// they are 1e20 times the softest stiffness: the rounding of a row is then no longer small beside
/// it.
void add_springs(VariationalInequality& problem, const std::vector<WeightedFactoredForm>& springs,
                 const StiffnessRange& range, const TriangleMesh& mesh) {
  for (const WeightedFactoredForm& rows : springs) {
    if (rows.stiffness.size() == 0) continue;
    const double largest = rows.form.m.cwiseProduct(rows.stiffness).maxCoeff();
    if (largest > 1e20 * range.softest())
      throw Error(
          fmt::format("spring: its stiffness times the {} is {:.3g}, and the "
                      "softest stiffness is "
                      "{:.3g}; accepted: up to 1e20 times as much, or a displacement",
                      mesh.dimension() == 2 ? "length of an edge" : "area of a face", largest,
                      range.softest()));
    if (range.fits_in_a1(largest))
      problem.a1 += gram_matrix(rows);
    else
      range.append(problem, rows);
  }
}

/// The values that the Dirichlet edges at each place, an unknown or a vertex, give to it. A clamped
/// edge gives 0 where no group with a displacement meets it. Where groups meet with different
/// values, no continuous function has them all. The place takes their mean, so that the order of
/// the groups does not matter.
class PrescribedValues {
 public:
  void give(int place, EdgeTag tag, double value) { at_[place][tag] = value; }
  /// act(place, value)
  template <class Act>
  void for_each(Act&& act) const {
    for (const auto& [place, of_tags] : at_) act(place, mean(of_tags));
  }

 private:
  using OfTags = std::map<EdgeTag, double>;
  static double mean(const OfTags& of_tags) {
    std::vector<double> values;
    for (const auto& [tag, value] : of_tags)
      if (tag.group >= 0) values.push_back(value);
    if (values.empty()) return 0;  // clamped edges alone
    std::sort(values.begin(),
              values.end());  // the sum of three, too, is the same in every order of the sections
    if (values.front() == values.back()) return values.front();
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }

  std::map<int, OfTags> at_;
};

/// The values that the named groups of edges prescribe.
void add_displacements(VariationalInequality& problem, const Scene& scene, const Space& space) {
  const auto prescribes = [](const BoundaryCondition& e) {
    return e.kind == BoundaryCondition::Kind::displacement;
  };
  if (std::none_of(scene.edges().begin(), scene.edges().end(), prescribes)) return;
  const TriangleMesh& mesh = space.mesh();
  const ReferencePoints nodes = space.element().support_points();
  PrescribedValues values;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < mesh.reference().facets; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (!is_dirichlet(mesh.edge_tag[e])) continue;
      for (Eigen::Index j = 0; j < nodes.rows(); ++j)
        if (const int unknown = space.cell_dofs()(t, j); lies_on_facet(mesh.kind, i, nodes.row(j)))
          values.give(unknown, mesh.edge_tag[e], dof_value(space, t, j, [&](const Position& x) {
                        return prescribed_on(scene, mesh, e, x);
                      }));
    }
  values.for_each([&](int unknown, double value) {
    const auto place =
        std::lower_bound(problem.dirichlet_dofs.begin(), problem.dirichlet_dofs.end(), unknown);
    problem.dirichlet_values(place - problem.dirichlet_dofs.begin()) = value;
  });
}

/// The range of the stiffnesses of all parts of a scene. Throws Error where they are too far apart.
StiffnessRange checked_range(const Scene& scene, const TriangleMesh& mesh,
                             const std::vector<Stiffness>& of_triangles,
                             const std::vector<WeightedFactoredForm>& springs) {
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  StiffnessRange range(stiff != nullptr ? stiff->s : 1);
  for (const auto& [x, y] : of_triangles) {
    range.note(x);
    range.note(y);
  }
  if (stiff != nullptr) range.note(stiff->s);
  if (std::holds_alternative<VentcelLayer>(scene.layer())) range.note(1);
  if (!springs.empty() && springs_alone_hold_a_component(mesh))
    for (const WeightedFactoredForm& rows : springs) range.note(rows.form.m.dot(rows.stiffness));
  range.check("stiffness");
  return range;
}

/// Takes the stiffnesses out of `in_a1` that are too large for it, and returns them. Empty if there
/// is none.
std::vector<Stiffness> take_rows(std::vector<Stiffness>& in_a1, const StiffnessRange& range) {
  std::vector<Stiffness> in_rows;
  for (std::size_t t = 0; t < in_a1.size(); ++t) {
    if (range.fits_in_a1(std::max(in_a1[t].x, in_a1[t].y))) continue;
    in_rows.resize(in_a1.size(), {0, 0});
    std::swap(in_a1[t], in_rows[t]);
  }
  return in_rows;
}

/// The rows of B of the scaled layer, with its compliance.
void add_layer(VariationalInequality& problem, const StiffLayer& layer, const Space& space,
               const StiffnessRange& range) {
  FactoredForm strain = layer_strain(space);  // a_y^-, factored
  problem.b.swap(strain.b);
  problem.m = layer.s * strain.m;
  if (space.mesh().curved()) follow_normals(problem, layer, space, range);
  problem.compliance = class_parameter(layer);
}

/// The bounds on Gamma_C.
void add_contact(VariationalInequality& problem, const UnilateralContact& contact,
                 const Space& space) {
  const int along = space.mesh().vertical();  // 1 or 2 coordinates along the layer
  const auto dofs_of = [&](const Profile& profile) {
    return dof_values(space, space.contact_dofs(), [&](double x, double y, double) {
      return along == 1 ? profile(x) : profile(x, y);
    });
  };
  problem.bounds = Bounds::lower_on(space.contact_dofs(), -dofs_of(contact.gap));
  const Eigen::VectorXd& lower = problem.bounds.lower;
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (std::isfinite(lower(i))) continue;
    const Position x = space.dof_coordinates().row(space.contact_dofs()[i]);
    throw Error(fmt::format("contact: gap({:.6g}) is not finite",
                            fmt::join(x.data(), x.data() + along, ", ")));
  }
  if (!contact.upper_obstacle) return;
  Eigen::VectorXd& upper = problem.bounds.upper;
  upper = dofs_of(contact.upper_obstacle);
  // where two formulas say the same, the round-off of one must not put the ceiling below the
  // obstacle
  const Eigen::ArrayXd round_off = 1e-12 * lower.array().abs().max(1);
  for (Eigen::Index i = 0; i < lower.size(); ++i)
    if (upper(i) >= lower(i) - round_off(i)) upper(i) = std::max(upper(i), lower(i));
}

/// Adds everything but the forms: prescribed values, load, and the bounds of contact.
void add_load_and_bounds(VariationalInequality& problem, const Scene& scene, const Space& space) {
  problem.dirichlet_dofs = space.dirichlet_dofs();
  problem.dirichlet_values =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.dirichlet_dofs.size()));
  add_displacements(problem, scene, space);
  problem.load = load_of(scene, space);
  if (scene.contact()) add_contact(problem, *scene.contact(), space);
}

}  // namespace

double profile_value(const Profile& profile, const Position& x) {
  return x.size() == 2 ? profile(x(0)) : profile(x(0), x(1));
}

double class_parameter(const StiffLayer& layer) { return layer.epsilon * layer.epsilon; }

double prescribed_on(const Scene& scene, const TriangleMesh& mesh, int e, const Position& x) {
  const int k = mesh.edge_tag[e].group;
  if (k < 0) return 0;
  Eigen::Vector3d above = Eigen::Vector3d::Zero();
  above.head(x.size()) = x.transpose();
  if (mesh.region[mesh.edge_triangles(e, 0)] == Region::layer) above(mesh.vertical()) = 0;
  return field_value(scene.edges()[k].value, above.transpose());
}

Eigen::VectorXd dirichlet_vertex_values(const Scene& scene, const TriangleMesh& mesh) {
  PrescribedValues given_values;
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (int end = 0; end < mesh.dimension() && is_dirichlet(mesh.edge_tag[e]); ++end)
      given_values.give(mesh.edges(e, end), mesh.edge_tag[e],
                        prescribed_on(scene, mesh, e, mesh.vertices.row(mesh.edges(e, end))));
  Eigen::VectorXd values = Eigen::VectorXd::Zero(mesh.vertex_count());
  given_values.for_each([&](int vertex, double value) { values(vertex) = value; });
  return values;
}

Eigen::VectorXd load_of(const Scene& scene, const Space& space) {
  Eigen::VectorXd load = load_vector(space, scene.body().load);
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  if (stiff != nullptr && stiff->load) load += load_vector(space, stiff->load, Region::layer);
  for (int k = 0; k < static_cast<int>(scene.edges().size()); ++k)
    if (const BoundaryCondition& edge = scene.edges()[k];
        edge.kind == BoundaryCondition::Kind::traction)
      load += edge_load(space, natural_group(k), edge.value);
  return load;
}

VariationalInequality assemble(const Scene& scene, const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  check_fit(scene, mesh);
  if (space.element().dofs_per_cell() == space.element().dofs())
    throw Error("anti-plane: no unknown of the element " + space.element().name() +
                " is shared by two triangles; accepted: such an element with an InteriorPenalty");
  if (space.element().equation().size() > 0)
    throw Error("anti-plane: element " + space.element().name() +
                " is not accepted; BDM1-hybrid (hybrid_bdm1), of the same order");
  static_assert(std::variant_size_v<Layer> == 4,
                "what a new layer adds to A1 and to B stands here");
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  const auto* thin = std::get_if<ThinLayer>(&scene.layer());
  Stiffness layer{0, 0};
  if (stiff != nullptr && !mesh.curved()) layer.x = stiff->s;  // a_x^- of (23)
  if (thin != nullptr) {                                       // mu / epsilon of (22)
    layer.x = 1 / thin->epsilon;
    layer.y = 1 / thin->epsilon;
  }
  std::vector<Stiffness> in_a1 = stiffness_of_triangles(scene, mesh, layer);
  const std::vector<WeightedFactoredForm> springs = springs_of(scene, space);
  const StiffnessRange range = checked_range(scene, mesh, in_a1, springs);
  const std::vector<Stiffness> in_rows = take_rows(in_a1, range);

  VariationalInequality problem;
  problem.b.resize(0, space.size());
  gradient_form(space, in_a1).swap(problem.a1);  // an assignment would copy the matrix
  if (std::holds_alternative<VentcelLayer>(scene.layer()))
    problem.a1 += ventcel_form(space, dirichlet_vertex_values(scene, mesh));
  if (stiff != nullptr) add_layer(problem, *stiff, space, range);
  if (!in_rows.empty()) range.append(problem, gradient_rows(space, in_rows));
  add_springs(problem, springs, range, mesh);

  add_load_and_bounds(problem, scene, space);
  return problem;
}

VariationalInequality assemble(const Scene& scene, const Space& space,
                               const InteriorPenalty& method) {
  check_fit(scene, space.mesh());
  const auto* stiff = std::get_if<StiffLayer>(&scene.layer());
  const bool has_model = stiff != nullptr || std::holds_alternative<NoLayer>(scene.layer());
  if (!has_model || scene.body().stiffness || !scene.edges().empty() || space.mesh().curved())
    throw Error(
        "interior penalty: accepted: a body of stiffness 1 that is clamped, with a scaled layer "
        "below a straight Sigma, or without a layer");
  VariationalInequality problem;
  problem.a1.resize(space.size(), space.size());
  const auto add_to_a1 = [&](Region region, int axis, double stiffness) {
    FactoredForm rows = interior_penalty_form(space, region, axis, method);
    const auto count = rows.m.size();
    problem.a1 += gram_matrix({std::move(rows), Eigen::VectorXd::Constant(count, stiffness)});
  };
  add_to_a1(Region::body, 0, 1);
  add_to_a1(Region::body, 1, 1);
  problem.b.resize(0, space.size());
  if (stiff != nullptr) {
    add_to_a1(Region::layer, 0, stiff->s);
    FactoredForm across = interior_penalty_form(space, Region::layer, 1, method);
    problem.b.swap(across.b);
    problem.m = stiff->s * across.m;
    problem.compliance = class_parameter(*stiff);
  }
  add_load_and_bounds(problem, scene, space);
  return problem;
}

}  // namespace antilock
