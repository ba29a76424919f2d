// # Where contact ends: hp
//
// Run: 31_hp                   ε = 1, 1e-2, 1e-6, 0 and 1e-20; P1 to P4 on both meshes, hp up to P6; 6 seconds
// Run: 31_hp --exercise 1
// Run: 31_hp --exercise 2
// Run: 31_hp --exercise 3
//
// Needs: [16](../16_degree/16_degree.cpp) for $P_p$ and its bounds,
// [10](../10_limits/10_limits.cpp) for (25) and its jump of the pressure.
//
// **The picture.** Error against unknowns at ε = 0: equal cells (left), graded meshes
// (right). *On equal cells no degree helps for long. With small cells toward the end of
// contact it helps again. Where the degree grows too (hp), the order in the unknowns grows
// from level to level.*
//
// **Predict.** (a) Near the end of contact $u ∼ r^{3/2}$, $r$ the distance from it: which
// order in $H^1$ does P4 have on equal cells? (b) hp raises the degree and adds a layer of
// small cells, one each at a time. Which of the two lets the $H^1$ error fall, and which
// the error on $Γ_C$?
//
// ## What the end of contact is like
//
// Contact begins at $x = c$. Put $x = c + ε X$ in the layer: the layer's form of (23) then
// has the same factor in both directions. So near $(c, -1)$ Laplace's equation holds in $X$
// and $y$, with $u = 0$ right of $c$ and $∂_y u = 0$ left of it. Its solutions are
// $r^{k + 1/2}$ times a function of the angle, $k = 0, 1, ...$ The first would sink into
// the obstacle or be pulled by it, so $u ∼ r^{3/2}$. Farther than ε from $c$ one sees the
// limit (25): $w = u$ on Σ has a jump of $w''$ at $c$, and the body answers with
// $r^2 \log r$.
//
// No polynomial fits $r^{3/2}$ on a cell of size $h$ that holds this point. Its slope is
// wrong by about $h^{1/2}$ over an area $h^2$: that is $(h · h^2)^{1/2} = h^{3/2}$ in
// $H^1$, and $u$ on $Γ_C$ is wrong by $h^{3/2}$ too. Where $w''$ jumps, the slope is wrong
// by $h$ over a length $h$ of Σ: $(h^2 · h)^{1/2}$ is the same order in $H^1$, but on $Γ_C$
// it is $h^2$. So on equal cells, with $N ∼ h^{-2}$ unknowns, one expects (this counts
// sizes, and is no proof)
//
// $$ ‖u - u_h‖_h ≤ C h^{\min(p, 3/2)} ∼ N^{-\min(p/2, 3/4)}. $$
//
// Whether contact itself costs an order is a question of its own: it does not. Belhachmi
// and Ben Belgacem (2003) prove optimal orders for P2 if $u$ is smooth enough, and Drouet
// and Hild (2015) for P1 and P2 without any assumption on the contact set. What limits the
// order is how smooth $u$ is. (For CR with Raviart–Thomas fluxes the error of a scalar
// Signorini problem is even given by an identity: Bartels, Gudi and Kaltenbach 2024.)
//
// ## Layers
//
// Cut the cell next to $c$ so that the share $q = 1/4$ stays there, and the small part
// again: after $n$ cuts there are $n$ *layers*, and the last cell is $h q^n$ wide. All
// other cells near $c$ are at most a few times as wide as their distance from it. On them
// $r^{3/2}$ is smooth, and degree $p$ misses only a share $s_p$ of it: polynomials of
// degree $p - 1$ miss its slope $\frac{3}{2} r^{1/2}$ on $(1/4, 1)$ by 0.18, 0.016, 0.0026,
// 0.0005 in $L^2$ for $p$ = 1 to 4, and by three times less per degree at last. Hence, by
// the same count of sizes,
//
// $$ ‖u - u_h‖_h ≤ C (h^p + s_p h^{3/2} + (h q^n)^{3/2}),   q^{3/2} = 1/8 \text{ per layer}. $$
//
// *Graded* $P_p$ takes $n ≥ (p/3) \log_2 (1/h)$ layers: the third term is below the first.
// The order is $p$ as long as $s_p$ hides the second; then it is 3/2 again, unless the
// cells at the distance $r$ shrink with $h$ too. *hp* keeps $h$ and raises $p$ and $n$ by
// one: each term falls exponentially in $p$. Lines are drawn through the domain (a *tensor
// mesh*), so $N ∼ p^2$ cells times $p^2$ unknowns, and the error should be like
// $\exp(-b N^{1/4})$. (With small cells near the point only it is $\exp(-b N^{1/3})$, Guo
// and Babuška 1986.)
//
// Lines through the stiff layer leave it in columns, so no degree locks (chapter 16). A
// distance $d$ in $x$ is felt up to $d$ in the body and up to $d/ε$ in the stiff layer. So
// layers of cells wider than ε get rows in the body above Σ, narrower ones in the stiff
// layer above $Γ_C$, as in this mesh.
// :figure: hp_mesh
//
// Contact is asked at the unknowns: $K_h ⊄ K$ for $p ≥ 2$. Column `below` says how far
// $u_h$ is below 0 between them.

