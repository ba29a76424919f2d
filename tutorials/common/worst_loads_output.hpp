#pragma once
#include <filesystem>

#include "antilock/analysis/worst_load.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// A load on a drawing mesh of the body, as VTU: its values in the place of u. Of f and -f the one with the larger
/// pull upwards on one arch and two.
void write_load(const std::filesystem::path& path, const LoadModes& modes, Eigen::VectorXd f);

/// |f . g| / |g|, g the load decay(k pi, y) sin(k pi x): 1 where f, of norm 1, is that load.
double likeness(const LoadModes& modes, const Eigen::VectorXd& f, int k);

/// errors.csv: the rows at epsilon = 0; epsilon.csv: those of the width h, epsilon > 1e-10. Prints errors at 0 by h.
void write_worst_errors(const std::filesystem::path& out, const Table& results, double h);

/// The epsilon, between 1e-6 and 1, at which the square of the worst error is halfway between those at 1 and at 0, by
/// bisection to 0.6 %: an element on the unstructured mesh of 1/h = cells, waves up to `cells`.
double half_of_the_loss(const Element& element, int cells);

}  // namespace antilock::tutorial
