#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/analysis/worst_load.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// One row per load (one of the three below), method, mesh and epsilon of chapter 15: the error per unit of load.
inline const std::vector<std::string> worst_load_columns{"load", "method", "h", "epsilon", "error"};
inline constexpr const char *one_load = "our load", *ball = "worst load of the ball", *contact = "contact, at least";

/// l_k of chapter 15: the error at epsilon = 0 under psi_k sin(k pi x) / |psi_k| where the layer is locked; k >= 1.
double loss(int k);

/// Draws the worst load of a method on a mesh of the body, out/ELEMENT_FAMILY.vtu, with its values in the place of u.
/// Of f and -f it takes the one with the larger pull upwards on one arch and two. Of P1 on the unstructured mesh it
/// claims that f is the load of l_1.
void draw_worst(const std::filesystem::path& out, const Method& method, const LoadModes& modes, Eigen::VectorXd f,
                Report& report);

/// P1 and P2 on the unstructured meshes of 1/h = cells / 4, cells / 2 and cells, with 1/h waves: columns degree, h and
/// the epsilon, between 1e-6 and 1, at which the square of the worst error is halfway between those at 1 and at 0, by
/// bisection to 0.6 %.
Table half_of_the_loss(int cells);

/// Prints the errors at epsilon = 0 by h, and `halves` of half_of_the_loss. Writes errors.csv (the rows at epsilon = 0)
/// and epsilon.csv (those at h = 2/cells with epsilon > 1e-10). Claims what is to come out of the methods, and of P3
/// and P4.
void judge_worst_loads(const Options& options, const Table& results, const std::vector<Method>& methods,
                       const Table& halves, Report& report);

}  // namespace antilock::tutorial
