// # Limits on a mesh
//
// Run: 11_propositions               h from 1/8 to 1/64; a few seconds
// Run: 11_propositions --cells 32
// Run: 11_propositions --exercise 1
//
// **Afterwards you can** take the limits in ε and $h$ in both orders, split an error into
// three steps, and name the step that fails for locked P1.
//
// Needs: [10](../10_limits/10_limits.cpp) (Theorem 1 and its proof),
// [07](../07_kernel/07_kernel.cpp) (kernel), [09](../09_convergence/09_convergence.cpp)
// (order).
//
// **The picture.** How far each method is from its own limit $u_h^0$, on one mesh; grey:
// the exact solution and its limit. Each method has a limit, locked P1 too.
//
// **Predict.** (a) Where $ε$ is small, the lines of all methods have the slope 2, that of
// the exact solution 3/2. What does the mesh lack? (b) Now $ε = h^2$, and $h → 0$. Three
// steps lead from $u^ε$ by $u^0$ and $u_h^0$ to $u_h^ε$. Which of their lengths do not tend
// to 0 for locked P1?
//
// ## Two limits, in two orders
//
// A computation has two small numbers, ε and $h$. There are two ways to a limit: first let
// ε go to 0 on a fixed mesh, then take finer meshes; or first take finer meshes at a fixed
// ε. A method is free of trouble if it does not matter which. The discrete problems are
// chapter 10's (1) and (2) with discrete sets, $K_h$ and $K_{0h} = K_h ∩ G_h$; the paper
// calls them (6) and (7). For our problem (7) is (27) of chapter 05.
//
// **Proposition 1: ε to 0 at fixed $h$.** $u_h^ε → u_h^0$. The proof is that of Theorem 1,
// for discrete functions. It is even easier, because in a space of finitely many dimensions
// a bounded sequence has parts that converge strongly, not only weakly. No mesh is
// excluded. So locked P1 has a limit as well. The order is 2 for every method. For the
// exact solution it was 3/2, because of the waves $k$ above $1/ε$, which the layer answers
// in another way (chapter 10). A mesh has no waves beyond $1/h$. So once ε is below $h$
// there are none of these. (For locked P1 ε must be below its wall, too: chapter 06.)
//
// Why 2? The layer answers a wave $\sin ax$ with the stiffness $(a/ε) \tanh εa$ (chapter
// 04), which is $a^2 (1 - (εa)^2/3 + ...)$. A mesh has waves up to $a = π/h$. For each of
// them the limit $a^2$ is missed by a share of at most $(επ/h)^2$. As $h$ is fixed, each
// share is like $ε^2$, and a sum of finitely many such terms is so, too.
//
// **Proposition 2: $h$ to 0 at fixed ε, and at ε = 0.** If $K_h$ approaches $K$, then
// $u_h^ε → u^ε$. If $K_{0h}$ approaches $K_0$, then $u_h^0 → u^0$. (Both are Theorem 3 of
// [chapter 14](../14_estimates/14_estimates.cpp), which also asks for two properties of the
// method that P1 and Crouzeix–Raviart have. The
// [next chapter](../12_contact_sets/12_contact_sets.cpp) is about the two "if".)
//
// **Proposition 3: both at once.** If $K_h$ approaches $K$ *and* $K_{0h}$ approaches $K_0$,
// then $u_h^ε - u^ε → 0$, on whatever path both tend to 0. Go from one to the other in
// three steps:
//
// $$ ‖u^ε-u_h^ε‖_h ≤ ‖u^ε-u^0‖ + ‖u^0-u_h^0‖_h + ‖u_h^0-u_h^ε‖_h. \tag{18} $$
//
// :figure: limit_square
//
// The first step is Theorem 1, and no mesh is in it. The second is Proposition 2, and no ε
// is in it. Only the third holds both, and is new. Its proof runs along the three steps of
// Theorem 1.
//
// *Bounded:* the test function is now an element of $K_{0h}$, one per mesh. As $K_{0h}$
// approaches $K_0$, these can be chosen so that they converge, and so are bounded. Hence
// the discrete solutions are bounded, and their stiff form is at most $C ε^2$, with one $C$
// for all ε and $h$.
//
// *Weak limit:* a part of them has one. It is in $K$, since $K_h$ approaches $K$. Their
// stiff forms tend to 0, and a form can only lose by a weak limit, so the stiff form of the
// limit is 0, too: the limit is in $K_0$. What does it solve? Take any $w$ of $K_0$, and
// elements of $K_{0h}$ that tend to it, as test functions. Drop the stiff term and go to
// the limit, as in chapter 10: it solves (2), so it is $u^0$.
//
// *Strong:* test (6) with the discrete limit $u_h^0$, which the stiff form does not see:
//
// $$ α ‖u_h^0 - u_h^ε‖_h^2 ≤ L(u_h^ε - u_h^0) - a_1(u_h^0, u_h^ε - u_h^0) → 0. \tag{19} $$
//
// The right side tends to 0, because both discrete solutions in it tend to the same $u^0$:
// one weakly, as was just shown, the other strongly, by Proposition 2.
//
// **Where locked P1 leaves this road.** Its $K_{0h}$ holds no function that moves the
// layer. So its discrete limit is 0 there, and in the body it tends to the solution $u^c$
// that is clamped on $Σ$. The second step tends to $‖u^0 - u^c‖$, a number that the sine
// series gives: 0.138, most of it the 0.126 of $u^0$ on the layer. The third step of locked
// P1 does tend to 0 along $ε = h^2$, because both of its discrete solutions go to the same
// place. It is the wrong place.
// :number: 0.138 = line "|u^0 - u^c| = {};"
// :number: 0.126 = line "|u^0| on the layer {}"

