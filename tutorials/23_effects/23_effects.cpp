// # A scene costs what it holds
//
// Run: 23_effects   five scenes, three models, a change of variable; two seconds
// Run: 23_effects --cells 16 --epsilon 0.1
// Run: 23_effects --exercise 1
// Run: 23_effects --exercise 2
//
// Needs: [01](../01_domain/01_domain.cpp) for (22), (23),
// [03](../03_by_hand/03_by_hand.cpp) for corrections, [10](../10_limits/10_limits.cpp) for
// (25).
//
// **The picture.** One body under one load, five times: alone; on an obstacle; held by a
// stiff layer that is not meshed; with the layer meshed below it; with layer and
// obstacle. *The free lower side of the body moves by 0.25. Glue a layer under it that is
// rigid across its thickness, and it moves by 0.035: it is held as by a stretched string.*
// :number: 0.25 = table "what each scene costs" u_max scene=1_body
//
// **Predict.** (a) The layer of (25) is one term on $Σ$. How many triangles, unknowns and
// linear solves does it cost more than the body alone? (b) The values ε = 1e-1, 1e-3, 1e-4,
// 1e-6, 1e-8, 1e-12 and 0 on one mesh: how many factorisations, if all those whose square
// is below the penalty $δ = 6·10^{-8}$ of chapter 18 share one?
//
// ## The parts of the inequality (23)
//
// $$ \underbrace{a^+(u, v-u)}_{\text{body}} + \underbrace{(a_x^- + ε^{-2} a_y^-)(u, v-u)}_{\text{layer}} ≥ (f, v-u). $$
//
// - no contact: $K$ is a space. Put $v = u + w$ and $v = u - w$ into the inequality: $≥$
//   becomes $=$, one linear solve;
// - no layer: $a^+$ alone, on the body's mesh alone;
// - ε = 0: (24), the layer can only follow $Σ$: $u(x, y) = u(x, 0)$ there;
// - and then it need not be meshed: $a_x^-$ on functions of $x$ is $∫_Σ ∂_x u ∂_x v$, the
//   condition of Ventcel, (25);
// - before the change of variable $y → y/ε$ the layer is $(0,1) × (-ε,0)$ and $1/ε$ times
//   as stiff: (22).
//
// Each of these is a type (`scene/scene.hpp`), so that an effect that is not in a scene
// costs nothing: there is no code to skip. Contact has a *gap*, the distance between
// undeformed body and obstacle at $x$: $u ≥ -$gap.
//
// ## When is the limit good enough?
//
// (24) and (25) have the solution $u^0$ in place of $u^ε$. How far is it? Write both
// problems with their layer stresses and contact pressures, subtract, and test with
// $d = u^0 - u^ε$. The work of the pressures on $d$ is
// $∫ (λ^0 - λ^ε) d = -∫ λ^0 u^ε - ∫ λ^ε u^0$, because $λ u = 0$ for each. It is not
// positive, so
//
// $$ a_1(d, d) + (p^0 - p^ε, ∂_y d) ≤ 0. $$
//
// In the layer $∂_y u^0 = 0$, hence $∂_y d = -ε^2 p^ε$, and the energy of $d$ is
// $|d|_{a^ε}^2 = a_1(d, d) - (p^ε, ∂_y d)$. By the last line this is at most
// $-(p^0, ∂_y d) ≤ ‖p^0‖ ‖∂_y d‖$, and $‖∂_y d‖ ≤ ε |d|_{a^ε}$. Therefore (proved)
//
// $$ |u^0 - u^ε|_{a^ε} ≤ ε ‖p^0‖. $$
//
// The right side is known as soon as the limit is solved. For our load $‖p^0‖$ is 0.79. By
// [chapter 10](../10_limits/10_limits.cpp) the quotient of both squares tends to 1 as ε
// falls (observed), so the bound cannot be improved by a factor.

#include "antilock/study/scene_sweep.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Exact, tutorial::Run;

const Body body{paper_load};
const UnilateralContact obstacle{};

