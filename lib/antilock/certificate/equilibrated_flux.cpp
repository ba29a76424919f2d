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
  return k < 0 || scene.edges()[k].kind != BoundaryCondition::Kind::traction ? nullptr : &scene.edges()[k].value;
}

void check_request(const Scene& scene, const Result& result) {
  const Space& space = result.space;
  const VariationalInequality& problem = result.problem;
  const Solution& solution = result.solution;
  require_lower_bounds(problem, "certificate");
  if (space.element().name() != "CR")
    throw Error("certificate: element " + space.element().name() +
                " has no flux in equilibrium; accepted: CR, and certified_distance to it");
  if (const std::string beyond = scene.beyond_the_certificate(); !beyond.empty())
    throw Error("certificate: has no flux for " + beyond + "; accepted: a scene without it");
  if (std::holds_alternative<VentcelLayer>(scene.layer()))
    throw Error(
        "certificate: the Ventcel layer has no flux of its own; accepted: the scaled layer with epsilon = 0, which is "
        "the same problem");
  const auto& region = space.mesh().region;
  const auto layer = std::count(region.begin(), region.end(), Region::layer);
  const bool split = std::holds_alternative<StiffLayer>(scene.layer());
  if (problem.size() != space.size() || solution.u.size() != space.size() || problem.b.rows() != (split ? layer : 0) ||
      solution.p.size() != problem.b.rows())
    throw Error(fmt::format(
        "certificate: problem and solution have {} and {} unknowns, {} and {} layer stresses; accepted: {} and {}, of "
        "the scene on this space",
        problem.size(), solution.u.size(), problem.b.rows(), solution.p.size(), space.size(), split ? layer : 0));
  if (!solution.u.allFinite() || !solution.p.allFinite())
    throw Error("certificate: the solution is not finite; accepted: finite numbers");
  if (problem.contact.empty() == scene.contact().has_value() && !space.contact_dofs().empty())
    throw Error("certificate: scene and problem do not agree whether there is contact");
  for (int e = 0; e < space.mesh().edge_count(); ++e)
    if (traction_on(scene, space.mesh().edge_tag[e]) != nullptr &&
        region[space.mesh().edge_triangles(e, 0)] == Region::layer)
      throw Error("certificate: has no flux for a traction on the layer; accepted: on the body");
  for (const int e : problem.dirichlet_dofs)
    if (space.mesh().edge_triangles(e, 1) >= 0)
      throw Error("certificate: a value is fixed inside the domain; accepted: on the boundary");
  for (const int e : problem.contact)
    if (space.mesh().edge_tag[e] != EdgeTag::contact)
      throw Error("certificate: an unknown off Gamma_C is bounded; accepted: bounds on the edges in the group contact");
}

/// The conforming v takes the displacement given on an edge as it is: affine, and the same at a vertex from either side.
void check_displacement(const Scene& scene, const TriangleMesh& mesh) {
  const Eigen::VectorXd at_vertices = dirichlet_vertex_values(scene, mesh);
  const double largest = at_vertices.cwiseAbs().maxCoeff();
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int from = mesh.edges(e, 0), to = mesh.edges(e, 1), k = mesh.edge_tag[e].group;
    if (!is_dirichlet(mesh.edge_tag[e]) || (k >= 0 && mesh.region[mesh.edge_triangles(e, 0)] == Region::layer))
      continue;
    for (int part = 0; part <= 4; ++part) {
      const double s = part / 4.0, affine = (1 - s) * at_vertices(from) + s * at_vertices(to);
      const Eigen::RowVector2d x = (1 - s) * mesh.vertices.row(from) + s * mesh.vertices.row(to);
      if (const double off = (k < 0 ? 0 : scene.edges()[k].value(x(0), x(1))) - affine;
          !(std::abs(off) <= 1e-11 * largest))
        throw Error(
            fmt::format("certificate: the displacement given at ({:.6g}, {:.6g}) is {:.1e} off that of the vertices "
                        "beside it; accepted: values that do not jump, affine on every edge of the mesh",
                        x(0), x(1), off));
    }
  }
}

/// kappa of a triangle, which must be one number on it, as far as six more points tell.
double constant_stiffness(const Field& stiffness, const TriangleMesh& mesh, int t) {
  const double kappa = stiffness_on(stiffness, mesh, t);
  for (int i = 0; i < 6 && stiffness; ++i) {  // beside the corners, then beside the middles of the edges
    Eigen::Vector3d there = Eigen::Vector3d::Unit(i % 3);
    if (i >= 3) there = (Eigen::Vector3d::Ones() - there) / 2;
    const Eigen::Vector2d x = point_in(mesh, t, 0.98 * there + Eigen::Vector3d::Constant(0.02 / 3));
    if (const double other = stiffness(x(0), x(1)); std::abs(other - kappa) > 1e-12 * kappa)
      throw Error(
          fmt::format("certificate: the stiffness is {:.6g} and {:.6g} on the triangle at ({:.6g}, {:.6g}); "
                      "accepted: one number per triangle, as of groups of surfaces",
                      kappa, other, x(0), x(1)));
  }
  return kappa;
}

