#include "antilock/certificate/equilibrated_flux.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/core/error.hpp"
#include "antilock/form/edge_forms.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/problem/bounds.hpp"

namespace antilock {
namespace {

/// The traction on the edges with a tag; null where there is none.
const Field* traction_on(const Scene& scene, EdgeTag tag) {
  const int k = tag.group;
  return k < 0 || scene.edges()[k].kind != BoundaryCondition::Kind::traction
             ? nullptr
             : &scene.edges()[k].value;
}

/// Throws for an element, a feature or a layer without a flux in equilibrium.
void check_scene(const Scene& scene, const Result& result) {
  require_lower_bounds(result.problem.bounds, "certificate");
  const Element& element = result.space.element();
  if (element.name() != "CR")
    throw Error("certificate: element " + element.name() +
                " has no flux in equilibrium; accepted: CR, and certified_distance to it");
  if (const std::string beyond = scene.beyond_the_certificate(); !beyond.empty())
    throw Error("certificate: has no flux for " + beyond + "; accepted: a scene without it");
  if (std::holds_alternative<VentcelLayer>(scene.layer()))
    throw Error(
        "certificate: the Ventcel layer has no flux of its own; accepted: the scaled layer with "
        "epsilon = 0, which is "
        "the same problem");
}

/// Throws unless u and p are finite, and of the sizes that the scene has on this space.
void check_solution(const Scene& scene, const Result& result) {
  const Space& space = result.space;
  const VariationalInequality& problem = result.problem;
  const Solution& solution = result.solution;
  const auto& region = space.mesh().region;
  const bool split = std::holds_alternative<StiffLayer>(scene.layer());
  const auto rows = split ? std::count(region.begin(), region.end(), Region::layer) : 0;
  if (problem.size() != space.size() || solution.u.size() != space.size() ||
      problem.b.rows() != rows || solution.p.size() != problem.b.rows())
    throw Error(
        fmt::format("certificate: problem and solution have {} and {} unknowns, {} and {} layer "
                    "stresses; accepted: {} and {}, of "
                    "the scene on this space",
                    problem.size(), solution.u.size(), problem.b.rows(), solution.p.size(),
                    space.size(), rows));
  if (!solution.u.allFinite() || !solution.p.allFinite())
    throw Error("certificate: the solution is not finite; accepted: finite numbers");
}

/// Throws for conditions on the boundary that the flux does not have.
void check_boundary(const Scene& scene, const Space& space, const VariationalInequality& problem) {
  const TriangleMesh& mesh = space.mesh();
  if (problem.bounds.unknowns.empty() == scene.contact().has_value() &&
      !space.contact_dofs().empty())
    throw Error("certificate: scene and problem do not agree whether there is contact");
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool of_layer = mesh.region[mesh.edge_triangles(e, 0)] == Region::layer;
    if (of_layer && traction_on(scene, mesh.edge_tag[e]) != nullptr)
      throw Error("certificate: has no flux for a traction on the layer; accepted: on the body");
  }
  for (const int e : problem.dirichlet_dofs)
    if (mesh.edge_triangles(e, 1) >= 0)
      throw Error("certificate: a value is fixed inside the domain; accepted: on the boundary");
  for (const int e : problem.bounds.unknowns)
    if (mesh.edge_tag[e] != EdgeTag::contact)
      throw Error(
          "certificate: an unknown off Gamma_C is bounded; accepted: bounds on the edges in the "
          "group contact");
}

/// Throws unless the displacement given on edge e is affine, with the values `at_vertices` at its
/// ends, as far as three points between them show: the conforming v takes it as it is.
void check_displacement_on(const Scene& scene, const TriangleMesh& mesh, int e,
                           const Eigen::VectorXd& at_vertices, double tolerance) {
  const int from = mesh.edges(e, 0);
  const int to = mesh.edges(e, 1);
  const int group = mesh.edge_tag[e].group;
  for (int part = 0; part <= 4; ++part) {
    const double s = part / 4.0;
    const double affine = (1 - s) * at_vertices(from) + s * at_vertices(to);
    const Eigen::RowVector2d x = (1 - s) * mesh.vertices.row(from) + s * mesh.vertices.row(to);
    const double given = group < 0 ? 0 : scene.edges()[group].value(x(0), x(1));
    const double off = given - affine;
    if (!(std::abs(off) <= tolerance))
      throw Error(fmt::format(
          "certificate: the displacement given at ({:.6g}, {:.6g}) is {:.1e} off that of the "
          "vertices "
          "beside it; accepted: values that do not jump, affine on every edge of the mesh",
          x(0), x(1), off));
  }
}

/// Throws unless the given displacement is affine on each edge, and the same at a vertex from
/// either side.
void check_displacement(const Scene& scene, const TriangleMesh& mesh) {
  const Eigen::VectorXd at_vertices = dirichlet_vertex_values(scene, mesh);
  const double tolerance = 1e-11 * at_vertices.cwiseAbs().maxCoeff();
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!is_dirichlet(mesh.edge_tag[e])) continue;
    const bool given = mesh.edge_tag[e].group >= 0;
    if (given && mesh.region[mesh.edge_triangles(e, 0)] == Region::layer) continue;
    check_displacement_on(scene, mesh, e, at_vertices, tolerance);
  }
}