#include "antilock/core/stopwatch.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/mesh/graded.hpp"
#include "course/add_row.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Exact, tutorial::hp_columns;

constexpr int none = -1;  // not even a mesh line at the end of contact
struct Grading {
  int degree, cells, layers;  // cells: 1/h away from the end of contact
};
const std::vector<Grading> hp{{1, 3, 1}, {2, 3, 2}, {3, 3, 3},
                              {4, 3, 4}, {5, 3, 5}, {6, 3, 6}};

// ### Mesh
TriangleMesh mesh_for(const Grading& level, double end, double epsilon) {
  if (level.layers == none) return structured_mesh(level.cells);
  return graded_mesh(end, 1.0 / level.cells, level.layers, 0.25, epsilon);
}

Table solve(const std::string& series, const Grading& level, double end,
            const Exact& exact) {
  const Stopwatch watch;
  const Space space(mesh_for(level, end, exact.epsilon), lagrange(level.degree));
  // ### Forms
  const VariationalInequality problem =
      assemble(tutorial::paper_scene(exact.epsilon), space);
  // ### Solve
  const Solution solution = active_set(problem);
  const double seconds = watch.seconds(),
               found = contact_zone({space, problem, solution}).from.value_or(end);
  const auto [contact, below] = tutorial::on_contact(space, solution.u, exact.solution);
  Table row(hp_columns);
  tutorial::add_row(row, {{"mesh", level.layers == none ? "equal cells" : "graded"},
                          {"series", series},
                          {"epsilon", exact.epsilon},
                          {"degree", level.degree},
                          {"h", 1.0 / level.cells},
                          {"unknowns", space.free_count()},
                          {"h1", exact.errors(space, solution).h1},
                          {"contact", contact},
                          {"below", below},
                          {"end", found},
                          {"seconds", seconds}});
  return row;
}

// Each level grades toward the end of contact that the level before has found, the first
// toward 1/2: no truth is used.
Table climb(const std::string& series, const std::vector<Grading>& levels,
            const Exact& exact) {
  Table rows(hp_columns);
  for (const Grading& level : levels)
    rows.add(solve(series, level, rows.size() == 0 ? 0.5 : rows.last("end"), exact));
  return rows;
}

// P4 on equal cells: how good it is depends on where $c$ lies in its cell. So nine
// positions are taken: the worst counts.
Table shifted(const Exact& exact) {
  Table rows({"h", "share", "h1", "contact"});
  for (const int n : {6, 8, 11, 16})
    for (int s = 1; s <= 9; ++s) {
      const Table row = solve("P4", {4, n, 0}, exact.contact_from() + 0.1 * s / n, exact);
      rows.add({1.0 / n, 0.1 * s, row.number("h1"), row.number("contact")});
    }
  return rows;
}

void judge(const Table& results, const Exact& exact, tutorial::Report& report);
void judge_shifted(const Table& rows, const std::string& norm, double order, double epsilon,
                   tutorial::Report& report);

