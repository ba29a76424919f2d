#pragma once
// The answers to the exercises of 27_plate, whose page includes this one: to be read after
// predicting.

const auto pressed = [](const PlateElement& method, int rings, const Plate& plate) {
  const VariationalInequality problem =
      assemble(plate, tutorial::plate_space(method, disc_mesh(rings)));
  return std::pair(active_set(problem), kernel_dimension(problem));
};
const std::vector<tutorial::Exercise> exercises{
    {"Leave the bubbles out of Arnold-Falk: how many functions are left at least, and does "
     "it lock at t = 0?",
     "(9 n^2 - 3 n) + 2 (3 n^2 - 3 n + 1) unknowns less 12 n^2 conditions: 3 n^2 - 9 n + 2 "
     "at least, a number that "
     "grows like the unknowns. It does not lock on these two meshes, but its error is "
     "larger, and we know of no "
     "theorem that covers it",
     [](const tutorial::Options&, tutorial::Report& report) {
       const PlateElement bare{"without bubbles", "",   crouzeix_raviart(), p1(),
                               ShearRule::mean,   false};
       std::vector<double> without, with;
       for (const int n : {4, 8}) {
         const Space w(disc_mesh(n), crouzeix_raviart());
         const auto [solution, kernel] = pressed(bare, n, Plate{.thickness = 0});
         without.push_back(error_of_w(w, solution, ExactPlate(0)));
         with.push_back(
             error_of_w(w, pressed(plate_elements.back(), n, Plate{.thickness = 0}).first,
                        ExactPlate(0)));
         report.claim(kernel >= 3 * n * n - 9 * n + 2,
                      "{} rings: {} functions, at least {}", n, kernel,
                      3 * n * n - 9 * n + 2);
       }
       report.claim(without[1] < without[0] / 2,
                    "it converges: error of w {:.4f}, then {:.4f}", without[0], without[1]);
       report.claim(without[0] > with[0] && without[1] > with[1],
                    "with bubbles {:.4f}, then {:.4f}", with[0], with[1]);
     }},
    {"Double the load and the gap. Do deflection and contact force double? And the disc of "
     "contact?",
     "deflection and force double, the disc stays. Twice a deflection that the gap 1 "
     "allows is one that the gap 2 "
     "allows, "
     "and with twice the load its energy is four times as large: what is least before is "
     "least after",
     [](const tutorial::Options&, tutorial::Report& report) {
       Plate twice{.load = [](double, double) { return -512.0; }};
       twice.gap = [](double, double) { return 2.0; };
       const Solution one = pressed(plate_elements.back(), 8, Plate{}).first,
                      two = pressed(plate_elements.back(), 8, twice).first;
       report.claim_within((two.u - 2 * one.u).norm() / one.u.norm(), 0, 1e-9,
                           "u - 2 u, relative");
       report.claim_within(two.lambda.sum() / one.lambda.sum(), 2 - 1e-9, 2 + 1e-9,
                           "contact force, times");
       report.claim(two.active == one.active, "the same contact set");
     }}};

// ## Answers on paper
//
// **3.** Without shear the mean of $(∇w - θ)·τ$ over each edge is 0. For an edge from $a$
// to $b$ of length $ℓ$ the mean of $∇w·τ$ is $(w(b) - w(a))/ℓ$. The P1 part of θ has the
// mean $½ (θ(a) + θ(b))·τ$, and the edge function of this edge has a fixed mean, while
// those of the other edges are 0 here. So its coefficient is the difference of two numbers
// that are known at the vertices. Three unknowns per vertex are left, which is what the
// kernel counts.
//
// **4.** The error is 0 at the corners, and its second derivatives are those of $w$. So it
// is $-½ \sum_{i<j} λ_i λ_j d_{ij}$ with the barycentric coordinates $λ_i$ and the second
// differences $d_{ij} = h^2 τ_{ij}·∇^2 w\, τ_{ij}$ along the three edges. On a triangle
// the mean of $λ_i^2 λ_j^2$ is $1/90$, that of $λ_i^2 λ_j λ_k$ is $1/180$. Hence the mean
// square of the error is
//
// $$ \frac{1}{720} (\sum d_{ij}^2 + (\sum d_{ij})^2). $$
//
// The three directions are 60° apart, so $\sum d_{ij} = \frac{3}{2} h^2 Δw$ and
// $\sum d_{ij}^2 = h^4 (\frac{3}{8} (Δw)^2 + \frac{3}{4} |∇^2 w|^2)$. Together this is
// $\frac{h^4}{720} (\frac{21}{8} (Δw)^2 + \frac{3}{4} |∇^2 w|^2)$. For a clamped plate
// $∫ |∇^2 w|^2 = ∫ (Δw)^2$ by parts, so the square of the norm is
// $h^4 ‖Δw‖^2 · 3.375/720$, and $(720/3.375)^{1/2} = 14.6$.
