// Why P1 locks: the kernel of a0 on V_h, counted, drawn, and emptied by moving vertices.
//
// Run: 07_kernel   counts to 1/h = 32; a few seconds
// Run: 07_kernel --cells 16
//
// --epsilon is not asked for here: the kernel does not depend on it.
//
// The idea. As epsilon -> 0 the answer must lie in G_h = { v in V_h : d/dy v = 0 in the layer },
// (2) and (7). Uniform convergence asks, besides K_h approaching K, that K_0h = K_h n G_h approach
// K_0 (Theorem 4). So count G_h first, before anything is solved. In the body G_h asks nothing, so
// every unknown of the body is in it: what decides is how many functions of the kernel live on the
// layer, and whether their number grows under refinement. There are
//
//   P1, structured     n - 1    one hat per column of vertices: functions of x, affine in between
//   P1, unstructured   0        v = a + b x on one triangle, the same a, b on all, 0 at the sides
//   CR, any mesh       N_T / 2  3/2 edges per layer triangle, one condition d/dy v = 0 each
//
// A large kernel is not yet a good one. Lemma 2 needs more: the interpolation I_h that keeps the
// mean over each edge satisfies, by Green's formula, grad I_h v = mean of grad v on each triangle,
// so it maps K_0 into K_0h. The same formula gives Fortin's property of I_h, which the paper does
// not use: for every multiplier q, constant on triangles,
//
//   sup_{v in V_h} (q, d/dy v) / |v|_{1,h}  >=  sup_{v in V} (q, d/dy v) / |v|_1 ,
//
// that is, the discrete inf-sup constant of B is at least 1 in the dual norm of V, on every mesh (V
// here: P1 on a mesh refined twice). In L2 there is no such bound: d/dy from H1 to L2 has no closed
// range, and the constant falls like h. For P1 the rows of B depend on each other and the constant
// is 0, on the structured mesh too, where nothing locks: the condition is sufficient, not
// necessary.
//
// At last, from Figure 3 to Figure 6: every vertex is moved by t h at random. The kernel on the
// layer is empty at the first t > 0. But a function of x is only missed by t h, at the price
// epsilon^-2 (t h)^2: at fixed h the error rises like (t h / epsilon)^2, until all is lost. Locking
// is a matter of degree, its cause is not.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <numbers>

#include "antilock/analysis/inf_sup.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

const Scene scene = tutorial::paper_scene(0);

// 1. Count: dim G_h on the layer alone, beside N_T, the layer's triangles.
Table count_kernels(int finest) {
  Table counts({"cells", "method", "triangles", "kernel", "predicted"});
  for (int n = 4; n <= finest; n *= 2)
    for (const Method& method : methods()) {
      const Discretisation on = method.on(n);
      const auto triangles = std::count(on.mesh().region.begin(), on.mesh().region.end(), Region::layer);
      const bool is_p1 = method.element->conforming();
      const double predicted = !is_p1                               ? 0.5 * static_cast<double>(triangles)
                               : method.family.name == "structured" ? n - 1
                                                                    : 0;
      counts.add({n, method.name(), triangles, layer_kernel_dimension(assemble(scene, on.space())), predicted});
    }
  return counts;
}

// 2. Draw: the orthogonal projection onto G_h of one unknown in the middle of the layer, and of
// sin(pi x). What is not in the kernel cannot survive epsilon -> 0.
void draw_kernel(const std::filesystem::path& out, const std::string& name, const Space& space);

// 3. The inf-sup constant of B, |v|_{1,h} the broken H1 seminorm: in the dual norm of V, and in L2.
Table inf_sup_constants() {
  const auto seminorm = [](const Space& space) { return gradient_form(space, {1, 1}, {1, 1}); };
  Table constants({"cells", "method", "dual", "l2"});
  for (const int n : {4, 8, 16})
    for (const Method& method : methods()) {
      if (method.name() == "P1 unstructured") continue;
      const Discretisation on = method.on(n), almost_all(refined(refined(on.mesh())), p1());
      const VariationalInequality problem = assemble(scene, on.space());
      const Eigen::MatrixXd seen = multiplier_gram(problem, seminorm(on.space()));
      const Eigen::MatrixXd dual =
          multiplier_gram(assemble(scene, almost_all.space()), seminorm(almost_all.space()), 16);
      constants.add({n, method.name(), inf_sup(seen, dual), inf_sup(seen, problem.m.asDiagonal())});
    }
  return constants;
}

// 4. Jitter: the largest error at the unknowns, as a share of the displacement of the layer.
Table jitter_study(int n) {
  Table table({"t", "epsilon", "kernel", "lost", "lost_to_kept"});
  ActiveSetOptions patient;  // functions that are almost in the kernel are corrected slowly
  patient.corrections.max_corrections = 5000;
  for (const double epsilon : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const tutorial::Exact exact(epsilon);
    for (const double t : {1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.2}) {
      const Discretisation on(jittered_mesh(n, t), p1());
      SceneSweep sweep(scene, on.space());
      sweep.set_epsilon(epsilon);
      const Errors errors = exact.errors(on.space(), sweep.solve(patient));
      const double lost = errors.max_at_unknowns / exact.truth.max_on_contact();
      table.add({t, epsilon, layer_kernel_dimension(sweep.problem()), lost, lost / (1 - lost)});
    }
  }
  return table;
}

