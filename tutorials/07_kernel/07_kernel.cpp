// # Why P1 locks: the kernel
//
// Run: 07_kernel                counts to 1/h = 32; some seconds
// Run: 07_kernel --cells 16
// Run: 07_kernel --exercise 1
// Run: 07_kernel --exercise 2
//
// **Afterwards you can** count the kernel of a method on the layer by a rank, prove why it
// must grow, and decide on two meshes whether a method locks.
//
// Needs: [02](../02_meshes/02_meshes.cpp) (kernel, ties),
// [03](../03_by_hand/03_by_hand.cpp) (B), [05](../05_p1_structured/05_p1_structured.cpp)
// (Theorem 4), [06](../06_p1_unstructured/06_p1_unstructured.cpp) (locking).
//
// **The picture.** One function of the kernel, and what is left of $\sin πx$ in it, for
// three methods. *What is not in the kernel cannot survive ε → 0.*
//
// :figure: kernel
//
// **Predict.** (a) P2, quadratic functions, on the unstructured mesh: is its kernel 0 on
// the layer, too? (b) Move every vertex of the structured mesh by a millionth of $h$: does
// P1 lock?
//
// ## What decides
//
// In the limit the answer lies in $G_h = \{ v ∈ V_h : ∂_y v = 0 \text{ in the layer} \}$.
// It holds all functions of the body that are 0 on $Σ$, on every mesh: its full dimension
// tells nothing. What counts is **the kernel on the layer**, and **whether it grows under
// refinement**.
//
// Why must it grow? Suppose that it has at most $m$ dimensions on every mesh, and take
// $m + 1$ loads whose limits $u^0$ are independent functions on the layer. There are such
// loads, because $K_0$ holds infinitely many functions of $x$. On each mesh the $m + 1$
// discrete limits lie in a space of $m$ dimensions, so one of their combinations is 0.
// Scale its coefficients so that their squares sum to 1. Then on finer and finer meshes a
// subsequence of these coefficients converges. If all $m + 1$ discrete limits converged,
// the combination of the exact limits with these last coefficients would be 0, too. But the
// exact limits are independent. So *for some load* the method does not converge at ε = 0:
// it locks. (Growth is necessary and not sufficient. If the kernel grows in the left half
// of the layer alone, the method locks in the right half.)
//
// Count it by algebra: the columns of $B$ that belong to unknowns of the layer that are not
// clamped, less their rank. In the table P2 are the continuous functions that are quadratic
// on each triangle. CR, the element of Crouzeix and Raviart, is affine on each triangle and
// continuous at the midpoints of the edges only: one unknown per edge
// ([08](../08_crouzeix_raviart/08_crouzeix_raviart.cpp) draws it). $N_T$ is the number of
// triangles of the layer.
//
// | method | dimension on the layer | why |
// |---|---|---|
// | P1, structured, $1/h = n$ | $n - 1$ | one hat per inner vertical line |
// | P1, unstructured | 0 | one group of tied triangles, 0 at both ends |
// | P2, unstructured | 1 | $∂_y v = 0$ leaves $v = a + b x + c x^2$: $x(1 - x)$, however small $h$ is |
// | CR, equal spacing at the sides | $N_T/2$ | 3/2 free edges per layer triangle, less one condition per triangle |
//
// (An inner edge belongs to two triangles: 3/2 per triangle. Of the boundary edges those on
// the two sides are clamped and those on top and bottom are free. They are equally many on
// the meshes of this square, so 3/2 is exact.)
//
// No condition of CR follows from the others. Take any number $g_T$ per layer triangle, put
// $v(x, y) = ∫_{-1}^y g(x, s) ds$, and give to each edge that is not vertical the mean of
// $v$ over it, and 0 to the vertical ones. Integrate $∂_y v$ over a triangle: by Green's
// formula only the means over its edges that are not vertical count. So this CR function
// has on $T$ the slope $g_T$. Every choice of slopes is reached, hence the $N_T$ conditions
// are independent (proved).
//
// What survives on $Γ_C$, when ε → 0, is a function of this kernel. Choose a method, and
// see how much of $\sin πx$ is left when its values at the unknowns of the layer are
// projected onto the kernel:
//
// :live: kernel

