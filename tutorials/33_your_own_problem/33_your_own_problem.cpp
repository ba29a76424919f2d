// # A problem of your own
//
// Run: 33_your_own_problem                          two strings glued together, ε = 1e-10
// Run: 33_your_own_problem --epsilon 0 --cells 64   a rigid glue
// Run: 33_your_own_problem --exercise 1
//
// **Afterwards you can** describe a problem of your own by two forms and its bounds, count
// its kernel, and check the conditions of Theorem 4.
//
// Needs: [00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp) for strings,
// [07](../07_kernel/07_kernel.cpp) for kernels, [10](../10_limits/10_limits.cpp) for the
// class (1) and for coercive forms, [13](../13_uniform/13_uniform.cpp) for Theorem 4.
// **Here ε is the parameter of the class itself** ($ε^2$ in (23)).
//
// **The picture.** The energy that two glued strings release, against the compliance ε of
// the glue. *One choice of $B$ locks: as the glue hardens its strings stop moving. The
// other does not. One number, the dimension of the kernel, says so before anything is
// solved.*
//
// **Predict.** Two strings, one above the other, have corners at different places: one has
// $n$ cells, the other $n + 1$. (a) How many independent pairs of broken lines are equal
// everywhere and 0 at the ends? (b) The lower string has $n$ cells. If $u - w$ need only be
// orthogonal to its $n - 1$ hat functions, how many independent pairs are left?
//
// A second page of this chapter, in the track *Structures*, is about two bodies that touch.
// The same program runs both pages, and `touch` and `press` below belong to the second one.
//
// ## Two strings and a glue
//
// Nothing here is known to the library. The upper string $u$ is loaded by $q = 32$
// downwards. The lower one $w$ lies over an obstacle at $-g = -1/2$. Both have tension 1; a
// glue bonds them. Test functions: $v$ for $u$, $z$ for $w$.
//
// $$ a_1 = ∫ u' v' + ∫ w' z',   a_0 = ∫ (u - w)(v - z),   L = -q ∫ v,   K = \{ w ≥ -g \}. $$
//
// $u = w$ at every point leaves no pair: a broken line may bend at its own corners only,
// and the two share none. The other way is to ask less. A *mortar* asks for mean values
// only, $∫ (u - w) φ_i = 0$ with the hat functions $φ_i$ of the lower string. These are
// $n - 1$ conditions for $n + (n - 1)$ values. For each $u$ they fix the $n - 1$ values of
// $w$, which becomes a projection of $u$. So the $n$ values of $u$ stay free.
//
// ## A glue with four conditions
//
// The kernel tells of each method whether it must lock. It does not tell that the other one
// converges: functions may be left free in the wrong place (chapter 07). The mortar changes
// $a_0$ itself, to $a_{0h}(v, v) = \sum h d_i^2$ with the means
// $d_i = \frac{1}{h} ∫ (u - w) φ_i$. Theorem 4 is about one $a_0$.
// [Chapter 28](../28_mixed/28_mixed.cpp) proves it for another one, $a_{0h}$, if $K_h$
// approaches $K$ and four conditions hold: (i) $a_1 + a_{0h}$ is coercive with one
// constant; (ii) each element of $K_0$ is a limit of functions $v_h$ of $K_h$ with
// $a_{0h}(v_h, v_h) = 0$; (iii) weak limits of bounded functions whose $a_{0h}$ tends to 0
// lie in $G$; (iv) $a_{0h}$ tends to $a_0$. Here they are:
//
// - (i) $a_1$ is coercive alone, since both strings are held at their ends;
// - (ii) let $(u, u)$ with $u ≥ -g$ be given. Interpolate $u$ on the upper string, and let
//   the lower one be its projection, $∫ (I u - w_h) φ_i = 0$. $w_h$ tends to $u$ in $H^1$,
//   and so uniformly: it is below $-g$ by some $δ_h → 0$ at most. Add $2 δ_h$ times one
//   fixed smooth bump to the upper string, a bump that is 1 where $u < -g/2$, and project
//   again. The projection is linear, so $w_h$ grows by $2 δ_h$ times the projection of the
//   bump, which tends to the bump uniformly: for small $h$ it is at least ½ where
//   $u < -g/2$. So $w_h ≥ -g$ there. Elsewhere $w_h$ is near $u ≥ -g/2$. And $a_{0h} = 0$;
// - (iii), (iv) bounded pairs have a subsequence for which $u_h - w_h$ converges strongly
//   in $L^2$ (*Rellich*'s theorem). Means over a width of $2h$ then tend to the function
//   itself, and $a_{0h}$ to $a_0$.
//
// So the mortar converges uniformly in ε, with the obstacle (*proved*). For a problem of
// your own these are the four questions to answer. The kernel is the quick test before.
//
// **The truth** at ε = 0 is one string of tension 2: it lies on the obstacle over
// $[c, 1 - c]$ with $c = 2 (g/q)^{1/2}$, presses with $q (1 - 2c)$, and has the energy
// $q^2 c^3 / 3 - q g$.

