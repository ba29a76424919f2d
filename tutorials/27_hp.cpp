// # Where contact ends: hp
//
// Run: 27_hp                   ε = 1, 1e-2, 1e-6, 0 and 1e-20; P1 to P4 on both meshes, hp up to P6; 6 seconds
// Run: 27_hp --exercise 1
// Run: 27_hp --exercise 2
//
// Needs: [14](14_degree.cpp) for $P_p$ and its bounds, [10](10_limits.cpp) for (25) and its jump of the pressure.
//
// **The picture.** Error against unknowns at ε = 0: equal cells (left), graded meshes (right). *On equal cells P4 falls
// like $h^{3/2}$ in the end. Graded toward the end of contact, degree $p$ has the order $p$. Where degree and layers
// grow together (hp), the error falls faster than every power of the unknowns.*
//
// **Predict.** (a) Near the end of contact $u ∼ r^{3/2}$: which order in $H^1$ does P4 have on equal cells? (b) At
// ε = 1 the load is far from there. In which norm is that order still seen?
//
// ## What the end of contact is like
//
// Contact begins at $x = c$. Put $x = c + ε X$ in the layer: (23) then has one factor in both directions. Near
// $(c, -1)$ it is Laplace's equation, with $u = 0$ right of $c$ and $∂_y u = 0$ left of it, solved by $r^{k + 1/2}$
// times a function of the angle. $k = 0$ would sink in or pull, so $u ∼ r^{3/2}$. Farther than ε from $c$ one sees
// (25): $w''$ jumps on Σ, and the body answers with $r^2 \log r$.
//
// No polynomial fits $r^{3/2}$ on a cell of size $h$ that holds this point. A slope wrong by $h^{1/2}$ over an area
// $h^2$ is $h^{3/2}$ in $H^1$; $u$ on $Γ_C$ is wrong by $h^{3/2}$. The jump of $w''$: a slope wrong by $h$ over a
// length $h$ of Σ is $h · h^{1/2}$, in $H^1$ the same order, but $h^2$ on $Γ_C$. So on equal cells
//
// $$ ‖u - u_h‖_h ≤ C h^{\min(p, 3/2)} ∼ N^{-\min(p/2, 3/4)}. $$
//
// ## Layers
//
// Cut the cell next to the point so that a share $q = 1/4$ stays there, and again: after $n$ *layers* the last cell is
// $h q^n$ wide, the others at most a few times their distance from it. The error is $C (h q^n)^{3/2} + C h^p$, and
// $q^{3/2} = 1/8$ per layer. *Graded* $P_p$ takes $n ≥ (p/3) \log_2 (1/h)$: the second term is left; a layer costs two
// columns. *hp* keeps $h$ and raises $p$ and $n$ by one. With lines drawn through (a *tensor* mesh) $N ∼ p^2 · p · p$:
// the error is $\exp(-b N^{1/4})$. (Small cells near the point only: $N^{1/3}$, Babuška and Guo 1986.)
//
// Lines through the layer leave it in columns, so that no degree locks. A distance $d$ in $x$ is felt up to $d$ in the
// body, $d/ε$ in the layer. Layers wider than ε get rows in the body above Σ, narrower ones in the layer above $Γ_C$.
// Contact is asked at the unknowns: $K_h ⊄ K$ for $p ≥ 2$. Column `below` says how far $u_h$ is below 0 between them.

#include "antilock/core/stopwatch.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/mesh/graded.hpp"
#include "common/hp_output.hpp"
#include "common/study.hpp"

using namespace antilock;
using tutorial::Exact, tutorial::hp_columns;

constexpr int none = -1;  // not even a mesh line at the end of contact
struct Level {
  int degree, cells, layers;  // cells: 1/h away from the end of contact
};
const std::vector<Level> hp{{1, 3, 1}, {2, 3, 2}, {3, 3, 3}, {4, 3, 4}, {5, 3, 5}, {6, 3, 6}};

// ### Mesh
TriangleMesh mesh_for(const Level& level, double end, double epsilon) {
  if (level.layers == none) return structured_mesh(level.cells);
  return graded_mesh(end, 1.0 / level.cells, level.layers, 0.25, epsilon);
}

Table solve(const std::string& series, const Level& level, double end, const Exact& exact) {
  const Stopwatch watch;
  const Discretisation on(mesh_for(level, end, exact.epsilon), lagrange(level.degree));
  // ### Forms
  const VariationalInequality problem = assemble(tutorial::paper_scene(exact.epsilon), on.space());
  // ### Solve
  const Solution solution = active_set(problem);
  const double seconds = watch.seconds(), found = contact_zone(on.space(), problem, solution).from.value_or(end);
  const auto [contact, below] = tutorial::on_contact(on.space(), solution.u, exact.truth);
  Table row(hp_columns);
  row.add({level.layers == none ? "equal cells" : "graded", series, exact.epsilon, level.degree, 1.0 / level.cells,
           on.space().free_count(), exact.errors(on.space(), solution).h1, contact, below, found, seconds});
  return row;
}

// Each level grades toward the end of contact that the level before has found, the first toward 1/2: no truth is used.
Table climb(const std::string& series, const std::vector<Level>& levels, const Exact& exact) {
  Table rows(hp_columns);
  for (const Level& level : levels) rows.add(solve(series, level, rows.size() == 0 ? 0.5 : rows.last("end"), exact));
  return rows;
}