/// kappa of a triangle, which must be one number on it, as far as six more points tell.
double constant_stiffness(const Field& stiffness, const TriangleMesh& mesh, int t) {
  const double kappa = stiffness_on(stiffness, mesh, t);
  if (!stiffness) return kappa;
  for (int i = 0; i < 6; ++i) {  // beside the corners, then beside the middles of the edges
    Eigen::Vector3d there = Eigen::Vector3d::Unit(i % 3);
    if (i >= 3) there = (Eigen::Vector3d::Ones() - there) / 2;
    const Eigen::Vector2d x = point_in(mesh, t, 0.98 * there + Eigen::Vector3d::Constant(0.02 / 3));
    const double other = stiffness(x(0), x(1));
    if (std::abs(other - kappa) > 1e-12 * kappa)
      throw Error(fmt::format(
          "certificate: the stiffness is {:.6g} and {:.6g} on the triangle at ({:.6g}, {:.6g}); "
          "accepted: one number per triangle, as of groups of surfaces",
          kappa, other, x(0), x(1)));
  }
  return kappa;
}

/// A traction g on edge i of a triangle, from its corner (i + 1) % 3 (s = 0) to the next (s = 1):
/// the means of g and of g (s - 1/2), and |g - g_1| over the edge, g_1 = mean + 12 moment (s -
/// 1/2).
struct TractionOn {
  double mean = 0, moment = 0, rest = 0;

  TractionOn(const TriangleMesh& mesh, int t, int i, const Field& g) {
    static const auto rule = gauss_rule(12);
    const auto& [points, weights] = rule;
    Eigen::VectorXd values(points.size());
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, on_edge(i, points(q)));
      values(q) = g(x(0), x(1));
    }
    const Eigen::ArrayXd odd = points.array() - 0.5;
    mean = weights.dot(values);
    moment = weights.dot((values.array() * odd).matrix());
    const Eigen::ArrayXd off = values.array() - mean - 12 * moment * odd;
    rest =
        std::sqrt(mesh.edge_length(mesh.triangle_edges(t, i)) * weights.dot(off.square().matrix()));
  }
};

/// f on a triangle by a rule: the means of f lambda_i and of f^2, f_1 and the mean of (f - f_1)^2.
struct LoadOn {
  Eigen::Vector3d mean_lambda, f;
  double square, rest2;

  LoadOn(const TriangleMesh& mesh, int t, const Quadrature& rule, const Field& load) {
    Eigen::VectorXd values(rule.weights.size());
    for (Eigen::Index q = 0; q < values.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      values(q) = load(x(0), x(1));
      if (!std::isfinite(values(q)))
        throw Error(fmt::format("load: f({:.6g}, {:.6g}) is not finite", x(0), x(1)));
    }
    mean_lambda = rule.points.transpose() * rule.weights.cwiseProduct(values);
    f = (12 * mean_lambda.array() - 3 * mean_lambda.sum()).matrix();
    square = rule.weights.dot(values.cwiseAbs2());
    const Eigen::VectorXd affine = rule.points * f;  // f_1 at the points
    rest2 = rule.weights.dot((values - affine).cwiseAbs2());
  }
  /// The mean of f phi_i, where phi_i = 1 - 2 lambda_i.
  double of_basis(int i) const { return mean_lambda.sum() - 2 * mean_lambda(i); }
};