// Where half of the layer's displacement is lost: the amount t, and the slope of log(lost / kept)
// there, both between the two nearest.
struct Half {
  double t, slope;
};
Half half_lost(const Table& jitter, double epsilon) {
  const Table own = jitter.where("epsilon", epsilon);
  const Table before = own.where_number("lost_to_kept", [](double x) { return x < 1; });
  const Table after = own.where_number("lost_to_kept", [](double x) { return x >= 1; });
  const double x = after.first("lost_to_kept");
  const double slope = std::log(x / before.last("lost_to_kept")) / std::log(after.first("t") / before.last("t"));
  return {after.first("t") * std::pow(x, -1 / slope), slope};
}

void explain(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("count the kernels (sparse QR)");
  const Table counts = count_kernels(options.cells);
  report.stage("draw their functions");
  draw_kernel(options.out, "p1_structured", Method{&p1(), structured()}.on(8).space());
  draw_kernel(options.out, "p1_unstructured", Method{&p1(), unstructured()}.on(8).space());
  draw_kernel(options.out, "cr_unstructured", Method{&crouzeix_raviart(), unstructured()}.on(8).space());
  report.stage("inf-sup constants (dense eigenvalues)");
  const Table constants = inf_sup_constants();
  constexpr int n = 16;
  report.stage(fmt::format("move the vertices of P1's structured mesh, 1/h = {}", n));
  const Table jitter = jitter_study(n);
  report.finish();
  counts.pivot("cells", "method", "kernel").print("dim G_h on the layer");
  counts.pivot("cells", "method", "triangles").print("N_T, the layer's triangles");
  constants.pivot("cells", "method", "dual").print("inf-sup constant of B, dual norm of V");
  constants.pivot("cells", "method", "l2").print("the same in L2");
  jitter.pivot("t", "epsilon", "lost")
      .print("moved by t h: share of the layer's displacement that is lost, by epsilon");
  jitter.write(options.out / "jitter.csv");

  report.claim(counts.numbers("kernel") == counts.numbers("predicted"),
               "dim G_h on {} meshes: n - 1 for P1 structured, 0 for P1 unstructured, N_T / 2 for CR on both",
               counts.different("cells").size());
  const Table cr_s = constants.where("method", "CR structured"), cr_u = constants.where("method", "CR unstructured");
  report.claim(
      std::min(cr_s.least("dual"), cr_u.least("dual")) > 1 - 1e-9,
      "by Fortin's property of the interpolation of Lemma 2, the inf-sup constant of CR is at least 1: {:.3f} and "
      "{:.3f} at 1/h = {}",
      cr_s.last("dual"), cr_u.last("dual"), cr_s.last("cells"));
  report.claim(constants.where("method", "P1 structured").most("dual") == 0,
               "P1 has dependent rows of B: its constant is 0 even where it does not lock");
  report.claim(jitter.most("kernel") == 0, "the kernel on the layer is empty at the first t = 1e-6");
  const Half at_3 = half_lost(jitter, 1e-3), at_4 = half_lost(jitter, 1e-4), at_5 = half_lost(jitter, 1e-5);
  report.claim(std::abs(at_3.t / at_4.t - 10) < 2 && std::abs(at_4.t / at_5.t - 10) < 2,
               "the error grows only gradually: half is lost at t = {:.1e}, {:.1e}, {:.1e} for epsilon = 1e-3, 1e-4, "
               "1e-5: t h = {:.1f} epsilon",
               at_3.t, at_4.t, at_5.t, at_4.t / n / 1e-4);
  report.claim(std::abs(at_3.slope - 2) < 0.2 && std::abs(at_4.slope - 2) < 0.2 && std::abs(at_5.slope - 2) < 0.2,
               "lost / kept rises like (t h / epsilon)^2: slopes {:.2f}, {:.2f}, {:.2f}", at_3.slope, at_4.slope,
               at_5.slope);
}

// Three things to try:
// - epsilon = 0 in `jitter_study`: all is lost at the first t; a limit has no degrees.
// - draw the other functions of a kernel: the columns of kernel_basis, write_vtu.
// - methods({&p2()}) in `count_kernels`: on an unstructured mesh one function is left, a parabola
//   in x.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 4;
  options.most_cells = 64;  // sparse QR on the layer
  return tutorial::run(argc, argv, "07_kernel", "Why P1 locks: the kernel of a0, counted, drawn and emptied", options,
                       explain);
}

void draw_kernel(const std::filesystem::path& out, const std::string& name, const Space& space) {
  const Eigen::MatrixXd basis = kernel_basis(assemble(scene, space));
  const auto projection = [&](const Eigen::VectorXd& v) { return Eigen::VectorXd(basis * (basis.transpose() * v)); };
  Eigen::Index middle = 0;
  (space.points().rowwise() - Eigen::RowVector2d(0.5, -0.5)).rowwise().squaredNorm().minCoeff(&middle);
  Eigen::VectorXd local = projection(Eigen::VectorXd::Unit(space.size(), middle));
  double highest = 1e-8;  // over the corners of the triangles, where CR jumps
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)
      highest = std::max(highest, space.element().basis(Eigen::Vector3d::Unit(i)).dot(local(space.unknowns().row(t))));
  local /= highest;
  const auto x = space.points().col(0).array(), y = space.points().col(1).array();
  write_vtu(out / (name + "_local.vtu"), space, local);
  write_vtu(out / (name + "_sine.vtu"), space, projection((std::numbers::pi * x).sin() * (1 - y.max(0.0))));
}