// **Five scenes**, from plain Laplace to a stiff layer with contact.
void each_scene_costs_what_it_holds(const tutorial::Options& options,
                                    tutorial::Report& report) {
  const std::vector<std::pair<std::string, Scene>> scenes{
      {"1_body", Scene(body)},
      {"2_body_contact", Scene(body, NoLayer{}, obstacle)},
      {"3_ventcel", Scene(body, VentcelLayer{})},
      {"4_layer", Scene(body, StiffLayer{options.epsilon})},
      {"5_layer_contact", Scene(body, StiffLayer{options.epsilon}, obstacle)}};
  Table table(tutorial::cost_columns);
  for (const auto& [name, scene] : scenes) {
    // ### Mesh
    // As large as the scene needs: its layer_depth is 0 where no layer is meshed.
    TriangleMesh mesh = unstructured_mesh(options.cells, {scene.layer_depth()});
    // ### Forms
    // ### Solve
    // A `Run` assembles what the scene holds and solves it, by Crouzeix-Raviart and the
    // active set.
    const Run run(scene, std::move(mesh));
    table.add(tutorial::costs(name, run));
    tutorial::write_results(options.out / name, {run.space, run.problem, run.solution});
  }
  // ### Output
  table.print("what each scene costs", 3);
  table.write(options.out / "results.csv");
  const Table alone = table.filter("scene", "1_body"),
              ventcel = table.filter("scene", "3_ventcel");
  report.claim(alone.number("solves") == 1 && alone.number("contact") == 0 &&
                   alone.number("corrections") == 0,
               "the body alone is one linear solve (observed)");
  bool same = true;
  for (const std::string cost : {"triangles", "unknowns", "factorisations", "solves"})
    same = same && ventcel.number(cost) == alone.number(cost);
  report.claim(same,
               "a Ventcel layer costs what the body alone costs: no triangle, no unknown, "
               "no solve more (observed)");
}

// **One question, three models of the layer**: (23) at a small ε, (24) on the layer's mesh,
// (25) without one. All are held against the truth at that ε, so the last two show the
// error of their model as well.
void three_models(const tutorial::Options& options, tutorial::Report& report) {
  const Exact exact(tutorial::paper_scene(options.epsilon), 14),
      limit(tutorial::paper_scene(0), 14);
  double model_error = 0;  // how far the limit is from the truth on Gamma_C
  for (int i = 1; i < 64; ++i)
    model_error = std::max(model_error, std::abs(exact.solution.value(i / 64.0, -1) -
                                                 limit.solution.value(i / 64.0, -1)));
  const double energy_error = std::abs(exact.solution.energy() - limit.solution.energy());
  Table table({"model", "h", "unknowns", "error_on_contact", "off_in_energy",
               "off_in_contact", "seconds"});
  for (const int cells : {options.cells, 2 * options.cells})
    for (const auto& [name, layer] :
         std::vector<std::pair<std::string, Layer>>{{"scaled", StiffLayer{options.epsilon}},
                                                    {"limit", StiffLayer{0}},
                                                    {"ventcel", VentcelLayer{}}}) {
      const Scene scene(body, layer, obstacle);
      const Run run(scene, unstructured_mesh(cells, {scene.layer_depth()}));
      table.add({name, 1.0 / cells, run.solution.counters.unknowns,
                 run.error_on_contact(exact.solution),
                 std::abs(run.energy - exact.solution.energy()),
                 std::abs(run.contact_from - exact.contact_from()),
                 run.assemble_seconds + run.solve_seconds});
    }
  table.print(
      fmt::format("truth: contact from x = {:.4f}, J = {:.6f}; the limit differs by {:.1e} "
                  "in u on Gamma_C",
                  exact.contact_from(), exact.solution.energy(), model_error));
  table.write(options.out / "models.csv");
  for (const TableEntry& h : table.unique("h")) {
    const Table on = table.filter("h", h);
    const double square = h.number() * h.number();
    // h^2 / 2 in energy and up to 1.6 h^2 in u on Gamma_C were measured; the end of contact
    // falls into a cell or the next
    report.claim(on.max("error_on_contact") <= 2 * square + model_error &&
                     on.max("off_in_energy") <= square + energy_error &&
                     on.max("off_in_contact") <= 2 * h.number() + model_error,
                 "h = {:.4f}: three models, one answer, each within 2 h^2 + {:.1e} of the "
                 "truth on Gamma_C, the second "
                 "number the model's own error (observed)",
                 h.number(), model_error);
    const double ventcel = on.filter("model", "ventcel").number("error_on_contact"),
                 scaled = on.filter("model", "scaled").number("error_on_contact");
    report.claim(ventcel <= scaled + model_error,
                 "Ventcel loses nothing without a mesh of the layer: error {:.1e}, with "
                 "one {:.1e} (observed)",
                 ventcel, scaled);
  }
}