#include "antilock/exact/exact_norms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "course/course.hpp"

using namespace antilock;
using tutorial::Exact;

struct Discrete {
  // ### Mesh
  Space space;
  // ### Forms
  SceneSweep sweep{tutorial::paper_scene(0),
                   space};  // a1 and the factors of a0, assembled once for all ε
  SparseMatrix norm = h1_gram_matrix(space);  // the matrix of the norm
  // ### Solve
  Solution at(double epsilon) {  // u_h^ε; at ε = 0 this is (7) itself, not a small ε
    sweep.set_epsilon(epsilon);
    return sweep.solve();
  }
  double distance(const Solution& a, const Solution& b) const {
    return std::sqrt((a.u - b.u).dot(norm * (a.u - b.u)));
  }
  double stress(const Solution& a) const {
    return a.p.dot(sweep.problem().m.cwiseProduct(a.p));
  }  // ‖p‖^2
};

// Proposition 1, one method on one mesh: the distance to its own limit, and the stiff part
// of (5), $ε^2 ‖p‖^2$.
Table to_the_limit(const Method& method, int cells) {
  Discrete discrete{method.space(cells)};
  const Solution limit = discrete.at(0);
  Table rows({"method", "epsilon", "distance", "stiff", "stiff / (epsilon |p_h^0|)^2"});
  for (int k = 0; k <= 10; ++k) {
    const double epsilon = std::pow(10.0, -0.5 * k);
    const Solution u = discrete.at(epsilon);
    rows.add({method.name(), epsilon, discrete.distance(u, limit),
              epsilon * epsilon * discrete.stress(u),
              discrete.stress(u) / discrete.stress(limit)});
  }
  return rows;
}

Table exact_to_the_limit(const Table& epsilons, const Exact& limit) {
  Table rows({"method", "epsilon", "distance", "stiff", "stiff / (epsilon |p_h^0|)^2"});
  for (const TableEntry& epsilon : epsilons.unique("epsilon")) {
    const ExactSolution u(paper_sine_load(), epsilon.number(), true, 15);
    const double p = stress_norm(u);
    rows.add({"exact", epsilon, h1_distance(u, limit.solution),
              std::pow(epsilon.number() * p, 2),
              std::pow(p / stress_norm(limit.solution), 2)});
  }
  return rows;
}

// Proposition 3: the three terms of (18), and what they bound, along $ε = h^k$. No mesh
// enters $u^ε$ and the first term.
struct OnPath {
  int n;  // 1/h
  Exact exact;
  double first_term;
};

std::vector<OnPath> path(double k, int finest, const Exact& limit) {
  std::vector<OnPath> all;
  for (int n = 8; n <= finest; n *= 2) {
    Exact exact(tutorial::paper_scene(std::pow(n, -k)), 15);
    const double first_term = h1_distance(exact.solution, limit.solution);
    all.push_back({n, std::move(exact), first_term});
  }
  return all;
}

Table three_terms(const Method& method, const std::vector<OnPath>& path,
                  const Exact& limit) {
  Table rows({"method", "h", "term", "value"});
  for (const auto& [n, exact, first_term] : path) {
    Discrete discrete{method.space(n)};
    const Solution u = discrete.at(exact.epsilon), u0 = discrete.at(0);
    rows.add({method.name(), 1.0 / n, "first term", first_term});
    rows.add({method.name(), 1.0 / n, "second term", limit.errors(discrete.space, u0).h1});
    rows.add({method.name(), 1.0 / n, "third term", discrete.distance(u0, u)});
    rows.add({method.name(), 1.0 / n, "left side", exact.errors(discrete.space, u).h1});
  }
  return rows;
}