/// Where the affine part of f leaves out a tenth of it, the solver's rule may miss what is left.
bool needs_finer_rule(const LoadOn& load) { return load.rest2 > 1e-2 * load.square; }

/// The mean of the gap over an edge: Gauss's rule of two points on 16 parts.
double mean_gap(const Profile& gap, double from, double to) {
  constexpr int parts = 16;
  double sum = 0;
  for (int k = 0; k < parts; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double place = k + 0.5 + side / std::sqrt(12.0);
      sum += gap(from + (to - from) * place / parts);
    }
  return sum / (2 * parts);
}

double longest_edge(const TriangleMesh& mesh, int t) {
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    longest = std::max(longest, mesh.edge_length(mesh.triangle_edges(t, i)));
  return longest;
}

/// Throws unless the residual by the forms of the problem is `ours`, that of the scene: else the
/// two are not one question.
void check_same_question(const VariationalInequality& problem, const Solution& solution,
                         const Eigen::VectorXd& ours) {
  Eigen::VectorXd theirs = problem.a1 * solution.u;
  double size = problem.a1.diagonal().cwiseAbs().maxCoeff() * solution.u.lpNorm<Eigen::Infinity>() +
                problem.load.lpNorm<Eigen::Infinity>();
  if (problem.b.rows() > 0) {
    const Eigen::VectorXd stress = problem.b.transpose() * problem.m.cwiseProduct(solution.p);
    size += stress.lpNorm<Eigen::Infinity>();
    theirs += stress;
  }
  const double off = (ours - theirs + problem.load).lpNorm<Eigen::Infinity>();
  if (off > 1e-10 * size)
    throw Error(fmt::format(
        "certificate: the problem is not the scene's on this space: its forces differ by {:.1e} of "
        "the largest; accepted: what assemble(scene, space) makes, its load above all",
        off / size));
}

/// A of the layer.
FluxLaw layer_law(const Scene& scene) {
  if (const auto* stiff = std::get_if<StiffLayer>(&scene.layer()))
    return {true, stiff->s, 1 / stiff->s, class_parameter(*stiff) / stiff->s};
  if (const auto* thin = std::get_if<ThinLayer>(&scene.layer()))
    return {false, 1 / thin->epsilon, thin->epsilon, thin->epsilon};
  return {};
}

/// The flux while it is made, triangle by triangle.
class FluxBuilder {
 public:
  FluxBuilder(const Scene& scene, const Result& result)
      : scene_(scene), space_(result.space), mesh_(space_.mesh()), solution_(result.solution) {
    flux_.law = layer_law(scene);
    flux_.cell.resize(mesh_.triangle_count());
    flux_.traction_load = Eigen::VectorXd::Zero(mesh_.vertex_count());
    assembled_ = Eigen::VectorXd::Zero(space_.size());
    finer_ = Eigen::VectorXd::Zero(space_.size());
  }

  /// Computes S_h, tau and the oscillation of each triangle, and the residual r.
  EquilibratedFlux flux(const VariationalInequality& problem) {
    for (int t = 0; t < mesh_.triangle_count(); ++t) add_triangle(t);
    for (int k = 0; k < static_cast<int>(scene_.edges().size()); ++k)
      add_usual_traction(natural_group(k));
    check_same_question(problem, solution_, assembled_);
    flux_.residual = assembled_ - finer_;
    return std::move(flux_);
  }