#include <algorithm>
#include <cmath>

#include "antilock/analysis/hypotheses.hpp"
#include "antilock/analysis/kernel.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/two_bodies.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/models/two_bodies.hpp"
#include "antilock/solve/active_set.hpp"
#include "course/chapter.hpp"
#include "programs/report.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Strings, tutorial::sum_over_cells;

constexpr double load = 32, gap = 0.5, distance = 0.25;
const double free_part =
    2 * std::sqrt(gap / load);  // c: contact on [c, 1 - c] where the glue is rigid
enum class Glue { pointwise, mortar };

// ### Mesh
// `Strings` numbers the unknowns: those of the upper string ($n + 1$ cells; $n$ in exercise
// 1), then the lower.
//
// ### Forms
// $B$ and $M$: $a_0(u, v) = (B u)^T M (B v)$. `difference` is $u - w$ at a point, as a row
// over the unknowns.
void fill_glue(const Strings& s, Glue glue, VariationalInequality& problem) {
  const std::vector<tutorial::Place> points = tutorial::gauss_points(s);
  const Eigen::Index rows =
      glue == Glue::pointwise ? static_cast<Eigen::Index>(points.size()) : s.cells - 1;
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(rows, s.size());
  problem.m = Eigen::VectorXd::Constant(rows, 1.0 / s.cells);
  for (Eigen::Index q = 0; const auto& [x, weight] : points) {
    const Eigen::RowVectorXd difference = tutorial::difference(s, x);
    if (glue == Glue::pointwise)  // one row per point: a0 is the integral itself
      b.row(q) = difference, problem.m(q++) = weight;
    else  // one row per hat function of the lower string: (1/h) int (u - w) hat
      for (int i = 1; i < s.cells; ++i)
        b.row(i - 1) += weight * tutorial::hat(s.cells, i, x) * s.cells * difference;
  }
  problem.b = b.sparseView();
}

// With $A_1$, load, what is held and what is bounded from below, that is all that the
// solver sees. (`Bounds` also holds bounds from above, bounds on sums (below), and bounds
// that bear a given force only ([friction](../30_friction/30_friction.cpp)). One more field
// holds the compliances of those rows of $B$ that do not vary with ε.)
VariationalInequality held_strings(const Strings& s) {
  VariationalInequality problem;
  problem.a1 = sum_over_cells(s, 1, 0);
  problem.load = Eigen::VectorXd::Zero(s.size());
  for (int i = 1; i < s.upper_cells(); ++i)
    problem.load(s.upper(i)) = -load / s.upper_cells();
  problem.dirichlet_dofs = {s.upper(0), s.upper(s.upper_cells()), s.lower(0),
                            s.lower(s.cells)};
  problem.dirichlet_values = Eigen::VectorXd::Zero(4);
  return problem;
}

VariationalInequality make_problem(const Strings& s, Glue glue, double epsilon) {
  VariationalInequality problem = held_strings(s);
  fill_glue(s, glue, problem);
  problem.compliance = epsilon;
  problem.bounds =
      Bounds::lower_on(s.inside_lower(), Eigen::VectorXd::Constant(s.cells - 1, -gap));
  return problem;
}

void judge(Glue glue, const Hypotheses& h, int finer_kernel, int cells, const Table& rigid,
           tutorial::Report& report);
