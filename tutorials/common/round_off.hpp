#pragma once
#include <filesystem>
#include <functional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// Solves with a given contact set and penalty delta.
using Cure =
    std::function<Eigen::VectorXd(const VariationalInequality&, const std::vector<bool>& active, double delta)>;

/// Every solver on one discrete problem, one row each: the library in split form, a cure with its contact set, the
/// sum by Cholesky and LU, the paper's CG + ILUT. error: the largest at the unknowns; ended: what the solver says
/// of itself; wrong: more than twice the right error, or no answer; refused: what the checks in split form say, or
/// no answer; seconds; apart: the largest distance from the library's answer, relative.
Table compare_solvers(const Method& method, const Space& space, const Exact& exact, const Cure& cure);

/// Condition numbers of the sum and of the K that is factored: epsilon, summed, factored. Both have the same smallest
/// eigenvalue but for a few percent (it belongs to a smooth function of the kernel of B), and the one of the sum could
/// not be computed where it matters: the sum would have to be factored.
Table condition_numbers(const Space& space);

/// The exact layer stress p = epsilon^-2 d/dy u at y = -1/2: x, and p at epsilon = 1, 1e-1, 1e-2 and 0.
Table layer_stress_curves();

/// The rows of the two factorisations of the sum, Cholesky and LU.
Table sums(const Table& results);

/// Prints P1's errors, how its solvers ended, and the condition numbers; writes results.csv, and layer_stress_curves as
/// stress.csv.
void show_round_off(const std::filesystem::path& out, const Table& results, const Table& conditions);

/// Claims that the error of the split form does not depend on epsilon below 1e-3, that the sum is right or wrong as its
/// condition number foretells, and that the condition number of K stays.
void judge_split_form(const Table& results, const Table& conditions, Report& report);

}  // namespace antilock::tutorial