void study(const tutorial::Options& options, tutorial::Report& report) {
  Table results(hp_columns);
  for (const double epsilon : {1.0, 1e-2, 1e-6, 0.0, 1e-20}) {
    const Exact exact(tutorial::paper_scene(epsilon));
    for (int p = 1; p <= 4 && exact.epsilon != 1e-20; ++p) {
      std::vector<Grading> uniform, graded;
      for (const int n : {6, 8, 11, 16, 23, 32})
        if (n <= options.cells) uniform.push_back({p, n, none});
      for (int n = 4; n * p <= 2 * options.cells; n *= 2)
        graded.push_back({p, n, static_cast<int>(std::ceil(p * std::log2(n) / 3))});
      for (const auto& levels : {uniform, graded})
        results.add(climb(lagrange(p).name(), levels, exact));
    }
    results.add(climb("hp", hp, exact));
    judge(results, exact, report);
    if (exact.epsilon == 1) judge_shifted(shifted(exact), "contact", 1.5, 1, report);
    if (exact.epsilon != 0) continue;
    const Table rows = shifted(exact);
    judge_shifted(rows, "h1", 1.5, 0, report);
    judge_shifted(rows, "contact", 2, 0, report);
  }
  // ### Output
  tutorial::write_hp(options.out, results, mesh_for(hp[3], 0.7, 0.1));
}

// The worst position first, then the order; and the multiple of $h^{order}$, which should
// not move.
void judge_shifted(const Table& rows, const std::string& norm, double order, double epsilon,
                   tutorial::Report& report) {
  const Table worst = tutorial::supremum(rows, norm, "share").rows;
  worst.print(fmt::format(
      "P4, equal cells, epsilon = {:g}, {}: the worst of nine positions", epsilon, norm));
  double least = 1e300, most = 0;
  for (const Table& row : worst.rows()) {
    const double multiple = row.number("worst") / std::pow(row.number("h"), order);
    least = std::min(least, multiple), most = std::max(most, multiple);
  }
  const double found = worst.order("worst", "h");
  report.claim(std::abs(found - order) < 0.2 && most / least < 1.5,
               "(observed) epsilon = {:g}, P4, equal cells, {}: {:.3f} to {:.3f} times "
               "h^{}, order {:.2f} over four meshes",
               epsilon, norm == "h1" ? "H1" : "on Gamma_C", least, most, order, found);
}

void judge(const Table& results, const Exact& exact, tutorial::Report& report) {
  const std::string here = fmt::format("epsilon = {:g}, ", exact.epsilon);
  const Table rows = results.filter("epsilon", exact.epsilon),
              own = rows.filter("series", "hp");
  const auto at = [&](int p, const char* column) {
    return own.filter("degree", p).number(column);
  };
  // No power of $N$: its order, from one level to the next, grows at every level. At last
  // it is above 3.
  std::vector<double> orders, factors;
  for (int p = 1; p < 6; ++p) {
    factors.push_back(at(p, "h1") / at(p + 1, "h1"));
    orders.push_back(std::log(factors.back()) /
                     std::log(at(p + 1, "unknowns") / at(p, "unknowns")));
  }
  report.claim(std::is_sorted(orders.begin(), orders.end()) && orders.back() > 3 &&
                   orders.back() < 5,
               "(observed) {}hp: no power of N, orders {:.1f}, {:.1f}, {:.1f}, {:.1f}, "
               "{:.1f} from level to level",
               here, orders[0], orders[1], orders[2], orders[3], orders[4]);
  report.claim(
      *std::min_element(factors.begin() + 1, factors.end()) > 4.5 && factors.back() < 14,
      "(observed) {}hp: from P2 on the H1 error is divided by {:.1f}, {:.1f}, {:.1f}, "
      "{:.1f} per level",
      here, factors[1], factors[2], factors[3], factors[4]);
  if (exact.epsilon == 1e-20)
    return report.claim_within(
        at(6, "h1") / results.filter("epsilon", 0).filter("series", "hp").last("h1"), 0.999,
        1.001, "(observed) " + here + "hp: H1 error over that at epsilon = 0");
  report.claim_within(at(6, "end") - exact.contact_from(), -2e-5, 2e-5,
                      "(observed) " + here + "hp: end of contact, less the truth's");
  for (int p = 1; p <= 4; ++p) {
    const double h1 =
        rows.filter("mesh", "graded").filter("series", lagrange(p).name()).order("h1", "h");
    report.claim(h1 > p - 0.25 && h1 < p + 0.5, "(observed) {}graded P{}: h^{:.2f} in H1",
                 here, p, h1);
  }
  const Table p4 = rows.filter("mesh", "equal cells").filter("series", "P4");
  const double gain = p4.last("contact") / at(6, "contact"),
               fewer = p4.last("unknowns") / at(6, "unknowns");
  report.claim(
      gain > 50 && fewer > 1,
      "(observed) {}on Gamma_C hp has 1/{:.0f} of P4's error, 1/{:.1f} of the unknowns",
      here, gain, fewer);
}

