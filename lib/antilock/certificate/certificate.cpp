// Notation. A = kappa in the body, one number per triangle (1 unless the scene says more); s
// diag(1, epsilon^-2) in the scaled layer (s = 1 in the paper), 1/epsilon in the thin one. |q| of a
// flux is counted by A^-1: |q|^2 / kappa, in the scaled layer (q_x^2 + epsilon^2 q_y^2) / s, so
// that nothing is divided by epsilon and epsilon = 0 is no exception. g the gap, u the exact
// solution, v a conforming function with v >= -g on Gamma_C and v = u on Gamma_D, where u is given,
// affine on every edge. G the traction, the flux given on other edges of the body; 0 where they are
// free. u_h, p any function of the Crouzeix-Raviart space and any layer stress; S_h = A grad u_h, s
// (d_x u_h, p) in the scaled layer; r = A1 u + B' M p - b, one force per edge E, the traction a
// part of b.
//
// 1. The flux. On a body triangle T with centroid c and vertices P_i
//
//     sigma = S_h + tau,   tau = -f_T (x - 3 c) / 2 - mean_T(f x) - 1/3 sum_i f_i lambda_i (x - P_i) + tau_G;
//
// sigma = S_h in the layer. The first two terms are Marini's (1985): their flux through the edge E
// is -int_T f phi_E, phi_E the basis function of E, and their divergence -f_T. The third one is
// new: lambda_i (x - P_i) has no flux through any edge and the divergence 3 lambda_i - 1. With f_i
// = 12 mean_T(f lambda_i) - 3 f_T, the vertex values of the L2 projection f_1 of f on the affine
// functions, -div sigma = f_T + sum_i f_i (3 lambda_i - 1) / 3 = f_1, since the f_i have the mean
// f_T. The fourth is for the edges E of T under a traction. Let G_1 = mean_E(G) + 12 m (s - 1/2) be
// the projection of G on the affine functions of E, s from 0 at its end P_j to 1 at P_k, m the mean
// of G (s - 1/2). The field curl(lambda_j lambda_k) has no divergence and flows through E alone,
// with (1 - 2 s) / |E|. So
//
//     tau_G = sum_E c_E (curl(lambda_j lambda_k) - its mean over T),   c_E = -6 m |E|,   curl = (d_y, -d_x),
//
// makes sigma.n affine on E with the slope of G_1, and constant on all other edges; div sigma is as
// before. All of tau has mean zero on T (means of lambda_i x are (3 c + P_i) / 12), and b has the
// terms int f phi_E and int G phi_E of all phi_E of T, affine on T and on its edges. So row E of r
// = A1 u + B' M p - b says that the constants of sigma.n, from either side of E, sum up to r_E /
// |E|, and to that beside mean_E(G) under a traction. For every w of H1, with lambda_E = r_E^+ on
// Gamma_C, r1 = r - lambda on the free edges,
//
//     (sigma, grad w) = (f_1, w) + <G_1, w> + sum_E lambda_E mean_E(w) + R(w) + sum_{Gamma_D} r_E mean_E(w),    (a)
//     R(w) = sum_E r1_E mean_E(w).
//
// 2. What stays small. (f - f_1, w) + <G - G_1, w> <= osc |w|_a,
//
//     osc^2 = sum_T kappa^-1 ((h_T / pi) |f - f_1|_T + sum_E C_E |G - G_1|_E)^2,   C_E^2 = h_T^2 (1/pi^2 + 1/pi) |E| / |T|:
//
// both differences have mean zero, so that w may be replaced by z = w - mean_T(w), and |z|_T <=
// (h_T / pi) |grad w|_T is Poincare's inequality (Payne and Weinberger 1960). For |z|_E integrate
// div((x - P) z^2) over T, P the corner opposite E: (x - P).n is 2 |T| / |E| on E and 0 on the
// other edges, so (2 |T| / |E|) |z|_E^2 = 2 |z|_T^2 + 2 int z (x - P).grad z <= 2 |z|_T^2 + 2 h_T
// |z|_T |grad z|_T. And R(w) = r1' I_h w, I_h the interpolation by means over edges: its gradients
// are the means of grad w, so |I_h w|_a <= |w|_a, and for w = 0 on Gamma_D, with A_delta = A1 +
// delta^-1 B' M B, delta >= epsilon^2, on the free unknowns: |R(w)| <= rho |w|_a, rho^2 = r1'
// A_delta^-1 r1. Set q = osc + rho.
//
// 3. The bounds. Put e = A^-1/2 (A grad u - S_h), and w, t the same with A grad v and sigma in
// place of A grad u. The inequality for u with v, and (a) with u - v, which is 0 on Gamma_D, give
//
//     (e - t, e - w) <= (f - f_1, u - v) + <G - G_1, u - v> - sum_E lambda_E mean_E(u - v) - R(u - v) <= C + q |e - w|,
//     C = sum_E lambda_E mean_E(v + g) >= 0,
//
// since lambda_E >= 0 and u + g >= 0. With m = |w - t| = |A grad v - sigma|:
// - Y = |e - w| = |u - v|_a: (e - t, e - w) = Y^2 + (w - t, e - w), so Y^2 <= (m + q) Y + C.
// - X = |e - (w + t) / 2|: (e - t, e - w) = X^2 - m^2 / 4 and |e - w| <= X + m / 2, so
//   (X - q / 2)^2 <= (m + q)^2 / 4 + C. That is the midpoint of the two fluxes.
// - |e| <= X + |w + t| / 2, and |w + t| = m: on each triangle of the body w is constant and t, of
//   tau, has mean zero, so that they are orthogonal; in the layer t = 0.
//
//     |u - v|_a                         <= (m + q) / 2 + ((m + q)^2 / 4 + C)^(1/2)
//     |A grad u - (sigma + A grad v)/2| <= q / 2 + ((m + q)^2 / 4 + C)^(1/2)
//     |A grad u - S_h|                  <= (m + q) / 2 + ((m + q)^2 / 4 + C)^(1/2), the first bound once more
//
// 4. No mesh intersection. Expand m^2 and use (a) with v:
//
//     m^2 / 2 + C = J(v) - D - R(v),   D = -|sigma|^2 / 2 - sum_E lambda_E mean_E(g) + sum_{Gamma_D} r_E mean_E(u_D).
//
// The terms (f - f_1, v) and <G - G_1, v> drop out: v is affine on the body's triangles, which are
// those of sigma. In the layer v may live on columns of its own: of them only its energy and its
// means over the edges of the other mesh are needed.
//
// 5. The energy. For v = u the identity reads J(u) = D + m_u^2 / 2 + C_u - (f - f_1, u) - <G - G_1,
// u> + R(u), where C_u >= 0. With v of the bound above, u may be replaced by u - v in both, and
// R(u) = R(v) + R(u - v), hence
//     D + R(v) - q |u - v|_a <= J(u) <= J(v).
#include "antilock/certificate/certificate.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "antilock/core/error.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock {
namespace {

void check_sizes(const TriangleMesh& mesh, const FluxLaw& law, const ConformingCompanion& v) {
  const auto layer = std::count(mesh.region.begin(), mesh.region.end(), Region::layer);
  if (v.at_vertices.size() != mesh.vertex_count() ||
      (law.split && !v.layer && v.stress.size() != layer))
    throw Error(
        "certificate: the companion has another number of values than the mesh has vertices or "
        "layer cells");
  if (!v.at_vertices.allFinite() || !v.stress.allFinite())
    throw Error("certificate: the companion is not finite");
}

/// The mean of v over an edge of the mesh.
double mean_on(const TriangleMesh& mesh, int e, const ConformingCompanion& v) {
  const int a = mesh.edges(e, 0);
  const int b = mesh.edges(e, 1);
  const auto is_of_body = [&](int t) { return t >= 0 && mesh.region[t] == Region::body; };
  const bool in_layer =
      !is_of_body(mesh.edge_triangles(e, 0)) && !is_of_body(mesh.edge_triangles(e, 1));
  if (v.layer && in_layer) return v.layer->mean(mesh.vertices.row(a), mesh.vertices.row(b));
  return (v.at_vertices(a) + v.at_vertices(b)) / 2;
}

double value_at(const TriangleMesh& mesh, int vertex, const ConformingCompanion& v) {
  if (!v.layer || !(mesh.vertices(vertex, 1) < 0)) return v.at_vertices(vertex);
  return v.layer->value(mesh.vertices.row(vertex).transpose());
}

/// Throws unless v has, at the ends of fixed edges, the values that the scene prescribes, and the
/// problem fixes the means of these values.
void check_prescribed(const Scene& scene, const Result& result, const ConformingCompanion& v) {
  const VariationalInequality& problem = result.problem;
  const TriangleMesh& mesh = result.space.mesh();
  const Eigen::VectorXd prescribed = dirichlet_vertex_values(scene, mesh);
  const double scale =
      std::max(prescribed.cwiseAbs().maxCoeff(), v.at_vertices.cwiseAbs().maxCoeff());
  const auto differs = [&](double value, double asked) {
    return !(std::abs(value - asked) <= 1e-11 * scale);
  };
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i) {
    const auto ends = mesh.edges.row(problem.dirichlet_dofs[i]);
    for (const int vertex : {ends(0), ends(1)}) {
      const double found = value_at(mesh, vertex, v);
      if (differs(found, prescribed(vertex)))
        throw Error(fmt::format("certificate: the companion is {} at {}, where {} is prescribed",
                                found, mesh.location_text(vertex), prescribed(vertex)));
    }
    const double value = problem.dirichlet_values(static_cast<Eigen::Index>(i));
    const double mean = prescribed(ends).mean();
    if (differs(value, mean))
      throw Error(
          fmt::format("certificate: {} is fixed between {} and {}, where the scene prescribes the "
                      "mean {}; accepted: the "
                      "scene's values",
                      value, mesh.location_text(ends(0)), mesh.location_text(ends(1)), mean));
  }
}

