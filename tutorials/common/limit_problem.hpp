#pragma once
#include "antilock/exact/truth.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// (25) in its strong form for an exact solution of the limit: x, u, r = d_n u - u_xx and the contact pressure at
/// points + 1 places of Sigma.
Table strong_form(const Truth& limit, int points);

/// -Delta u - f in the body by differences of values alone, the largest over 3 x 3 points. Good to 3e-4: values are
/// good to 8e-9, and differences over 5e-3 divide them by 2.5e-5.
double laplace_residual(const Truth& limit);

/// u_h^0 of P1 on the two squares (epsilon = 0) against the discrete (25) on the body alone, structured meshes: the
/// largest difference.
double against_ventcel(int cells);

/// The H1 norm over the layer of the limit u^0, which does not depend on y there: what is lost where the layer locks.
double limit_on_layer(const Truth& limit);

/// u on Gamma_C in three models: x, thin (22), scaled (23), limit (25); P1 on structured meshes.
Table three_models(double epsilon, int cells);

/// What Remark 5 and the three models claim: `sigma` of strong_form, `models` of three_models at epsilon = 0.1.
void judge_limit_problem(const Table& sigma, const Table& models, const Exact& limit, int cells, Report& report);

}  // namespace antilock::tutorial