// ## What came out
// (a) 3/2. The position of $c$ in its cell decides over a factor of ten, so the worst
// position of nine is taken first:
// :output: P4, equal cells, epsilon = 0, h1
//
// The multiple of $h^{3/2}$ is the same on all four meshes to 3 %. At ε = 1 the smooth part
// of $u$ hides it in $H^1$. On $Γ_C$ it is there (0.24 to 0.27 times $h^{3/2}$), and at ε =
// 0 the order on $Γ_C$ is 2, as derived above.
// :number: 0.24 = line "epsilon = 1, P4, equal cells, on Gamma_C: {} to"
// :number: 0.27 = line "epsilon = 1, P4, equal cells, on Gamma_C: 0.236 to {} times"
// :figure: hp_contact
//
// Graded, P1 to P4 have the orders 0.93, 1.83, 2.89, 4.3 in $H^1$ at ε = 0. On $Γ_C$ at ε =
// 1 the term with $s_p$ shows already: the error of graded P4 is 3.2e-5 and 1.1e-5 at 1/h =
// 8 and 16 (`results.csv`), order 1.5.
// :number: 0.93 = line "epsilon = 0, graded P1: h^{} in"
// :number: 1.83 = line "epsilon = 0, graded P2: h^{} in"
// :number: 2.89 = line "epsilon = 0, graded P3: h^{} in"
// :number: 4.3 = line "epsilon = 0, graded P4: h^{} in"
//
// hp at ε = 0 divides the $H^1$ error by 6.0, 7.3, 9.0 and 10.4 per level from P2 on. This
// factor still grows from level to level, so six levels show no rate yet. The order in $N$
// grows from 1.5 to 4.0. It is the same at ε = 1e-20.
// :number: 6.0 = line "epsilon = 0, hp: from P2 on the H1 error is divided by {},"
// :number: 4.0 = line "epsilon = 0, hp: no power of N, orders 0.7, 1.5, 2.3, 3.1, {} from"
//
// (b) In $H^1$ the degree: with 8 layers from the start each degree has the error of hp to
// 0.1 % (exercise 3, ε = 1). On $Γ_C$ it is the layers: P6 with 0 to 4 of them has 1.7e-2,
// 3.8e-3, 3.9e-4, 5.6e-5, 4.7e-6 there, about $q^{-3/2} = 8$ times less per layer; a fifth
// and a sixth change nothing. hp's last $u_h$ dips at most 5e-8 of the largest $u$ below 0.
//
// ## Exercises
//
// 1. P4 on equal cells, with one mesh line through the end of contact. Which of the two
//    orders 3/2 does that cure?
// 2. Layers toward a place that is δ beside the end, P6: how does the error on $Γ_C$ depend
//    on δ?
// 3. Raise the degree on 8 layers from the start; then add layers to P6. Which of the two
//    does hp's error follow?
// 4. On paper: on one mesh with a vertex at the end, degree $p → ∞$ gives $p^{-3}$. Why
//    twice the order of $h^{3/2}$?
//
// ## Further reading
//
// - [Ciarlet 2002](../guides/bibliography.md#ciarlet-2002): interpolation and its orders.
// - [Chouly, Hild and Renard 2023](../guides/bibliography.md#chouly-2023): orders of
//   convergence in contact.

#include "answers.hpp"

// With more than 32 cells graded P4 would be as good as the truth's gradients (1e-6 in
// $H^1$).
int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "31_hp", "layers and degrees where contact ends",
      {.takes_epsilon = false, .least_cells = 16, .most_cells = 32, .exercises = exercises},
      study);
}
