// Why P1 locks: the kernel of a0 on V_h, counted, drawn, and killed by moving vertices.
//
// Run: 11_kernel                     counts to 1/h = 32; a few seconds
// Run: 11_kernel --cells 16
//
// --epsilon is not asked for here: the kernel does not know it.
//
// The idea. As epsilon -> 0 the answer must lie in G_h = { v in V_h : d/dy v = 0 in the layer }, (2) and (7). Uniform
// convergence asks that K_0h = K_h n G_h approach K_0 (Theorem 4). So count G_h first, before anything is solved:
//
//   P1, structured     n - 1    a hat a column of vertices: every function of x, affine between the columns
//   P1, unstructured   0        v = a + b x on one triangle, the same a and b on its neighbours, and 0 at the sides
//   CR, any mesh       N_T / 2  3/2 edges a layer triangle, one condition d/dy v = 0 each
//
// A large kernel is not yet a good one. Lemma 2 needs more: the interpolation I_h that keeps the mean over each edge
// satisfies, by Green's formula, grad I_h v = mean of grad v on each triangle. So it maps K_0 into K_0h, and more: for
// every multiplier q, constant on triangles,
//
//   sup_{v in V_h} (q, d/dy v) / |v|_{1,h}  >=  sup_{v in V} (q, d/dy v) / |v|_1 ,
//
// that is, the discrete inf-sup constant of B is at least 1 in the dual norm of V, on every mesh (V here: P1 on a mesh
// refined twice). In L2 nothing helps: d/dy from H1 to L2 has no closed range, and the constant falls like h. For P1
// the rows of B depend on each other and the constant is 0, on the structured mesh too, where nothing locks: the
// condition is sufficient, not necessary.
//
// At last, from Figure 3 to Figure 6: every vertex is moved by t h at random. The kernel dies at the first t > 0; but a
// function of x is only missed by t h, at the price epsilon^-2 (t h)^2: at fixed h the error rises like
// (t h / epsilon)^2, until all is lost. Locking is a matter of degree, its cause is not.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include <numbers>

#include "antilock/analysis/inf_sup.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/study/sweep.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

const Scene scene(Body{paper_load}, StiffLayer{0}, UnilateralContact{});

int layer_triangles(const TriangleMesh& mesh) {
  return static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
}

// 1. Count. One row a mesh: n, N_T structured and unstructured, and the four dimensions. The layer alone: what lives on
// the body is in every kernel.
int layer_kernel(const Space& space) { return layer_kernel_dimension(assemble(scene, space)); }

using Count = Eigen::Matrix<int, 7, 1>;
Count count_kernels(int n) {
  const TriangleMesh structured = structured_mesh(n), unstructured = unstructured_mesh(n);
  Count row;
  row << n, layer_triangles(structured), layer_triangles(unstructured), layer_kernel(Space(structured, p1())),
      layer_kernel(Space(unstructured, p1())), layer_kernel(Space(structured, crouzeix_raviart())),
      layer_kernel(Space(unstructured, crouzeix_raviart()));
  return row;
}

// 2. Draw: the orthogonal projection onto G_h of one unknown in the middle of the layer, and of sin(pi x). What is not
// in the kernel cannot survive epsilon -> 0.
void draw_kernel(const std::filesystem::path& out, const std::string& name, const Space& space) {
  const Eigen::MatrixXd basis = kernel_basis(assemble(scene, space));
  Eigen::VectorXd one = Eigen::VectorXd::Zero(space.size()), sine(space.size());
  Eigen::Index middle = 0;
  (space.points().rowwise() - Eigen::RowVector2d(0.5, -0.5)).rowwise().squaredNorm().minCoeff(&middle);
  one(middle) = 1;
  for (int i = 0; i < space.size(); ++i)
    sine(i) = std::sin(std::numbers::pi * space.points()(i, 0)) * (1 - std::max(0.0, space.points()(i, 1)));
  Eigen::VectorXd local = basis * (basis.transpose() * one);
  double highest = 1e-8;  // over the corners of the triangles, where CR jumps
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)
      highest = std::max(highest, space.element().basis(Eigen::Vector3d::Unit(i)).dot(local(space.unknowns().row(t))));
  local /= highest;
  write_vtu(out / (name + "_local.vtu"), space, local);
  write_vtu(out / (name + "_sine.vtu"), space, basis * (basis.transpose() * sine));
}