/// Throws unless v >= -g between the vertices, too, by samples: else the proof does not start.
void check_admissible(const UnilateralContact& contact, const TriangleMesh& mesh,
                      const Eigen::VectorXd& v) {
  constexpr int samples = 8;  // of those of admissible_bounds
  const double scale = v.cwiseAbs().maxCoeff();
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const int from = mesh.edges(e, 0);
    const int to = mesh.edges(e, 1);
    for (int k = 0; k <= samples; ++k) {
      const double theta = static_cast<double>(k) / samples;
      const double x = (1 - theta) * mesh.vertices(from, 0) + theta * mesh.vertices(to, 0);
      const double gap = contact.gap(x);
      const double above = (1 - theta) * v(from) + theta * v(to) + gap;
      if (!(above >= -1e-9 * std::max(scale, std::abs(gap))))
        throw Error(fmt::format(
            "certificate: the companion is {:.1e} below the obstacle at x = {:.6g}; accepted: a "
            "function of K, as admissible_bounds make it",
            -above, x));
    }
  }
}

/// Sums over the triangles, in the notation of the derivation.
struct Sums {
  double norm2 = 0;      ///< |v|_a^2
  double work = 0;       ///< of f and of the traction on v
  double mismatch2 = 0;  ///< m^2 of the triangles that v shares
};