void verdicts(const Table& results, const Exact& exact, tutorial::Report& report) {
  const std::string here = fmt::format("epsilon = {:g}, ", exact.epsilon);
  const Table rows = results.where("epsilon", exact.epsilon), own = rows.where("series", "hp");
  const auto at = [&](int p, const char* column) { return own.where("degree", p).number(column); };
  const auto order = [&](int p) {  // in 1/N, from one level to the next
    return std::log(at(p, "h1") / at(p + 1, "h1")) / std::log(at(p + 1, "unknowns") / at(p, "unknowns"));
  };
  report.claim_within(std::pow(at(2, "h1") / at(6, "h1"), 0.25), 6, 10, here + "hp: H1 error per level (layers: 8)");
  report.claim(order(5) > 2 * order(2), "{}hp: no power of N, order {:.1f} and then {:.1f}", here, order(2), order(5));
  if (exact.epsilon == 1e-20)
    return report.claim_within(at(6, "h1") / results.where("epsilon", 0).where("series", "hp").last("h1"), 0.999, 1.001,
                               here + "hp: H1 error over that at epsilon = 0");
  report.claim_within(at(6, "end") - exact.contact_from(), -2e-5, 2e-5, here + "hp: end of contact, less the truth's");
  for (int p = 1; p <= 4; ++p) {
    const double h1 = rows.where("mesh", "graded").where("series", lagrange(p).name()).order("h1", "h");
    report.claim(h1 > p - 0.25, "{}graded P{}: h^{:.2f} in H1", here, p, h1);
  }
  // Where $c$ lies in its cell changes from mesh to mesh: 1/2 on either side of what theory says.
  const Table p4 = rows.where("mesh", "equal cells").where("series", "P4");
  report.claim_within(p4.order("contact", "h"), 1, 2.5, here + "P4, equal cells, on Gamma_C (3/2 to 2): order");
  if (exact.epsilon < 1) report.claim_within(p4.order("h1", "h"), 1, 2, here + "P4, equal cells, in H1 (3/2): order");
  const double gain = p4.last("contact") / at(6, "contact"), fewer = p4.last("unknowns") / at(6, "unknowns");
  report.claim(gain > 50 && fewer > 1, "{}on Gamma_C hp has 1/{:.0f} of that error, 1/{:.1f} of the unknowns", here,
               gain, fewer);
}

void study(const tutorial::Options& options, tutorial::Report& report) {
  Table results(hp_columns);
  for (const Exact& exact : tutorial::exact_solutions({1, 1e-2, 1e-6, 0, 1e-20})) {
    for (int p = 1; p <= 4 && exact.epsilon != 1e-20; ++p) {
      std::vector<Level> uniform, graded;
      for (const int n : {6, 8, 11, 16, 23, 32})
        if (n <= options.cells) uniform.push_back({p, n, none});
      for (int n = 4; n * p <= 2 * options.cells; n *= 2)
        graded.push_back({p, n, static_cast<int>(std::ceil(p * std::log2(n) / 3))});
      for (const auto& levels : {uniform, graded}) results.add(climb(lagrange(p).name(), levels, exact));
    }
    results.add(climb("hp", hp, exact));
    verdicts(results, exact, report);
  }
  // ### Output
  tutorial::write_hp(options.out, results, mesh_for(hp[3], 0.7, 0.1));
}

// ## What came out
//
// (a) 3/2; measured: 1.60, 1.45, 1.45 at ε = 1e-2, 1e-6, 0. (b) On $Γ_C$ (1.97; clean in exercise 1). In $H^1$ the
// smooth part hides it at ε = 1: P4 has the order 3.7. Graded, P1 to P4 have 0.93, 1.83, 2.89, 4.3 at ε = 0.
//
// hp at ε = 0: 35, 240, 783, 1880, 3795, 6840 unknowns, $H^1$ errors 0.49, 0.13, 2.1e-2, 2.8e-3, 3.2e-4, 3.1e-5, or 8.0
// per level; P4 on equal cells has 1.6e-4 with 32,512. The logarithm of the error is straighter in $N^{1/2}$ (0.997 of
// its variance) and $N^{1/3}$ (0.996) than in $N^{1/4}$ (0.985): six levels are too few. The error at ε = 1 is 1.7
// times that at 0, at 1e-20 the same. $u_h$ is below 0 by up to its error on equal cells, 5e-8 of $u$ in hp's last.
//
// ## Exercises
//
// 1. P4 on equal cells, with one mesh line through the end of contact. Which of the two orders 3/2 does that cure?
// 2. Layers toward a place that is δ beside the end, P6: how does the error on $Γ_C$ depend on δ?
// 3. On paper: degree $p → ∞$ on one mesh with a vertex at the end gives $p^{-3}$. Why twice the order of $h^{3/2}$?

#include "answers/27_hp.hpp"

// With more than 32 cells graded P4 would be as good as the truth's gradients (1e-6 in $H^1$).
int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "27_hp", "layers and degrees where contact ends",
                       {.takes_epsilon = false, .least_cells = 16, .most_cells = 32, .exercises = exercises}, study);
}