// 3. The inf-sup constant of B, |v|_{1,h} the broken H1 seminorm, in the dual norm of V and in L2.
struct InfSup {
  double dual, l2;
};
SparseMatrix h1_seminorm(const Space& space) { return gradient_form(space, {1, 1}, {1, 1}); }

InfSup inf_sup_of(const TriangleMesh& mesh, const Element& element) {
  const TriangleMesh finer = refined(refined(mesh));
  const Space space(mesh, element), almost_all(finer, p1());
  const VariationalInequality problem = assemble(scene, space);
  const Eigen::MatrixXd seen = multiplier_gram(problem, h1_seminorm(space));
  const Eigen::MatrixXd dual = multiplier_gram(assemble(scene, almost_all), h1_seminorm(almost_all), 16);
  return {inf_sup(seen, dual), inf_sup(seen, problem.m.asDiagonal())};
}

// 4. Jitter: the largest error at the unknowns, as a share of the displacement of the layer.
constexpr std::array amounts{1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.2};
constexpr std::array epsilons{1e-2, 1e-3, 1e-4, 1e-5};

Eigen::MatrixXd jitter_study(int n) {
  Eigen::MatrixXd rows(amounts.size() * epsilons.size(), 5);  // t, epsilon, kernel, share lost, lost / kept
  ActiveSetOptions patient;  // functions that are almost in the kernel are corrected slowly
  patient.corrections.max_corrections = 5000;
  for (std::size_t e = 0; e < epsilons.size(); ++e) {
    const Truth truth(paper_sine_load(), epsilons[e]);
    const TruthTable table(truth);
    for (std::size_t k = 0; k < amounts.size(); ++k) {
      const TriangleMesh mesh = jittered_mesh(n, amounts[k]);
      const Space space(mesh, p1());
      Sweep sweep(scene, space);
      sweep.set_epsilon(epsilons[e]);
      const Errors errors = measure_errors(space, sweep.solve(patient), epsilons[e], reference(table));
      const double lost = errors.max_at_unknowns / truth.max_on_contact();
      rows.row(static_cast<Eigen::Index>(e * amounts.size() + k)) << amounts[k], epsilons[e],
          e == 0 ? layer_kernel(space) : 0, lost, lost / (1 - lost);
    }
  }
  return rows;
}

// Where half of the layer's displacement is lost: the amount t, and the slope of log(lost / kept) there, both between
// the two nearest.
struct Half {
  double t, slope;
};
Half half_lost(const Eigen::MatrixXd& study, double epsilon) {
  Eigen::Index i = 0;
  while (study(i, 1) != epsilon || study(i, 4) < 1) ++i;
  const double slope = std::log(study(i, 4) / study(i - 1, 4)) / std::log(study(i, 0) / study(i - 1, 0));
  return {study(i, 0) * std::pow(study(i, 4), -1 / slope), slope};
}