/// |v|_a^2 of the columns.
double column_norm2(const ExtrudedP1Function& columns, const FluxLaw& law) {
  double norm2 = 0;
  const int first = columns.first_triangle();
  for (int t = first; t < columns.mesh().triangle_count(); ++t)
    norm2 += columns.mesh().area(t) * law.squared(law.stiffness * columns.flux_of(t - first));
  return norm2;
}

/// Half of m^2 on a triangle of the layer, by quadrature, where v lives on columns of its own. It
/// is for the indicator alone.
double column_mismatch(const TriangleMesh& mesh, int t, const FluxCell& here,
                       const ExtrudedP1Function& columns) {
  const Quadrature& midpoints = midpoint_rule();
  double half = 0;
  for (Eigen::Index q = 0; q < midpoints.weights.size(); ++q) {
    // a little inside of the triangle: its edges may be edges of columns, where the flux jumps
    const Eigen::Vector3d inside =
        0.98 * midpoints.points.row(q).transpose() + Eigen::Vector3d::Constant(0.02 / 3);
    const Eigen::Vector2d off =
        here.law.stiffness * columns.flux(point_in(mesh, t, inside)) - here.s;
    half += mesh.area(t) * midpoints.weights(q) * here.law.squared(off) / 2;
  }
  return half;
}

/// Sums over all triangles, and adds m^2 / 2 + osc^2 of each to its indicator.
Sums sums_over_triangles(const TriangleMesh& mesh, const EquilibratedFlux& flux,
                         const ConformingCompanion& v, Eigen::VectorXd& indicator) {
  Sums sums;
  sums.work = flux.traction_load.dot(v.at_vertices);
  if (v.layer) sums.norm2 = column_norm2(*v.layer, flux.law);
  int row = 0;  // of the layer
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const FluxCell& here = flux.cell[t];
    const double area = mesh.area(t);
    const bool layer = mesh.region[t] == Region::layer;
    double mismatch2 = 0;
    if (layer && v.layer) {
      indicator(t) += column_mismatch(mesh, t, here, *v.layer);
    } else {
      const Eigen::Vector2d of_v = v.flux(mesh, t, row, here.law);
      sums.norm2 += area * here.law.squared(of_v);
      mismatch2 = area * here.law.squared(of_v - here.s) + here.tau2;  // tau has mean zero on T
      for (int i = 0; i < 3; ++i)  // mean(f lambda_i) = (f_i + 3 f_T) / 12
        sums.work += area * (here.f(i) + here.f.sum()) / 12 * v.at_vertices(mesh.triangles(t, i));
    }
    if (layer) ++row;
    sums.mismatch2 += mismatch2;
    indicator(t) += mismatch2 / 2 + here.oscillation2;
  }
  return sums;
}