void touch(const tutorial::Options& options, tutorial::Report& report);
void press(const tutorial::Options& options, tutorial::Report& report);

void own(const tutorial::Options& options, tutorial::Report& report) {
  const Strings strings{options.cells}, finer{2 * options.cells};
  Table released({"glue", "epsilon", "released", "corrections"});
  for (const Glue glue : {Glue::pointwise, Glue::mortar}) {
    const std::string name =
        glue == Glue::pointwise ? "glue at every point" : "glue against hat functions";
    const VariationalInequality problem = make_problem(strings, glue, options.epsilon);
    // The hypotheses: coercive, a kernel that grows from mesh to mesh, K and G meet. The
    // energy as the glue hardens.
    const Hypotheses h = check_hypotheses(problem, sum_over_cells(strings, 1, 1));
    const int finer_kernel = kernel_dimension(make_problem(finer, glue, options.epsilon));
    const Table rows = tutorial::energies(problem);
    for (const Table& row : rows.rows())
      released.add(
          {name, row.number("epsilon"), -row.number("energy"), row.number("corrections")});
    // ### Solve
    // At the ε asked for, with its KKT report
    // ([00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp)): how well the
    // conditions hold.
    const Solution solution = active_set(problem);
    tutorial::print_glue(name, h, finer_kernel, rows, solution, load * (1 - 2 * free_part));
    judge(glue, h, finer_kernel, options.cells, rows.filter("epsilon", 0), report);
  }
  // ### Output
  released.write(options.out / "energies.csv");
  // One end raised: at ε = 0 K and G do not meet, and the problem has no solution.
  VariationalInequality impossible = make_problem(strings, Glue::pointwise, 0);
  impossible.dirichlet_values(0) = 0.1;
  const double apart = distance_to_kernel(impossible);
  const std::string refusal = tutorial::refusal(impossible);
  report.claim(apart > 1e-3 && !refusal.empty(),
               "(observed) strings held 0.1 apart: K and G are {:.2g} from meeting; the "
               "solver says: {}",
               apart, refusal);
  touch(options, report);  // the second page
  press(options, report);
}

void judge(Glue glue, const Hypotheses& h, int finer_kernel, int cells, const Table& rigid,
           tutorial::Report& report) {
  const double exact = load * load * std::pow(free_part, 3) / 3 - load * gap, n = cells,
               found = rigid.number("energy");
  report.claim(h.coercive() && h.intersects_kernel(),
               "(proved) the hypotheses hold: (H1) and K meets G");
  if (glue == Glue::pointwise)
    return report.claim(
        h.kernel == 0 && finer_kernel == 0 && rigid.number("max |u|") < 1e-6,
        "(proved) no function is left free on any mesh: it locks, energy {:.1e} in place "
        "of {:.3f}",
        found, exact);
  report.claim(h.kernel == cells && finer_kernel == 2 * cells,
               "(proved) {} functions are left free, {} on the finer mesh", h.kernel,
               finer_kernel);
  // P1 on one string of tension 2 misses int (u - u_h)'^2 of the energy, with u'' = q / 2
  // on its free parts, of length 2c.
  const double missed = std::pow(load / 2, 2) / (12 * n * n) * 2 * free_part;
  report.claim_within((found - exact) / missed, 0.5, 1.5,
                      fmt::format("(observed) energy {:.4f} at epsilon = 0, truth {:.4f}: "
                                  "off, over what one P1 string misses",
                                  found, exact));
  report.claim(rigid.number("corrections") <= 5, "(observed) and {} corrections are enough",
               rigid.number("corrections"));
}

// ## What came out
//
// (a) None but 0, on any mesh: the energy is 0 in place of -10.667. (b) $n$, and $2n$ on
// the finer mesh: the truth is met, up to what P1 misses on one string of tension 2,
// $q^2 h^2 c/24$. Strings held 0.1 apart have no solution at ε = 0: the solver refuses, and
// says why.
// :number: -10.667 = line "in place of {}"
//
// ## Exercises
//
// 1. Give both strings $n$ cells. Does the glue at every point still lock?
//
// **A problem of your own.** Replace $A_1$, $B$, $M$, load and bounds. The checks need no
// truth: `check_hypotheses` answers for one mesh what a matrix can answer, whether the form
// is coercive, how large the kernel is, and whether $K$ and $G$ meet. Ask it on two meshes.
//
// ## Further reading
//
// - [Wohlmuth 2011](../guides/bibliography.md#wohlmuth-2011): mortar methods.