 private:
  void add_triangle(int t) {
    FluxCell& here = flux_.cell[t];
    const double area = mesh_.area(t);
    const auto dof = space_.cell_dofs().row(t);
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh_, t);
    const Eigen::Vector2d gradient = -2 * lambda.transpose() * Eigen::Vector3d(solution_.u(dof));
    if (mesh_.region[t] == Region::layer)
      add_layer_flux(here, gradient);
    else
      add_body_flux(t, gradient);
    flux_.norm2 += area * here.law.squared(here.s) + here.tau2;  // tau has mean zero on T
    for (int i = 0; i < 3; ++i)
      assembled_(dof(i)) -= 2 * area * here.s.dot(lambda.row(i));  // grad phi_i
  }

  void add_layer_flux(FluxCell& here, const Eigen::Vector2d& gradient) {
    here.law = flux_.law;
    here.s = here.law.stiffness * gradient;
    if (!here.law.split) return;
    here.s(1) = here.law.stiffness * solution_.p(layer_row_);
    ++layer_row_;
  }

  void add_body_flux(int t, const Eigen::Vector2d& gradient) {
    FluxCell& here = flux_.cell[t];
    const double area = mesh_.area(t);
    const double load_rest2 = add_load(t);
    const double kappa = constant_stiffness(scene_.body().stiffness, mesh_, t);
    here.law = {false, kappa, 1 / kappa, 1 / kappa};
    here.s = kappa * gradient;
    const double h = longest_edge(mesh_, t);
    double oscillation = h / std::numbers::pi * std::sqrt(area * load_rest2);
    for (int i = 0; i < 3; ++i) {
      const Field* const g = traction_on(scene_, mesh_.edge_tag[mesh_.triangle_edges(t, i)]);
      if (g != nullptr) oscillation += add_traction(t, i, *g, h);
    }
    here.oscillation2 = oscillation * oscillation / kappa;
    flux_.oscillation2 += here.oscillation2;
    const Quadrature& rule = radon_rule();  // tau^2 is of degree 4
    const Eigen::MatrixX2d tau = flux_.tau(mesh_, t, rule.points);
    here.tau2 = area / kappa * rule.weights.dot(tau.rowwise().squaredNorm());
    flux_.tau2 += here.tau2;
  }

  /// Sets f_1. Returns the mean of (f - f_1)^2.
  double add_load(int t) {
    static const Quadrature& fine_rule = triangle_rule(12);
    const Field& f = scene_.body().load;
    const double area = mesh_.area(t);
    const auto dof = space_.cell_dofs().row(t);
    const LoadOn usual(mesh_, t, load_rule(space_.element()), f);
    LoadOn load = usual;
    if (needs_finer_rule(usual)) {
      load = LoadOn(mesh_, t, fine_rule, f);
      for (int i = 0; i < 3; ++i) finer_(dof(i)) += area * (load.of_basis(i) - usual.of_basis(i));
    }
    for (int i = 0; i < 3; ++i) assembled_(dof(i)) -= area * usual.of_basis(i);
    flux_.cell[t].f = load.f;
    return load.rest2;
  }

  /// Adds the traction g on edge i. Returns C_E |g - g_1|_E (certificate.cpp), h the diameter of t.
  double add_traction(int t, int i, const Field& g, double h) {
    const TractionOn edge(mesh_, t, i, g);
    const auto dof = space_.cell_dofs().row(t);
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double length = mesh_.edge_length(mesh_.triangle_edges(t, i));
    flux_.cell[t].traction(i) = -6 * edge.moment * length;
    flux_.traction_load(mesh_.triangles(t, j)) += length * (edge.mean / 2 - edge.moment);
    flux_.traction_load(mesh_.triangles(t, k)) += length * (edge.mean / 2 + edge.moment);
    finer_(dof(i)) += length * edge.mean;
    finer_(dof(j)) += 2 * length * edge.moment;
    finer_(dof(k)) -= 2 * length * edge.moment;
    const double area = mesh_.area(t);
    return edge.rest * h * std::sqrt(length / area * (1 / std::numbers::pi + 1) / std::numbers::pi);
  }

  /// The traction as the solver integrates it. add_traction has added it by a finer rule.
  void add_usual_traction(EdgeTag tag) {
    const Field* const g = traction_on(scene_, tag);
    if (g == nullptr) return;
    const Eigen::VectorXd usual = edge_load(space_, tag, *g);
    assembled_ -= usual;
    finer_ -= usual;
  }

  const Scene& scene_;
  const Space& space_;
  const TriangleMesh& mesh_;
  const Solution& solution_;
  EquilibratedFlux flux_;
  Eigen::VectorXd assembled_;  ///< r, with the loads as the solver integrates them
  Eigen::VectorXd finer_;      ///< what finer rules add to the loads
  int layer_row_ = 0;
};