/// C: the work of the contact forces on v + g. Each edge's share is added to the indicator of its
/// triangle.
double contact_work(const Result& result, const EquilibratedFlux& flux,
                    const ConformingCompanion& v, Eigen::VectorXd& indicator) {
  const TriangleMesh& mesh = result.space.mesh();
  double sum = 0;
  for (std::size_t i = 0; i < result.problem.bounds.unknowns.size(); ++i) {
    const int e = result.problem.bounds.unknowns[i];
    const auto place = static_cast<Eigen::Index>(i);
    if (flux.lambda(place) == 0) continue;
    const double work = std::max(flux.lambda(place) * (mean_on(mesh, e, v) + flux.gap(place)), 0.0);
    sum += work;
    indicator(mesh.edge_triangles(e, 0)) += work;
  }
  return sum;
}

/// R(v), without the forces that are round-off: that spares their means over columns.
double unbalanced_work(const TriangleMesh& mesh, const EquilibratedFlux& flux,
                       const ConformingCompanion& v) {
  const double round_off = 1e-13 * flux.residual.lpNorm<Eigen::Infinity>();
  double work = 0;
  for (Eigen::Index e = 0; e < flux.imbalance.size(); ++e)
    if (std::abs(flux.imbalance(e)) > round_off)
      work += flux.imbalance(e) * mean_on(mesh, static_cast<int>(e), v);
  return work;
}

/// m^2, from the triangles and from the identity of section 4, which must agree. `scale` is the
/// size of the energies.
double checked_mismatch2(const Sums& sums, double by_identity, bool own_columns, double scale) {
  if (!(by_identity >= -1e-12 * scale))
    throw Error(fmt::format(
        "certificate: round-off has eaten the mismatch, {:.1e} of the energy; accepted: values at "
        "the vertices that agree with the fixed ones, cells far from degenerate",
        by_identity / scale));
  // on columns of its own v shares no triangle of the layer: the identity alone has their part
  if (own_columns) return std::max(by_identity, sums.mismatch2);
  const double difference = std::abs(by_identity - sums.mismatch2);
  if (difference > 1e-10 * scale)
    throw Error(fmt::format(
        "certificate: the companion does not have the fixed values: the two sides of the identity "
        "differ by {:.1e} of the energy",
        difference / scale));
  return sums.mismatch2;
}

/// The three bounds of section 3, from m, q = osc + rho and C.
void add_bounds(Certificate& certificate) {
  const double q = certificate.oscillation + certificate.algebraic_residual_norm;
  const double m = certificate.constitutive_error;
  const double root = std::sqrt((m + q) * (m + q) / 4 + certificate.contact_work);
  certificate.displacement = (m + q) / 2 + root;
  certificate.stress = q / 2 + root;
  certificate.gradient = certificate.displacement;
}

/// The share of the indicators that is the layer's.
double layer_share(const TriangleMesh& mesh, const Eigen::VectorXd& indicator) {
  double layer = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer) layer += indicator(t);
  return layer > 0 ? layer / indicator.sum() : 0;
}

/// Throws unless v and w have the sizes of one mesh.
void check_one_mesh(const ConformingCompanion& v, const Result& w) {
  const VariationalInequality& problem = w.problem;
  if (v.layer)
    throw Error(
        "certificate: the companion has columns of its own; accepted: one on the mesh, as "
        "local_companion with "
        "on_mesh, "
        "p1_companion or an extruded mesh make it");
  const Eigen::Index per_triangle = v.stress.size() > 0 ? problem.b.rows() / v.stress.size() : 0;
  const bool same_unknowns =
      w.solution.u.size() == w.space.size() && problem.size() == w.space.size();
  const bool same_rows =
      w.solution.p.size() == problem.b.rows() && per_triangle * v.stress.size() == problem.b.rows();
  if (v.at_vertices.size() != w.space.mesh().vertex_count() || !same_unknowns || !same_rows)
    throw Error(fmt::format(
        "certificate: the companion has {} values and {} stresses, the solution {} and {}; "
        "accepted: both on one mesh",
        v.at_vertices.size(), v.stress.size(), w.solution.u.size(), w.solution.p.size()));
}

}  // namespace