#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/locking.hpp"
#include "antilock/analysis/solve.hpp"
#include "antilock/study/scene_sweep.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;

const Scene scene = tutorial::paper_scene(0);
const Method p1_columns{&p1(), structured()}, p1_any{&p1(), unstructured()},
    p2_any{&p2(), unstructured()}, cr_columns{&crouzeix_raviart(), structured()},
    cr_any{&crouzeix_raviart(), unstructured()};
const std::vector<Method> all{p1_columns, p1_any, p2_any, cr_columns, cr_any};

// ### Solve
// What the table above predicts, and what the rank says.
Table count_kernels(int finest) {
  Table counts({"cells", "method", "kernel", "predicted"});
  for (int n = 4; n <= finest; n *= 2)
    for (const Method& method : all) {
      const Space space = method.space(n);
      const auto triangles =
          std::count(space.mesh().region.begin(), space.mesh().region.end(), Region::layer);
      const int p = method.element->degree();
      const double predicted = !method.element->conforming()
                                   ? 0.5 * static_cast<double>(triangles)
                               : method.family.name == "structured" ? n * p - 1
                                                                    : p - 1;
      counts.add(
          {n, method.name(), layer_kernel_dimension(assemble(scene, space)), predicted});
    }
  return counts;
}

// The library's diagnosis: it counts on two meshes how many independent motions of $Γ_C$
// the kernel allows.
LockingDiagnosis diagnose(const Method& method) {
  return diagnose_locking(assemble(scene, method.space(4)),
                          assemble(scene, method.space(8)));
}

// A count that does not grow says that a method locks, and none says what that costs. The
// answer itself does, with the same line that `run_scene` prints and chapters
// [05](../05_p1_structured/05_p1_structured.cpp) and
// [06](../06_p1_unstructured/06_p1_unstructured.cpp) do.
LockingReport cost(const Method& method) { return *solve(scene, method.space(8)).locking; }

// From Figure 3 to Figure 6: every inner vertex is moved by up to $t h$, at random. The
// kernel on the layer is 0 at the first $t > 0$. But
// [chapter 06](../06_p1_unstructured/06_p1_unstructured.cpp) says what a small error costs:
// a triangle whose vertical edge leans by $t h$ has a bending length $k_T$ of the size of
// $t h$, and lost over kept is $(5.84 k/ε)^2$. So the loss grows like $(t h/ε)^2$, until
// all is lost. Locking comes little by little; its cause does not.
Table jitter_study(int n) {
  Table table({"t", "epsilon", "kernel", "lost", "lost_to_kept", "law"});
  ActiveSetOptions patient;  // functions that are almost in the kernel are corrected slowly
  patient.corrections.max_corrections = 5000;
  for (const double epsilon : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const tutorial::Exact exact(tutorial::paper_scene(epsilon));
    for (const double t :
         {1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.2}) {
      const Space space(jittered_mesh(n, t), p1());
      SceneSweep sweep(scene, space);
      sweep.set_epsilon(epsilon);
      const double lost = exact.errors(space, sweep.solve(patient)).max_at_unknowns /
                          exact.solution.max_on_contact();
      table.add({t, epsilon, layer_kernel_dimension(sweep.problem()), lost,
                 lost / (1 - lost),
                 std::pow(5.836 * bending_length(space.mesh()) / epsilon, 2)});
    }
  }
  return table;
}