/// Splits r into contact forces on Gamma_C and the imbalance.
void add_contact_forces(EquilibratedFlux& flux, const Scene& scene, const TriangleMesh& mesh,
                        const VariationalInequality& problem) {
  flux.imbalance = flux.residual;
  for (const int e : problem.dirichlet_dofs) flux.imbalance(e) = 0;
  const auto contact = static_cast<Eigen::Index>(problem.bounds.unknowns.size());
  flux.lambda.resize(contact);
  flux.gap.resize(contact);
  for (Eigen::Index i = 0; i < contact; ++i) {
    const int e = problem.bounds.unknowns[i];  // the unknown of Crouzeix-Raviart is the edge
    flux.lambda(i) = std::max(flux.residual(e), 0.0);
    flux.imbalance(e) -= flux.lambda(i);
    const double from = mesh.vertices(mesh.edges(e, 0), 0);
    const double to = mesh.vertices(mesh.edges(e, 1), 0);
    flux.gap(i) = mean_gap(scene.contact()->gap, from, to);
  }
}

/// D, the energy of the dual problem.
double dual_energy(const EquilibratedFlux& flux, const VariationalInequality& problem) {
  double energy = -flux.norm2 / 2 - flux.lambda.dot(flux.gap);
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
    energy += flux.residual(problem.dirichlet_dofs[i]) *
              problem.dirichlet_values(static_cast<Eigen::Index>(i));
  return energy;
}

}  // namespace

// sum_i f_i lambda_i (x - P_i) = f_1 x - sum_i f_i lambda_i P_i; the mean of f x is sum_i mean(f
// lambda_i) P_i
Eigen::MatrixX2d EquilibratedFlux::tau(const TriangleMesh& mesh, int t,
                                       const Eigen::MatrixX3d& barycentric) const {
  const FluxCell& here = cell[t];
  const Eigen::Matrix<double, 3, 2> corner =
      mesh.vertices(mesh.triangles.row(t), Eigen::indexing::all);
  const Eigen::Matrix<double, 3, 2> weighted = here.f.asDiagonal() * corner;
  const double mean = here.f.mean();
  const Eigen::RowVector2d constant =
      0.5 * mean * corner.colwise().sum() - (weighted + 3 * mean * corner).colwise().sum() / 12;
  Eigen::MatrixX2d tau(barycentric.rows(), 2);
  for (Eigen::Index q = 0; q < barycentric.rows(); ++q) {
    const Eigen::RowVector3d l = barycentric.row(q);
    const double rotation = 0.5 * mean + l.dot(here.f) / 3;
    tau.row(q) = constant - rotation * (l * corner) + l * weighted / 3;
  }
  if (here.traction.isZero(0)) return tau;
  const Eigen::Matrix<double, 3, 2> gradient = barycentric_gradients(mesh, t);
  for (int i = 0; i < 3; ++i) {  // grad (lambda_j lambda_k) less its mean, turned
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const Eigen::MatrixX2d slope =
        (barycentric.col(j).array() - 1.0 / 3).matrix() * gradient.row(k) +
        (barycentric.col(k).array() - 1.0 / 3).matrix() * gradient.row(j);
    tau.col(0) += here.traction(i) * slope.col(1);
    tau.col(1) -= here.traction(i) * slope.col(0);
  }
  return tau;
}

EquilibratedFlux equilibrated_flux(const Scene& scene, const Result& result) {
  require_triangles(result.space.mesh(), "equilibrated flux");
  const VariationalInequality& problem = result.problem;
  if ((problem.fixed_compliances.array() > 0).any())
    return equilibrated_flux(scene, assemble_fixed_rows(result));
  check_scene(scene, result);
  check_solution(scene, result);
  check_boundary(scene, result.space, problem);
  check_displacement(scene, result.space.mesh());
  EquilibratedFlux flux = FluxBuilder(scene, result).flux(problem);
  add_contact_forces(flux, scene, result.space.mesh(), problem);
  flux.dual_energy = dual_energy(flux, problem);
  return flux;
}

}  // namespace antilock