// :page: 33_two_bodies
// # Two bodies that touch
//
// Run: 33_your_own_problem --exercise 2
//
// **Afterwards you can** couple two bodies whose meshes do not match by constraints, and
// check them by a patch test.
//
// Needs: [33](../33_your_own_problem/33_your_own_problem.cpp) for the two strings and the
// mortar, [07](../07_kernel/07_kernel.cpp) for the layer that P1 cannot move.
//
// **The picture.** Two strings that touch, above a floor. *The forces are right. The
// pressure between them is not, because their corners do not match.*
//
// :figure: touching_strings
//
// **Predict.** (a) Without glue, the upper string is pressed onto the lower one, and that
// one onto the floor. Which force is larger, the one between the strings or that of the
// floor? (b) Two blocks are pressed together so that the exact pressure between them is 1.
// Their meshes do not match. Each corner of one mesh must stay on its side of the other
// (*node to segment*). By how much is its pressure wrong, and is it better on finer meshes?
// (c) The stiff layer of the course lies between two blocks. Which share of the force
// passes through it for P1, where its mesh has no columns?
//
// ## Two strings that only touch
//
// A contact between two bodies bounds no unknown: it bounds a difference of unknowns. Take
// the glue away, and let the lower string hang $d = 1/4$ below the upper one, and $d$ above
// the floor. The strings cannot pass through each other:
//
// $$ K = \{ w ≥ -d,   u - w ≥ -d \}. $$
//
// The corners of the strings do not match. Therefore each corner $x_i$ of the lower string
// gets one *constraint*, a row $c$ over the unknowns with $c · (u, w) = u(x_i) - w(x_i)$.
// It contains two corners of the upper string. Engineers call this *node to segment*. The
// bounds list the bounded unknowns first and the constraints after them, and the contact
// forces $λ$ have the same order.
VariationalInequality touching(const Strings& s) {
  const int n =
      s.cells - 1;  // one bound at the floor and one between the strings per inner corner
  VariationalInequality problem = held_strings(s);
  problem.b = RowMatrix(0, s.size());  // nothing is stiff
  Eigen::MatrixXd rows(n, s.size());
  for (int i = 1; i < s.cells; ++i) rows.row(i - 1) = tutorial::difference(s, s.corner(i));
  problem.bounds =
      Bounds(s.inside_lower(), BoundLimits(Eigen::VectorXd::Constant(2 * n, -distance)),
             RowMatrix(rows.sparseView()));
  return problem;
}

// **The truth.** Between the wall and $c_1$ the strings are apart: $u'' = q$ and $w'' = 0$.
// From $c_1$ to $c_2$ they touch and move together, like one string of tension 2. From
// $c_2$ on the lower one lies on the floor. Heights and slopes are the same on both sides
// of $c_1$ and of $c_2$. (A jump of the slope would be a force at a point. It would part
// the slopes of the strings, and $u - w$ would be negative beside that point.) So
// $u - w + d = q (c_1 - x)^2 / 2$ left of $c_1$. At the wall this is $d$:
//
// $$ c_1 = (2d/q)^{1/2},   \frac{q}{4} s^2 + \frac{q}{2} c_1 s = d,   s = c_2 - c_1. $$
//
// The second equation is the height of the floor. The lower string falls by $q c_1 s / 2$
// up to $c_1$, as its slope there is $-q s / 2$, and by $q s^2 / 4$ from there to $c_2$.
// The floor carries $q (1 - 2 c_2)$. Between the strings there are $q/2$ per length on both
// pieces of length $s$, and $q$ above the floor.
void touch(const tutorial::Options& options, tutorial::Report& report) {
  const double c1 = std::sqrt(2 * distance / load);
  const double s = std::sqrt(c1 * c1 + 4 * distance / load) - c1;
  const double of_floor = load * (1 - 2 * (c1 + s)), between = of_floor + load * s;
  Table rates({"cells", "h", "force of the floor", "force between the strings"});
  for (int cells = options.cells; cells <= 8 * options.cells; cells *= 2) {
    const Strings strings{cells};
    const VariationalInequality problem = touching(strings);
    const Solution solution = active_set(problem);
    const Eigen::VectorXd floor = solution.lambda.head(cells - 1),
                          pair = solution.lambda.tail(cells - 1);
    rates.add({cells, 1.0 / cells, std::abs(floor.sum() - of_floor),
               std::abs(pair.sum() - between)});
    if (cells == options.cells)
      tutorial::touching_table(strings, solution.u, pair, floor, distance)
          .write(options.out / "touching.csv");
  }
  rates.print("two strings that only touch: errors of the two contact forces");
  double worst = 0;
  for (const Table& row : rates.rows()) {
    const double error =
        std::max(row.number("force of the floor"), row.number("force between the strings"));
    worst = std::max(worst, error / std::pow(row.number("h"), 2));
  }
  // 43 at most for 4 to 128 cells
  report.claim(worst < 2 * load,
               "(observed) both contact forces are right to {:.2g} h^2, below 2 q h^2",
               worst);
}