void explain(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("count the kernels (sparse QR)");
  std::vector<Count> counts;
  for (int n = 4; n <= options.cells; n *= 2) counts.push_back(count_kernels(n));

  report.stage("draw their functions");
  const TriangleMesh structured = structured_mesh(8), unstructured = unstructured_mesh(8);
  draw_kernel(options.out, "p1_structured", Space(structured, p1()));
  draw_kernel(options.out, "p1_unstructured", Space(unstructured, p1()));
  draw_kernel(options.out, "cr_unstructured", Space(unstructured, crouzeix_raviart()));

  report.stage("inf-sup constants (dense eigenvalues)");
  std::vector<std::array<InfSup, 3>> constants;
  const std::vector<int> small{4, 8, 16};
  for (const int n : small)
    constants.push_back({inf_sup_of(structured_mesh(n), p1()), inf_sup_of(structured_mesh(n), crouzeix_raviart()),
                         inf_sup_of(unstructured_mesh(n), crouzeix_raviart())});

  constexpr int n = 16;
  report.stage(fmt::format("move the vertices of P1's structured mesh, 1/h = {}", n));
  const Eigen::MatrixXd study = jitter_study(n);
  write_csv(options.out / "jitter.csv", {"t", "epsilon", "kernel", "lost", "lost_to_kept"}, study);
  report.finish();

  fmt::print("\n  dim G_h (and N_T, the layer's triangles)\n  {:>5} {:>18} {:>18} {:>18} {:>18}\n", "1/h",
             "P1 structured", "P1 unstructured", "CR structured", "CR unstructured");
  bool as_said = true;
  for (const Count& c : counts) {
    fmt::print("  {:5} {:18} {:18} {:18} {:18}\n", c(0), fmt::format("{} ({})", c(3), c(1)),
               fmt::format("{} ({})", c(4), c(2)), fmt::format("{} ({})", c(5), c(1)),
               fmt::format("{} ({})", c(6), c(2)));
    as_said = as_said && c(3) == c(0) - 1 && c(4) == 0 && 2 * c(5) == c(1) && 2 * c(6) == c(2);
  }
  fmt::print("\n  inf-sup constant of B: dual norm of V, (L2)\n  {:>5} {:>18} {:>18} {:>18}\n", "1/h", "P1 structured",
             "CR structured", "CR unstructured");
  bool stable = true, dependent = true;
  for (std::size_t i = 0; i < small.size(); ++i) {
    fmt::print("  {:5}", small[i]);
    for (const InfSup& c : constants[i]) fmt::print(" {:>18}", fmt::format("{:.4f} ({:.4f})", c.dual, c.l2));
    fmt::print("\n");
    dependent = dependent && constants[i][0].dual == 0;
    stable = stable && constants[i][1].dual > 1 - 1e-9 && constants[i][2].dual > 1 - 1e-9;
  }
  fmt::print("\n  moved by t h: dim G_h, share of the layer's displacement lost\n  {:>8} {:>6}", "t", "dim");
  for (const double epsilon : epsilons) fmt::print("  epsilon={:<6.0e}", epsilon);
  const auto lines = static_cast<Eigen::Index>(amounts.size());
  for (Eigen::Index k = 0; k < lines; ++k) {
    fmt::print("\n  {:8.0e} {:6}", study(k, 0), study(k, 2));
    for (Eigen::Index e = 0; e < study.rows(); e += lines) fmt::print("  {:14.4f}", study(e + k, 3));
  }
  fmt::print("\n\n");

  report.claim(as_said, fmt::format("dim G_h on {} meshes: n - 1 for P1 structured, 0 for P1 unstructured, N_T / 2 "
                                    "for CR on both",
                                    counts.size()));
  report.claim(
      stable,
      fmt::format(
          "by the interpolation of Lemma 2, the inf-sup constant of CR is at least 1: {:.3f} and {:.3f} at 1/h = {}",
          constants.back()[1].dual, constants.back()[2].dual, small.back()));
  report.claim(dependent, "P1 has dependent rows of B: its constant is 0 even where it does not lock");
  report.claim(study.col(2).isZero(), "the kernel is dead at the first t = 1e-6");
  const Half at_3 = half_lost(study, 1e-3), at_4 = half_lost(study, 1e-4), at_5 = half_lost(study, 1e-5);
  report.claim(std::abs(at_3.t / at_4.t - 10) < 2 && std::abs(at_4.t / at_5.t - 10) < 2,
               fmt::format("the error grows only gradually: half is lost at t = {:.1e}, {:.1e}, {:.1e} for epsilon = "
                           "1e-3, 1e-4, 1e-5: t h = {:.1f} epsilon",
                           at_3.t, at_4.t, at_5.t, at_4.t / n / 1e-4));
  report.claim(std::abs(at_3.slope - 2) < 0.2 && std::abs(at_4.slope - 2) < 0.2 && std::abs(at_5.slope - 2) < 0.2,
               fmt::format("lost / kept rises like (t h / epsilon)^2: slopes {:.2f}, {:.2f}, {:.2f}", at_3.slope,
                           at_4.slope, at_5.slope));
}

// Three things to try:
// - epsilon = 0 in `epsilons`: all is lost at the first t; a limit has no degrees.
// - draw the other functions of a kernel: the columns of kernel_basis, write_vtu.
// - P2 in count_kernels: on an unstructured mesh one function is left, a parabola in x.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 4;
  options.most_cells = 64;  // sparse QR on the layer
  return tutorial::run(argc, argv, "11_kernel", "Why P1 locks: the kernel of a0, counted, drawn and killed", options,
                       explain);
}