/// A traction g on edge i of a triangle, from its corner (i + 1) % 3 (s = 0) to the next (s = 1): the means of g and of
/// g (s - 1/2), and |g - g_1| over the edge, g_1 = mean + 12 moment (s - 1/2).
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
    rest = std::sqrt(mesh.edge_length(mesh.triangle_edges(t, i)) * weights.dot(off.square().matrix()));
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
      if (!std::isfinite(values(q))) throw Error(fmt::format("load: f({:.6g}, {:.6g}) is not finite", x(0), x(1)));
    }
    mean_lambda = rule.points.transpose() * rule.weights.cwiseProduct(values);
    f = (12 * mean_lambda.array() - 3 * mean_lambda.sum()).matrix();
    square = rule.weights.dot(values.cwiseAbs2());
    const Eigen::VectorXd affine = rule.points * f;  // f_1 at the points
    rest2 = rule.weights.dot((values - affine).cwiseAbs2());
  }
  double of_basis(int i) const {
    return mean_lambda.sum() - 2 * mean_lambda(i);
  }  ///< of f phi_i, phi_i = 1 - 2 lambda_i
};

/// Where the affine part of f leaves out a tenth of it, the solver's rule may miss what is left.
bool needs_finer_rule(const LoadOn& load) { return load.rest2 > 1e-2 * load.square; }

/// The mean of the gap over an edge: Gauss's rule of two points on 16 parts.
double mean_gap(const Profile& gap, double from, double to) {
  constexpr int parts = 16;
  double sum = 0;
  for (int k = 0; k < parts; ++k)
    for (const double side : {-1.0, 1.0}) sum += gap(from + (to - from) * (k + 0.5 + side / std::sqrt(12.0)) / parts);
  return sum / (2 * parts);
}

double longest_edge(const TriangleMesh& mesh, int t) {
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, mesh.edge_length(mesh.triangle_edges(t, i)));
  return longest;
}

/// What the problem says of its own residual must be what the scene says: else the two are not one question.
void check_same_question(const VariationalInequality& problem, const Solution& solution, const Eigen::VectorXd& ours) {
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
    throw Error(
        fmt::format("certificate: the problem is not the scene's on this space: its forces differ by {:.1e} of "
                    "the largest; accepted: what assemble(scene, space) makes, its load above all",
                    off / size));
}

}  // namespace

FluxLaw layer_law(const Scene& scene) {
  if (const auto* stiff = std::get_if<StiffLayer>(&scene.layer()))
    return {true, stiff->s, 1 / stiff->s, class_parameter(*stiff) / stiff->s};
  if (const auto* thin = std::get_if<ThinLayer>(&scene.layer()))
    return {false, 1 / thin->epsilon, thin->epsilon, thin->epsilon};
  return {};
}

// sum_i f_i lambda_i (x - P_i) = f_1 x - sum_i f_i lambda_i P_i; the mean of f x is sum_i mean(f lambda_i) P_i
Eigen::MatrixX2d EquilibratedFlux::tau(const TriangleMesh& mesh, int t, const Eigen::MatrixX3d& barycentric) const {
  const FluxCell& here = cell[t];
  const Eigen::Matrix<double, 3, 2> corner = mesh.vertices(mesh.triangles.row(t), Eigen::all);
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
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;  // grad (lambda_j lambda_k) less its mean, turned
    const Eigen::MatrixX2d slope = (barycentric.col(j).array() - 1.0 / 3).matrix() * gradient.row(k) +
                                   (barycentric.col(k).array() - 1.0 / 3).matrix() * gradient.row(j);
    tau.col(0) += here.traction(i) * slope.col(1);
    tau.col(1) -= here.traction(i) * slope.col(0);
  }
  return tau;
}

