#pragma once
#include <filesystem>
#include <vector>

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

/// The exact solution's way to its limit, one row per different epsilon: method "exact", epsilon, distance in H1, and
/// stiff = epsilon^2 |p|^2.
Table exact_to_the_limit(const std::vector<double>& epsilons, const Exact& limit);

/// Prints the distances to the limit and the terms of (18) for locked P1; writes limits.csv and terms.csv.
void show_limits(const std::filesystem::path& out, const Table& curves, const Table& terms);

/// Theorem 1, Proposition 1 and (5): the orders in epsilon of each method in `curves`. Propositions 2 and 3: the orders
/// in h of the terms of (18), one by one; of the second one and of the error where nothing locks.
void judge_orders(const Table& curves, const Table& terms, Report& report);

/// The second term of (18) for P1 unstructured on the finest mesh.
double last_second_term(const Table& terms);

/// What Remark 5 and the three models claim: strong_form at 401 places, written as sigma.csv, and three_models at
/// epsilon = 0.1, written as models.csv.
void judge_limit_problem(const std::filesystem::path& out, const Exact& limit, int cells, Report& report);

}  // namespace antilock::tutorial
