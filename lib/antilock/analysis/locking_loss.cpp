// The energy that a locked layer has lost, without a second solve of the same size. The sections
// are those of tutorials/guides/locking_loss.md, which proves each step.
//
//     lower_bound = J(u_h) - J(v') <= J(u_h) - J(u)   for v' in K                  (section 1)
//     J(u_h + w) - J(u_h) = d' S d / 2 - G' d         body, d = w on Sigma          (section 2)
//     J of the columns >= J                           trapezoidal rule in y         (section 3)
//     estimate = layer_excess - min m                 v: a small inequality for d   (section 4)
//     J(v') - J(v) = a(v, d) + a(d, d) / 2 - L(d)     d = v' - v, affine, lifts     (section 5)
//     reference = max(J(v_0) - J(v), |v - v_0|^2 / 2)                               (section 6)
//
// Beside prescribed values U the energies of u_h and v are of size s U^2, and the loss may be far
// less than the round-off of that. So all energies are differences to that of v_0, whose layer does
// not move: with w = u_h - v_0, J(v_0 + w) - J(v_0) = a(w, v_0 + w / 2) - L(w) (section 9).
#include "antilock/analysis/locking_loss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/KroneckerProduct>

#include "antilock/analysis/detail/body_correction.hpp"
#include "antilock/analysis/detail/interface_line.hpp"
#include "antilock/analysis/detail/layer_columns.hpp"
#include "antilock/analysis/detail/lift.hpp"
#include "antilock/core/error.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

/// u_h and Sigma: the data of the comparison.
struct Comparison {
  const Scene& scene;
  const Space& space;
  const VariationalInequality& problem;
  const Solution& solution;
  const StiffLayer* stiff;  ///< null for the layer of (22)
  double epsilon;
  double s;  ///< the stiffness of the layer; 1 in (22)
  InterfaceLine sigma;
  Eigen::VectorXd on_sigma;   ///< u_h, per place
  std::vector<char> in_body;  ///< per unknown of u_h
  std::vector<char> held;     ///< per place: whether the value there is prescribed
  double ulp;                 ///< of the largest |u_h|
};

std::vector<char> dofs_in_body(const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  std::vector<char> in_body(space.size(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::body) continue;
    for (const int dof : space.cell_dofs().row(t)) in_body[dof] = 1;
  }
  return in_body;
}

/// Per place on Sigma: whether its value is prescribed.
std::vector<char> held_places(const InterfaceLine& sigma, const VariationalInequality& problem) {
  std::vector<char> held(sigma.size(), 0);
  for (const int dof : problem.dirichlet_dofs)
    if (sigma.place[dof] >= 0) held[sigma.place[dof]] = 1;
  return held;
}

/// Whether a value is prescribed on Sigma at x.
bool is_prescribed_on_sigma(const Comparison& c, double x) {
  const double slack = 1e-6 * c.sigma.length;  // files with few digits place a vertex to 1e-8
  for (int place = 0; place < c.sigma.size(); ++place)
    if (c.held[place] && std::abs(c.sigma.x(place) - x) <= slack) return true;
  return false;
}

/// v is prescribed and constant in y below prescribed values on Sigma. So each value that is
/// prescribed in the layer must be one of these. Otherwise v would not be in K.
void require_constant_sides(const Comparison& c) {
  const double tolerance = 1e-9 * c.on_sigma.cwiseAbs().maxCoeff();
  for (std::size_t k = 0; k < c.problem.dirichlet_dofs.size(); ++k) {
    const int dof = c.problem.dirichlet_dofs[k];
    if (c.in_body[dof]) continue;
    const double x = c.space.dof_coordinates()(dof, 0);
    const double on_sigma = piecewise_linear(c.sigma.x, c.on_sigma, x);
    const double more = c.problem.dirichlet_values(static_cast<Eigen::Index>(k)) - on_sigma;
    if (!is_prescribed_on_sigma(c, x) || std::abs(more) > tolerance)
      throw Error(
          "lost energy: accepted: a layer whose sides have the value of Sigma's end above them");
  }
}