// ## Two blocks whose meshes do not match
//
// For two bodies in the plane the library has the constraints. One side of the interface is
// the *slave*: each of its unknowns gets a constraint. The other side is the *master*. With
// the jump $[u] = u_{above} - u_{below}$ and the distance $g$ of the bodies,
//
// $$ [u]\,(x_i) ≥ -g(x_i)   \text{ (node to segment)},   ∫ ψ_i [u] ≥ -∫ ψ_i g   \text{ (mortar)}. $$
//
// On the first page the mortar had hat functions for $ψ_i$. Here they are *dual* to the
// hats $φ_j$ of the slave: $∫ ψ_i φ_j = 0$ for $i ≠ j$, so that each constraint contains
// one slave unknown only. On an edge with the hats $a$ and $b$ they are $2a - b$ and
// $2b - a$. For Crouzeix-Raviart, whose unknown is a mean over an edge, $ψ_i$ is 1 on one
// slave edge.
//
// **A patch test.** Two blocks overlap by 2 before they are brought together: $g = -2$.
// Their far ends are held at 0, and their sides are free. The truth is $u = 1 - y$ above
// and $u = -1 - y$ below, with the pressure 1. Both meshes contain these functions. So a
// method finds them if its forces do the work of a constant pressure on each test function
// $v$: $\sum_i λ_i c_i · v = ∫ [v]$ for $λ_i = ∫ ψ_i$, with $c_i$ the row that takes the
// mean. The left side is $\sum_i ∫ ψ_i [v]$, and the $ψ_i$ of the mortar sum to 1
// (*proved*). Node to segment replaces $∫ v$ on the master by a rule whose points lie at
// the slave's corners. It is not exact for the hats of the master.
struct Interface {
  Eigen::MatrixX3d table;  // x, distance and pressure of each constraint
  double force;
};

Interface solve_blocks(const Scene& scene, const TwoBodyContact& contact,
                       const TriangleMesh& mesh, const Element& element) {
  const Space space(mesh, element);
  const VariationalInequality problem = assemble(scene, contact, space);
  const Solution solution = active_set(problem);
  const InterfaceConstraints constraints =
      interface_constraints(space, contact.slave, contact.master, contact.method);
  return {interface_table(constraints, problem.bounds, solution.u, solution.lambda),
          solution.lambda.sum()};
}

Interface press_fit(int cells, InterfaceMethod method) {
  const Scene scene({[](double, double) { return 0; }}, NoLayer{}, {},
                    {{"above"}, {"below"}});
  const TwoBodyContact contact{lower_side, upper_side, [](double, double) { return -2; },
                               method};
  return solve_blocks(scene, contact,
                      two_body_mesh(with_free_sides(structured_mesh(3 * cells / 2, {0})),
                                    with_free_sides(structured_mesh(cells, {0}))),
                      p1());
}