// Proposition 1: from 10^-3.5 on all methods are below h and below their own wall.
void judge_fixed_mesh(const std::string& name, const Table& own, tutorial::Report& report) {
  const Table small =
      own.filter_number("epsilon", [](double epsilon) { return epsilon < 4e-4; });
  report.claim_order(small, "distance", "epsilon", 1.95, 2.05,
                     name + ", Proposition 1 (proved), order 2 (observed)");
  report.claim_within(small.last("stiff / (epsilon |p_h^0|)^2"), 0.99, 1.01,
                      name + ", (5): stiff part / (epsilon |p_h^0|)^2 (proved):");
}

// Propositions 2 and 3, in h along $ε = h^2$. Where nothing locks: $ε^2 = h^4$ for the
// third term; h for the others.
void judge_path(const std::string& name, const Table& own, double lost,
                tutorial::Report& report) {
  const auto term = [&](const char* which) { return own.filter("term", which); };
  if (name != "P1 unstructured") {
    report.claim_order(term("second term"), "value", "h", 0.9, 1.1,
                       name + ", Proposition 2 (proved), order 1 (observed)");
    report.claim_order(term("third term"), "value", "h", 3.6, 4.2,
                       name + ", (19) (proved), order 4 (observed)");
    report.claim_order(term("left side"), "value", "h", 0.9, 1.1,
                       name + ", Proposition 3 (proved), order 1 (observed)");
    return;
  }
  Table rest({"h", "rest"});  // both parts of u^0 - u_h^0 are orthogonal but for O(h^2):
                              // what is lost, and a body's error
  for (const Table& row : term("second term").rows())
    rest.add({row.number("h"), std::pow(row.number("value"), 2) - lost * lost});
  report.claim_order(rest, "rest", "h", 1.7, 2.2,
                     name + ": (second term)^2 - |u^0 - u^c|^2 (observed)");
  report.claim_within(term("left side").last("value") / term("second term").last("value"),
                      0.95, 1.05,
                      name + ": the error over its second term tends to 1 (observed):");
  // it keeps the share 1 / (1 + rho) of the ridge, and at epsilon = h^2 rho is 1 / h on
  // these meshes (chapter 06)
  report.claim_order(term("third term"), "value", "h", 0.7, 2.1,
                     name + ": and yet the third term tends to 0 (observed)");
}

void propositions(const tutorial::Options& options, tutorial::Report& report) {
  const Exact limit(tutorial::paper_scene(0), 15);
  const std::vector<OnPath> h_squared = path(2, options.cells, limit);
  Table curves({"method", "epsilon", "distance", "stiff", "stiff / (epsilon |p_h^0|)^2"});
  Table terms({"method", "h", "term", "value"});
  for (const Method& method : methods()) {
    curves.add(to_the_limit(method, std::min(32, options.cells)));
    terms.add(three_terms(method, h_squared, limit));
  }
  curves.add(exact_to_the_limit(curves, limit));
  // ### Output
  curves.pivot("epsilon", "method", "distance").print("distance to the limit, H1");
  terms.filter("method", "P1 unstructured")
      .pivot("h", "term", "value")
      .print("(18) for locked P1, epsilon = h^2");
  fmt::print("  |u^0 - u^c| = {:.4f}; |u^0| on the layer {:.4f}\n",
             clamped_distance(limit.solution), layer_norm(limit.solution));
  terms.write(options.out / "terms.csv");
  curves.write(options.out / "limits.csv");
  for (const Method& method : methods()) {
    judge_fixed_mesh(method.name(), curves.filter("method", method.name()), report);
    judge_path(method.name(), terms.filter("method", method.name()),
               clamped_distance(limit.solution), report);
  }
}

// ## What came out
// :output: distance to the limit
//
// (a) The short waves: there are none beyond $1/h$. Locked P1 has the slope 2 as the others
// have, as soon as $ε$ is so small that it is locked. Before that its line is flat: there
// it loses the layer.
//
// (b) Only the second.
// :output: (18) for locked P1
// :figure: three_terms
//
// The second term tends to $‖u^0 - u^c‖$, and so does the error. (That the third term tends
// to 0 is observed here: chapter 06 proves how much P1 loses at most, and not that it loses
// as much.) A first look at the third column deceives: a method that has converged in $ε$
// need not be near anything.
//
// ## Exercises
//
// 1. Locked P1 along $ε = h$ in place of $h^2$: does its error still stay?
// 2. On paper: locked P1 on a fixed mesh, $ε → 0$. Where does $ε ‖p_h^ε‖$ go, and where
//    $‖p_h^ε‖$?
//
// ## Further reading
//
// - [Mosco 1969](../guides/bibliography.md#mosco-1969): solutions converge when their sets
//   do.
// - [Slimane and Renard 2004](../guides/bibliography.md#slimane-2004): Propositions 1 to 3
//   and their proofs.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "11_propositions",
                       "Propositions 1, 2, 3: the limits epsilon -> 0 and h -> 0",
                       {.takes_epsilon = false,
                        .cells = 64,
                        .least_cells = 16,
                        .most_cells = 256,
                        .exercises = exercises},
                       propositions);
}