/// J of the columns has no term for a traction or a spring at the sides of the layer.
void require_free_sides(const Scene& scene, const TriangleMesh& mesh) {
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const EdgeTag tag = mesh.edge_tag[e];
    if (tag.group < 0 || is_dirichlet(tag)) continue;
    if (mesh.region[mesh.edge_triangles(e, 0)] != Region::layer) continue;
    if (scene.edges()[tag.group].kind != BoundaryCondition::Kind::free)
      throw Error("lost energy: accepted: no traction and no spring on the layer");
  }
}

Comparison comparison_for(const Scene& scene, const Result& result) {
  const Space& space = result.space;
  const auto epsilon = scene.epsilon();
  const bool has_layer = epsilon && scene.layer_depth() > 0;
  if (!has_layer || !space.element().conforming() || space.mesh().curved())
    throw Error("lost energy: accepted: P1 to P6 on a mesh with a layer below y = 0");
  Comparison c{
      .scene = scene,
      .space = space,
      .problem = result.problem,
      .solution = result.solution,
      .stiff = std::get_if<StiffLayer>(&scene.layer()),
      .epsilon = *epsilon,
      .s = 1,
      .sigma = interface_line(space),
      .on_sigma = {},
      .in_body = dofs_in_body(space),
      .held = {},
      .ulp = std::numeric_limits<double>::epsilon() * result.solution.u.cwiseAbs().maxCoeff()};
  if (c.stiff != nullptr) c.s = c.stiff->s;
  c.on_sigma = c.solution.u(c.sigma.dof);
  c.held = held_places(c.sigma, c.problem);
  require_constant_sides(c);
  require_free_sides(scene, space.mesh());
  return c;
}

/// The value of v_0 at the left end of Sigma.
double left_end_of_v0(const Comparison& c) {
  if (c.held.front()) return c.on_sigma(0);
  if (c.held.back()) return c.on_sigma(c.sigma.size() - 1);
  return c.on_sigma.mean();
}

/// v_0 at all unknowns of u_h. In the layer, where alone it counts, d_y v_0 = 0. It is affine
/// between prescribed values at the outer ends of Sigma, and constant towards an end that is free.
Eigen::VectorXd function_without_motion(const Comparison& c) {
  const int last = c.sigma.size() - 1;
  const double left = left_end_of_v0(c);
  const double right = c.held.back() ? c.on_sigma(last) : left;
  const double slope = (right - left) / (c.sigma.x(last) - c.sigma.x(0));
  return left + slope * (c.space.dof_coordinates().col(0).array() - c.sigma.x(0));
}

/// u_h against v_0 in the layer, and the forces that u_h leaves in the body.
struct Remainders {
  /// In the layer, J(u_h) - J(v_0), by the triangles of the mesh.
  double layer_energy = 0;
  /// The round-off of layer_energy.
  double round_off = 0;
  Eigen::VectorXd body_force;  ///< N values
  SparseMatrix body_form;      ///< N x N: A1 without the layer's part
};

Remainders remainders(const Comparison& c, const Eigen::VectorXd& v0) {
  const VariationalInequality& problem = c.problem;
  Eigen::Vector2d stiffness = Eigen::Vector2d::Constant(1 / c.epsilon);
  if (c.stiff != nullptr) stiffness = Eigen::Vector2d(c.s, 0);  // (d_y u)^2 is in B
  const SparseMatrix layer_form = layer_form_at(c.sigma, c.space, stiffness);
  Eigen::VectorXd layer_load = Eigen::VectorXd::Zero(c.space.size());
  if (c.stiff != nullptr && c.stiff->load)
    layer_load = load_vector(c.space, c.stiff->load, Region::layer);

  const Eigen::VectorXd w = c.solution.u - v0;
  const Eigen::VectorXd middle = v0 + w / 2;
  Remainders left;
  left.body_form = problem.a1 - layer_form;
  left.body_force = problem.load - layer_load - left.body_form * c.solution.u;
  left.layer_energy =
      problem.compliance * c.solution.p.cwiseAbs2().dot(problem.m) / 2 - w.dot(layer_load);
  for (int dof = 0; dof < c.space.size(); ++dof) {
    left.layer_energy += w(dof) * (c.in_body[dof] ? layer_form : problem.a1).col(dof).dot(middle);
    if (c.in_body[dof]) continue;
    left.body_force(dof) = 0;
    // a row of A1 has sum 0, and leaves of values U some ulp of U times its entries
    left.round_off += 2 * c.ulp * std::abs(w(dof)) * problem.a1.coeff(dof, dof);
  }
  return left;
}