// **A layer between them.** Now all outer sides are held, the upper block bears the load 10
// downwards, and below it is the layer of the paper, stretched to depth 1, with ε = 1e-6. The
// lower block is pressed by the layer alone. Where the layer's mesh has no vertical edges, P1
// cannot move it (chapter 07).
Interface through_layer(const TriangleMesh& upper, int cells, const Element& element) {
  const Scene scene({[](double, double y) { return y > 0 ? -10 : 0; }}, StiffLayer{1e-6},
                    {}, {{"above"}, {"below"}});
  return solve_blocks(scene, {lower_side, upper_side},
                      two_body_mesh(upper, structured_mesh(cells, {0})), element);
}

void press(const tutorial::Options& options, tutorial::Report& report) {
  const int cells =
      std::min(options.cells, 32);  // of the lower block; the upper has 3/2 times as many
  const Interface mortar = press_fit(cells, InterfaceMethod::mortar);
  const Interface nodes = press_fit(cells, InterfaceMethod::node_to_segment);
  const Interface finer = press_fit(2 * cells, InterfaceMethod::node_to_segment);
  const auto error = [](const Interface& found) {
    return (found.table.col(2).array() - 1).abs().maxCoeff();
  };
  report.claim(error(mortar) < 1e-10, "(proved) mortar: the pressure is off by {:.1e}",
               error(mortar));
  report.claim(
      error(nodes) > 0.02 && error(finer) > 0.5 * error(nodes),
      "(observed) node to segment: off by {:.3f}, and by {:.3f} on the finer meshes",
      error(nodes), error(finer));
  const int above = 3 * cells / 2;
  const TriangleMesh rows = rows_mesh(above, above);
  const Interface locked = through_layer(rows, cells, p1());
  const Interface nonconforming = through_layer(rows, cells, crouzeix_raviart());
  const Interface columns = through_layer(structured_mesh(above), cells, p1());
  tutorial::blocks_table(mortar.table, nodes.table, locked.table, nonconforming.table,
                         columns.table)
      .write(options.out / "blocks.csv");
  report.claim(locked.force < 1e-3 * columns.force,
               "(observed) the force through the layer: P1 without columns {:.1e}",
               locked.force);
  const double allowed = 10.0 / (cells * cells);  // 7.7 h^2 at most for 4 to 32 cells
  report.claim_within(nonconforming.force / columns.force, 1 - allowed, 1 + allowed,
                      fmt::format("(observed) Crouzeix-Raviart {:.3f}, P1 with columns "
                                  "{:.3f}: their ratio",
                                  nonconforming.force, columns.force));
}

// ## What came out
//
// (a) The force between the strings: the lower string hands most of it to the floor, and
// hangs on its ends with the rest, $q s$. Both forces are right to order $h^2$. The
// pressure between the strings is not: it wavers by a tenth around $q/2$ and $q$, since the
// corner of one string stands now in the middle of a cell of the other and now at its end.
// This is the known price of node to segment. Exercise 2 removes it.
//
// (b) By 16 % with 2 cells of the slave opposite 3 of the master, and it is no better on
// the finer meshes: the pressure alternates, as a corner of the slave stands at a corner of
// the master or in the middle of a cell. The mortar finds 1 to round-off. (c) None of it,
// at ε = 1e-6: below the layer the pressure is 0, and the lower block does not move. The
// constraints are not to blame. With the same ones the force through the layer is 0.471 for
// Crouzeix-Raviart and 0.475 for P1 in columns.
// :number: 0.471 = line "(observed) Crouzeix-Raviart {}"
// :number: 0.475 = line "P1 with columns {}"
//
// :figure: two_blocks
//
// ## Exercises
//
// 2. Give both strings that only touch $n$ cells. Is the pressure between them smooth?
//
// ## Further reading
//
// - [Wohlmuth 2011](../guides/bibliography.md#wohlmuth-2011): two bodies whose meshes do
//   not match: mortar methods.
// - [Chouly, Hild and Renard 2023](../guides/bibliography.md#chouly-2023): contact of two
//   bodies, and Nitsche's method.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "33_your_own_problem",
      "Your own problem in the class: two strings and a stiff glue",
      {.epsilon = 1e-10,
       .epsilon_is =
           "the class parameter of (1), the compliance of the glue; 0 is a rigid glue",
       .least_cells = 4,
       .most_cells = 128,
       .exercises = exercises},
      own);
}