double Certificate::relative(Quantity of) const {
  if (bound(of) == 0) return 0;
  const double norm_of_u = std::max(norm - displacement, midpoint_norm - stress);
  return norm_of_u > 0 ? bound(of) / norm_of_u : std::numeric_limits<double>::infinity();
}

double residual_norm(const VariationalInequality& problem, const EquilibratedFlux& flux,
                     PenalisedCholesky* factor) {
  std::optional<PenalisedCholesky> own;
  if (factor == nullptr) factor = &own.emplace(problem);
  factor->check_fits(problem);
  if (factor->delta() < problem.compliance)
    throw Error(
        "certificate: the factor has a smaller penalty than the compliance; accepted: at least as "
        "large");
  const Eigen::VectorXd r1 = flux.imbalance(factor->ordering().dof);
  if (ConstrainedCholesky* const held = factor->sparse_factor())
    held->constrain(std::vector<char>(r1.size(), 0));  // the whole K
  return std::sqrt(std::max(0.0, r1.dot(factor->solve(r1))));
}

Certificate certify(const Scene& scene, const Result& result, const CertificateOptions& options) {
  const TriangleMesh& mesh = result.space.mesh();
  const EquilibratedFlux flux = equilibrated_flux(scene, result);
  ConformingCompanion made;
  if (options.companion == nullptr) made = local_companion(scene, result);
  const ConformingCompanion& v = options.companion != nullptr ? *options.companion : made;
  check_sizes(mesh, flux.law, v);

  Certificate certificate;
  certificate.oscillation = std::sqrt(flux.oscillation2);
  certificate.algebraic_residual_norm = residual_norm(result.problem, flux, options.factor);
  certificate.indicator = Eigen::VectorXd::Zero(mesh.triangle_count());
  const Sums sums = sums_over_triangles(mesh, flux, v, certificate.indicator);
  certificate.norm = std::sqrt(sums.norm2);
  check_prescribed(scene, result, v);
  if (scene.contact() && v.layer) check_admissible(*scene.contact(), v.layer->mesh(), v.layer->v());
  if (scene.contact() && !v.layer) check_admissible(*scene.contact(), mesh, v.at_vertices);
  certificate.contact_work = contact_work(result, flux, v, certificate.indicator);

  const double work_of_r = unbalanced_work(mesh, flux, v);  // R(v)
  certificate.energy_upper = sums.norm2 / 2 - sums.work;
  const double scale = sums.norm2 + flux.norm2 + std::abs(sums.work);
  const double by_identity =
      2 * (certificate.energy_upper - flux.dual_energy - work_of_r - certificate.contact_work);
  const double mismatch2 = checked_mismatch2(sums, by_identity, v.layer.has_value(), scale);
  certificate.constitutive_error = std::sqrt(mismatch2);
  certificate.midpoint_norm =
      std::sqrt(std::max(2 * sums.norm2 + 2 * flux.norm2 - mismatch2, 0.0)) / 2;
  add_bounds(certificate);
  const double q = certificate.oscillation + certificate.algebraic_residual_norm;
  certificate.energy_lower = flux.dual_energy + work_of_r - q * certificate.displacement;
  certificate.layer_share = layer_share(mesh, certificate.indicator);
  return certificate;
}

double certified_distance(const Certificate& certificate, const ConformingCompanion& v,
                          const Result& w) {
  const Space& space = w.space;
  const VariationalInequality& problem = w.problem;
  if ((problem.fixed_compliances.array() > 0).any())
    return certified_distance(certificate, v, assemble_fixed_rows(w));
  check_one_mesh(v, w);
  const TriangleMesh& mesh = space.mesh();
  const Eigen::MatrixX3d nodes = space.element().support_points();
  Eigen::VectorXd u = w.solution.u;  // those of w - v
  Eigen::VectorXd p = w.solution.p;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3d corners = v.at_vertices(mesh.triangles.row(t));
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
      const int dof = space.cell_dofs()(t, i);
      u(dof) = w.solution.u(dof) - nodes.row(i).dot(corners);
    }
  }
  const Eigen::Index per_triangle = v.stress.size() > 0 ? p.size() / v.stress.size() : 0;
  for (Eigen::Index row = 0; row < p.size(); ++row) p(row) -= v.stress(row / per_triangle);
  const double stiff = problem.compliance * p.cwiseAbs2().dot(problem.m);
  return certificate.displacement + std::sqrt(u.dot(problem.a1 * u) + stiff);
}

}  // namespace antilock