/// The forms and the load of the problem for v, with the unknowns line by line: Sigma, then the R
/// lines of the columns below it.
void add_forms(VariationalInequality& strip, const Comparison& c, const LayerColumns& columns,
               const CondensedBody& body) {
  const int size = (columns.rows + 1) * c.sigma.size();
  SparseMatrix on_sigma_form = body.form.sparseView();
  on_sigma_form.conservativeResize(size, size);
  strip.a1 = Eigen::kroneckerProduct(SparseMatrix(columns.depth.asDiagonal()), columns.a_x);
  strip.a1 += on_sigma_form;
  strip.b = Eigen::kroneckerProduct(columns.difference, columns.value);
  strip.a1.makeCompressed();
  strip.b.makeCompressed();
  strip.m = columns.weight.replicate(columns.rows, 1) / columns.rows;
  strip.compliance = c.epsilon * c.epsilon;
  strip.load = Eigen::kroneckerProduct(columns.depth, columns.a_x * -c.on_sigma);
  strip.load.head(c.sigma.size()) += body.force;
}

/// Fixes the unknowns below prescribed values, and returns the others at the bottom of the columns.
/// These are bounded where u_h is; otherwise the list is empty.
std::vector<int> divide_dofs(VariationalInequality& strip, const Comparison& c,
                             const LayerColumns& columns, const CondensedBody& body) {
  const int n = c.sigma.size();
  std::vector<int> bounded;
  for (int k = 0; k < (columns.rows + 1) * n; ++k) {
    const bool held_in_body = k < n && body.held[k];
    const bool at_bottom = k >= columns.rows * n;
    if (c.held[k % n] || held_in_body)
      strip.dirichlet_dofs.push_back(k);
    else if (at_bottom && !c.problem.bounds.unknowns.empty())
      bounded.push_back(k);
  }
  strip.dirichlet_values =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(strip.dirichlet_dofs.size()));
  return bounded;
}

/// The bounds of u_h, interpolated to the unknowns `bounded` at the bottom of the columns, as
/// bounds of v - u_h. `base` is u_h - v_0 on Sigma. The function that is interpolated is the
/// distance to v_0.
Bounds bounds_of_strip(const std::vector<int>& bounded, const Comparison& c,
                       const LayerColumns& columns, const Eigen::VectorXd& v0,
                       const Eigen::VectorXd& base) {
  const Bounds& of_u = c.problem.bounds;
  const Eigen::VectorXd contact_x = c.space.dof_coordinates().col(0)(of_u.unknowns);
  const auto interpolated = [&](const Eigen::VectorXd& limits) {
    const Eigen::VectorXd above_v0 = limits - v0(of_u.unknowns);
    Eigen::VectorXd here(static_cast<Eigen::Index>(bounded.size()));
    for (Eigen::Index k = 0; k < here.size(); ++k) {
      const int place = bounded[k] - columns.rows * c.sigma.size();
      here(k) = piecewise_linear(contact_x, above_v0, c.sigma.x(place)) - base(place);
    }
    return here;
  };
  Bounds bounds = Bounds::lower_on(bounded, interpolated(of_u.lower));
  if (of_u.has_upper_bounds()) bounds.upper = interpolated(of_u.upper);
  return bounds;
}

/// The problem for v, in differences to u_h on Sigma, constant in y.
struct Strip {
  VariationalInequality problem;
  int rows;  ///< R, of the columns
  /// In the layer, the energy of u_h on the mesh less that of its trace in the columns.
  double layer_excess;
};

Strip strip_for(const Comparison& c, const Remainders& left, const Eigen::VectorXd& v0) {
  const int n = c.sigma.size();
  const LayerColumns columns = layer_columns(c.space, c.sigma, c.epsilon, c.s);
  const RowMatrix hats = correction_space(c.space, c.sigma, c.in_body);
  const CondensedBody body =
      condensed_body(left.body_form, left.body_force, c.problem.dirichlet_dofs, hats, n);
  const Eigen::VectorXd base = c.solution.u(c.sigma.dof) - v0(c.sigma.dof);
  Strip strip{{}, columns.rows, left.layer_energy};
  VariationalInequality& problem = strip.problem;
  add_forms(problem, c, columns, body);
  strip.layer_excess -= base.dot(columns.a_x * (c.on_sigma - base / 2));
  if (c.stiff != nullptr && c.stiff->load)
    for (const ColumnLoad& at : column_loads(c.space, c.sigma, columns.rows, c.stiff->load)) {
      strip.layer_excess += at.force.dot(base(*at.edge));
      problem.load.segment(at.row * n, n)(*at.edge) += (1 - at.lower_share) * at.force;
      problem.load.segment((at.row + 1) * n, n)(*at.edge) += at.lower_share * at.force;
    }
  const std::vector<int> bounded = divide_dofs(problem, c, columns, body);
  problem.bounds = bounds_of_strip(bounded, c, columns, v0, base);
  return strip;
}