void explain(const tutorial::Options& options, tutorial::Report& report) {
  const Table counts = count_kernels(options.cells), jitter = jitter_study(16);
  // ### Output
  for (const Method& method : {p1_columns, p1_any, cr_any})
    tutorial::draw_kernel(options.out, method.space(8), method.name());
  counts.pivot("cells", "method", "kernel").print("dimension of the kernel on the layer");
  jitter.pivot("t", "epsilon", "lost")
      .print("moved by t h: share of the layer's displacement that is lost, by epsilon");
  jitter.write(options.out / "jitter.csv");
  fmt::print("what the library says\n");
  bool same = true;
  for (const Method& method : all) {
    const LockingDiagnosis counted = diagnose(method);
    const LockingReport layer = cost(method);
    fmt::print("  {:<16} {}\n  layer: {}\n", method.name(), counted.text(), layer.text());
    same = same && counted.locks() == !layer.warning.empty();
  }
  fmt::print("\n");

  report.claim(counts.numbers("kernel") == counts.numbers("predicted"),
               "every count is the predicted one (proved)");
  report.claim(diagnose(p1_any).locks() && diagnose(p2_any).locks() &&
                   !diagnose(p1_columns).locks() && !diagnose(cr_columns).locks() &&
                   !diagnose(cr_any).locks(),
               "the kernel on the layer does not grow for P1 and P2 unstructured, and "
               "grows for the others (proved)");
  report.claim(same,
               "warned of what they cost are the answers of those that do not grow, and no "
               "other (observed)");
  report.claim(jitter.max("kernel") == 0,
               "the kernel on the layer is 0 at the first t = 1e-6 (proved)");
  // The law is that of chapter 06, made without contact. Where most is lost, contact leaves
  // 1.46 times as much, and u_h leans on the better triangles. Where less than a tenth is
  // lost, or all but a tenth, the usual error of P1 hides it.
  Table some({"t", "epsilon", "off"});
  for (const Table& row :
       jitter.filter_number("lost_to_kept", [](double x) { return x > 0.1 && x < 12; })
           .rows())
    some.add({row.number("t"), row.number("epsilon"),
              row.number("lost_to_kept") / row.number("law")});
  report.claim(some.size() >= 12 && some.min("off") > 0.4 && some.max("off") < 1.2,
               "lost / kept over (5.84 k / epsilon)^2: {:.2f} to {:.2f} at {} places "
               "(observed; accepted 0.4 to 1.2)",
               some.min("off"), some.max("off"), some.size());
}

// ## What came out
//
// :output: dimension of the kernel
//
// (a) No, 1 parabola is left; but it stays one when $h$ falls, and P2 locks too, unless
// $u^0$ happens to be that parabola. At $1/h = 32$ structured P1 has 31 functions, and CR
// on the unstructured mesh 1200.
// :number: 1 = table "dimension of the kernel" "P2 unstructured" cells=32
// :number: 31 = table "dimension of the kernel" "P1 structured" cells=32
// :number: 1200 = table "dimension of the kernel" "CR unstructured" cells=32
//
// (b) Yes, as $ε → 0$ on this mesh: the kernel on the layer is 0, so at $ε = 0$ all is
// lost. At $ε = 10^{-3}$ a millionth of $h$ costs nothing yet, since $k$ is small against
// ε: 2.754 % of the displacement is lost, as at every ε of the table, because the mesh is
// coarse. A ten-thousandth of $h$ costs 60 % at $ε = 10^{-5}$.
// :number: 2.754 = 100 * table "moved by t h" 0.001 t=1e-06
// :number: 60 = 100 * table "moved by t h" 1e-05 t=0.0001
//
// :output: what the library says
//
// The library asks two coarse meshes, $1/h$ = 4 and 8. A *bound* is a condition of contact,
// one per unknown on $Γ_C$, and a motion *without strain* is one that the stiff form does
// not see. So "3 of 3, then 7 of 7" says: the values at all 3, then at all 7 free points of
// $Γ_C$ can be chosen freely without a strain. "0 of 3, then 0 of 7" says that none of them
// can. A *compliance* is here $ε^2$, one over the stiffness of the layer.
//
// :figure: jitter
//
// :output: moved by
//
// ## Exercises
//
// 1. The staggered mesh of chapter 02 is as regular as the others. The kernel on its layer,
//    for P1 and for CR?
// 2. $ε = 0$, and vertices moved by a millionth of $h$. How much of the displacement is
//    lost?
// 3. On paper: P3 on one group of tied triangles: which functions of $x$ are left?
//
// ## Further reading
//
// - [Babuška and Suri 1992](../guides/bibliography.md#babuska-1992): kernels, and why they
//   must be rich enough.
// - [Boffi, Brezzi and Fortin 2013](../guides/bibliography.md#boffi-2013): the kernel of a
//   discrete operator, and what else convergence needs.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "07_kernel", "Why P1 locks: the kernel of a0, counted, drawn and emptied",
      {.takes_epsilon = false, .least_cells = 4, .most_cells = 64, .exercises = exercises},
      explain);
}