// **The change of variable** takes (22) to (23). On a mesh whose layer is pressed flat by
// the same map it does so term by term: the same matrices, the same answer. On a mesh made
// for the thin layer, up to discretisation.
void change_of_variable(const tutorial::Options& options, tutorial::Report& report) {
  Table table({"epsilon", "energy_thin", "energy_scaled", "from_thin", "from_scaled",
               "difference_on_pressed_mesh"});
  for (const double epsilon : {1e-1, 1e-2, 1e-3}) {
    const Scene thin(body, ThinLayer{epsilon}, obstacle),
        scaled(body, StiffLayer{epsilon}, obstacle);
    const Run a(thin, structured_mesh(options.cells, {epsilon})),
        b(scaled, structured_mesh(options.cells)),
        c(thin, tutorial::pressed_mesh(options.cells, epsilon));
    table.add({epsilon, a.energy, b.energy, a.contact_from, b.contact_from,
               (c.solution.u - b.solution.u).cwiseAbs().maxCoeff()});
  }
  table.print("(22) on the thin layer, (23) on the unit layer", 6);
  table.write(options.out / "change_of_variable.csv");
  const auto apart = [&](const std::string& one, const std::string& other) {
    double most = 0;
    for (const Table& row : table.rows())
      most = std::max(most, std::abs(row.number(one) - row.number(other)));
    return most;
  };
  const double h = 1.0 / options.cells, pressed = table.max("difference_on_pressed_mesh"),
               energy = apart("energy_thin", "energy_scaled"),
               from = apart("from_thin", "from_scaled");
  report.claim(
      pressed <=
          1e-16 / (1e-6 * h * h),  // round-off times the condition of (22), epsilon^-2 h^-2
      "(22) is (23), term by term: u differs by {:.1e} on corresponding meshes (proved)",
      pressed);
  report.claim(energy <= h * h && from <= 1.5 * h,
               "and up to discretisation on others: energy within {:.1e}, contact within "
               "{:.3f} (observed)",
               energy, from);
}

// **Many questions.** The forms of (23) do not contain ε, and every ε whose square is below
// δ is solved with one and the same factorisation.
void sweep_over_epsilon(const tutorial::Options& options, tutorial::Report& report) {
  const std::vector<double> epsilons = {1e-1, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12, 0};
  const Space space = Method{&crouzeix_raviart(), unstructured()}.space(options.cells);
  SceneSweep sweep(tutorial::paper_scene(epsilons.front()), space);
  for (const double epsilon : epsilons) {
    sweep.set_epsilon(epsilon);
    sweep.solve();
  }
  const double delta = sweep.factor().delta();
  const auto above = std::count_if(epsilons.begin(), epsilons.end(),
                                   [&](double e) { return e * e > delta; });
  report.claim(sweep.total().factorisations == above + 1,
               "{} epsilons cost one assembly and {} factorisations (observed)",
               epsilons.size(), sweep.total().factorisations);
}

void effects(const tutorial::Options& options, tutorial::Report& report) {
  each_scene_costs_what_it_holds(options, report);
  three_models(options, report);
  change_of_variable(options, report);
  sweep_over_epsilon(options, report);
}

// ## What came out
//
// (a) No triangle, no unknown and no solve more. Up to the error of the model, 4.9e-5 in
// $u$ on $Γ_C$, its answer is as near to the truth as that of the meshed layer.
// :number: 4.9e-5 = line "the limit differs by {} in u on Gamma_C"
//
// (b) One for each ε whose square is above the penalty δ, and one for all others. δ is
// about 6e-8, so the border is about ε = 2e-4: 0.1 and 0.001 lie above, and 3 are enough.
// On corresponding meshes (22) and (23) differ by round-off.
// :number: 3 = line "7 epsilons cost one assembly and {} factorisations"
//
// ## Exercises
//
// 1. Move the obstacle out of reach, gap = 1. What does the scene with layer and contact
//    cost, what does it answer?
// 2. Take P1 for Crouzeix–Raviart on this unstructured mesh. Which models of the layer
//    lock: (23), (24), (25)?
//
// ## Further reading
//
// - [Slimane and Renard 2004](../guides/bibliography.md#slimane-2004): the problems (22) to
//   (25).
// - [Brezis 2011](../guides/bibliography.md#brezis-2011): the functional analysis behind
//   their limits.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "23_effects", "Effects: a scene costs what it calls for",
                       {.epsilon = 1e-2, .exercises = exercises}, effects);
}