EquilibratedFlux equilibrated_flux(const Scene& scene, const Result& result) {
  const Space& space = result.space;
  const VariationalInequality& problem = result.problem;
  const Solution& solution = result.solution;
  if ((problem.fixed_compliances.array() > 0).any()) return equilibrated_flux(scene, assemble_fixed_rows(result));
  check_request(scene, result);
  check_displacement(scene, space.mesh());
  static const Quadrature& fine_rule = triangle_rule(12);
  const TriangleMesh& mesh = space.mesh();
  const Quadrature &rule = load_rule(space.element()), &square_rule = radon_rule();  // tau^2 is of degree 4
  EquilibratedFlux flux;
  flux.law = layer_law(scene);
  flux.cell.resize(mesh.triangle_count());
  flux.traction_load = Eigen::VectorXd::Zero(mesh.vertex_count());
  Eigen::VectorXd assembled = Eigen::VectorXd::Zero(space.size());  // r with the load as the solver integrates it
  Eigen::VectorXd finer = Eigen::VectorXd::Zero(space.size());      // what a finer rule adds to the load
  int layer_row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    FluxCell& here = flux.cell[t];
    const double area = mesh.area(t);
    const auto unknown = space.cell_dofs().row(t);
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    const Eigen::Vector2d gradient = -2 * lambda.transpose() * Eigen::Vector3d(solution.u(unknown));
    if (mesh.region[t] == Region::layer) {
      here.law = flux.law;
      here.s = here.law.stiffness * gradient;
      if (here.law.split) here.s(1) = here.law.stiffness * solution.p(layer_row++);
    } else {
      const LoadOn usual(mesh, t, rule, scene.body().load);
      LoadOn load = usual;
      if (needs_finer_rule(usual)) {
        load = LoadOn(mesh, t, fine_rule, scene.body().load);
        for (int i = 0; i < 3; ++i) finer(unknown(i)) += area * (load.of_basis(i) - usual.of_basis(i));
      }
      here.f = load.f;
      const double kappa = constant_stiffness(scene.body().stiffness, mesh, t);
      here.law = {false, kappa, 1 / kappa, 1 / kappa};
      here.s = kappa * gradient;
      const double h = longest_edge(mesh, t);
      double oscillation = h / std::numbers::pi * std::sqrt(area * load.rest2);
      for (int i = 0; i < 3; ++i) {
        const Field* const g = traction_on(scene, mesh.edge_tag[mesh.triangle_edges(t, i)]);
        if (g == nullptr) continue;
        const TractionOn edge(mesh, t, i, *g);
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double length = mesh.edge_length(mesh.triangle_edges(t, i));
        here.traction(i) = -6 * edge.moment * length;
        flux.traction_load(mesh.triangles(t, j)) += length * (edge.mean / 2 - edge.moment);
        flux.traction_load(mesh.triangles(t, k)) += length * (edge.mean / 2 + edge.moment);
        finer(unknown(i)) += length * edge.mean;
        finer(unknown(j)) += 2 * length * edge.moment;
        finer(unknown(k)) -= 2 * length * edge.moment;
        oscillation += edge.rest * h * std::sqrt(length / area * (1 / std::numbers::pi + 1) / std::numbers::pi);
      }
      here.oscillation2 = oscillation * oscillation / kappa;
      flux.oscillation2 += here.oscillation2;
      for (int i = 0; i < 3; ++i) assembled(unknown(i)) -= area * usual.of_basis(i);
      const Eigen::MatrixX2d tau = flux.tau(mesh, t, square_rule.points);
      here.tau2 = area / kappa * square_rule.weights.dot(tau.rowwise().squaredNorm());
      flux.tau2 += here.tau2;
    }
    flux.norm2 += area * here.law.squared(here.s) + here.tau2;  // tau has mean zero on T
    for (int i = 0; i < 3; ++i) assembled(unknown(i)) -= 2 * area * here.s.dot(lambda.row(i));  // grad phi_i
  }
  for (int k = 0; k < static_cast<int>(scene.edges().size()); ++k) {
    const Field* const g = traction_on(scene, natural_group(k));
    if (g == nullptr) continue;
    const Eigen::VectorXd usual = edge_load(space, natural_group(k), *g);
    assembled -= usual;
    finer -= usual;
  }
  check_same_question(problem, solution, assembled);
  flux.residual = assembled - finer;

  flux.imbalance = flux.residual;
  for (const int e : problem.dirichlet_dofs) flux.imbalance(e) = 0;
  const auto contact = static_cast<Eigen::Index>(problem.contact.size());
  flux.lambda.resize(contact);
  flux.gap.resize(contact);
  for (Eigen::Index i = 0; i < contact; ++i) {
    const int e = problem.contact[i];  // the unknown of Crouzeix-Raviart is the edge
    flux.lambda(i) = std::max(flux.residual(e), 0.0);
    flux.imbalance(e) -= flux.lambda(i);
    flux.gap(i) =
        mean_gap(scene.contact()->gap, mesh.vertices(mesh.edges(e, 0), 0), mesh.vertices(mesh.edges(e, 1), 0));
  }
  flux.dual_energy = -flux.norm2 / 2 - flux.lambda.dot(flux.gap);
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
    flux.dual_energy +=
        flux.residual(problem.dirichlet_dofs[i]) * problem.dirichlet_values(static_cast<Eigen::Index>(i));
  return flux;
}

}  // namespace antilock
