#pragma once
// The answers to the exercises of 26_elasticity, whose page includes this one: to be read
// after predicting.

const auto named = [](const std::string& name, int cells) {
  for (const Rubber& rubber : tutorial::rubbers(cells))
    if (rubber.name == name) return rubber;
  throw Error("no method " + name);
};
const std::vector<tutorial::Exercise> exercises{
    {"CR penalises its jumps with weight 1. Between weight 0.1 and 10, how much does the "
     "contact force change, on 8 "
     "and on 16 cells?",
     "by 16 % on 8 cells, by half as much on 16: the jumps of the solution vanish with h, "
     "and the effect of the weight "
     "with them",
     [](const tutorial::Options&, tutorial::Report& report) {
       const auto spread = [&](int cells) {
         const Rubber cr = named("Crouzeix-Raviart with jumps", cells);
         const Space x(cr.mesh, cr.in_x), y(x, cr.in_y);
         const auto force = [&](double weight) {
           VariationalInequality problem = pushed(cr, {x, y}, weight);
           problem.compliance = 1e-8;
           return active_set(problem).lambda.sum();
         };
         return force(10) / force(0.1) - 1;
       };
       const double coarse = spread(8), fine = spread(16);
       report.claim(coarse < 0.2 && fine < 0.65 * coarse,
                    "weights 0.1 and 10 differ by {:.1f} % on 8 cells, {:.1f} % on 16",
                    100 * coarse, 100 * fine);
     }},
    {"Count what is left at 1/h = 4 and 8: how does dim G_h of P1 grow under refinement? "
     "And that of CR?",
     "P1 on parallel diagonals: like n, where a stream function needs n^2; CR: like n^2",
     [](const tutorial::Options&, tutorial::Report& report) {
       const auto kernel = [&](const std::string& name, int cells) {
         const Rubber rubber = named(name, cells);
         const Space x(rubber.mesh, rubber.in_x), y(x, rubber.in_y);
         return kernel_dimension(pushed(rubber, {x, y}, 1));
       };
       const int coarse = kernel("P1 right diagonals", 4),
                 fine = kernel("P1 right diagonals", 8);
       const int coarse_cr = kernel("Crouzeix-Raviart with jumps", 4),
                 fine_cr = kernel("Crouzeix-Raviart with jumps", 8);
       report.claim(coarse == 8 && fine == 16, "P1: 2n = {}, {}", coarse, fine);
       report.claim(fine_cr > 3.5 * coarse_cr, "CR: {}, {}", coarse_cr, fine_cr);
     }}};

// ## Answers on paper
//
// **3.** Write $d_b, d_r, d_t, d_l$ for $\operatorname{div} u$ in the four triangles at the
// bottom, right, top and left of a square of side $h$. For $u_x$: bottom and top have $∂_x$
// from their own side, together $(u_{br} - u_{bl} + u_{tr} - u_{tl})/h$. Left and right
// have $±(2/h)$(centre $-$ mean of their side), and together the same: the centre cancels.
// For $∂_y u_y$ likewise. So $d_b - d_r + d_t - d_l = 0$: the fourth follows from three.