/// J(v') - J(v); infinite where there is no v'. `solution` and `base` are v - u_h and u_h - v_0.
double price_of_lifting(const Comparison& c, const Strip& strip, const Solution& solution,
                        const Eigen::VectorXd& base) {
  constexpr int samples = 33;
  const EdgeBasis basis = edge_basis(c.space.element(), Eigen::VectorXd::LinSpaced(samples, 0, 1));
  const Eigen::VectorXd moves = solution.u.tail(c.sigma.size());  // at the bottom
  const Eigen::VectorXd v = c.on_sigma + moves;
  // what the solvers leave of v - v_0, with room
  const double tolerance = 1e-10 * (base + moves).cwiseAbs().maxCoeff() + 20 * c.ulp;
  const Eigen::VectorXd lift =
      lift_into_k(c.sigma, basis, v, *c.scene.contact(), c.held, tolerance);
  const Eigen::VectorXd d = lift.replicate(strip.rows + 1, 1);
  const VariationalInequality& problem = strip.problem;
  if (!lift.allFinite() || !d(problem.dirichlet_dofs).isZero(0))
    return std::numeric_limits<double>::infinity();
  return d.dot(problem.a1 * (solution.u + d / 2) - problem.load);
}

}  // namespace

double LockingLoss::share(double energy) const {
  return reference > 0 ? std::clamp(energy / reference, 0.0, 1.0) : 0;
}

LockingLoss locking_loss(const Scene& scene, const Result& result) {
  require_triangles(result.space.mesh(), "locking loss");
  if ((result.problem.fixed_compliances.array() > 0).any())
    return locking_loss(scene, assemble_fixed_rows(result));
  const Comparison c = comparison_for(scene, result);
  const Eigen::VectorXd v0 = function_without_motion(c);
  const Remainders left = remainders(c, v0);
  const Strip strip = strip_for(c, left, v0);
  const VariationalInequality& problem = strip.problem;
  LockingLoss loss;
  if (problem.free_count() == 0) return loss;

  const Solution solution = active_set(problem);  // v - u_h
  const Eigen::VectorXd base = c.solution.u(c.sigma.dof) - v0(c.sigma.dof);
  const Eigen::VectorXd to_v0 = (-base).replicate(strip.rows + 1, 1);  // v_0 - u_h
  const double energy_of_v = energy(problem, solution);
  const double energy_of_v0 = to_v0.dot(problem.a1 * to_v0) / 2 - problem.load.dot(to_v0);
  loss.estimate = strip.layer_excess - energy_of_v;
  loss.lower_bound = loss.estimate;

  const Eigen::VectorXd motion = solution.u - to_v0;  // v - v_0
  const double stiff_energy = problem.compliance * solution.p.cwiseAbs2().dot(problem.m) / 2;
  const double motion_energy = motion.dot(problem.a1 * motion) / 2 + stiff_energy;
  loss.reference = std::max(energy_of_v0 - energy_of_v, motion_energy);
  // The forces on Sigma, of body and layer, are differences of stiffness times U. Where all is at
  // rest the motion that they seem to be worth is at most 2.2 ulp of that
  // (LockingLoss.HasNoMotionWhereAllIsAtRest), and ten times as much is room.
  const Eigen::VectorXd stiffness = problem.a1.diagonal().head(c.sigma.size());
  const double round_off =
      left.round_off + 20 * c.ulp * motion.head(c.sigma.size()).cwiseAbs().dot(stiffness);
  // below this the round-off alone would be a share that is reported
  if (loss.reference < round_off / significance) loss.reference = 0;
  if (scene.contact()) loss.lower_bound -= price_of_lifting(c, strip, solution, base);
  return loss;
}

}  // namespace antilock
