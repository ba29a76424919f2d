#pragma once
#include <optional>

#include "antilock/exact/exact_solution.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The load f(x, y) of the body as a sum of sines in x with polynomials in y as coefficients, where it is one (waves up to
/// 32, degree up to 12: what ExactSolution and ExactTable take); empty where it is not. A SineLoad is handed back as
/// it is. Any other function is sampled: 127 x 13 points give the sum, and 32768 further points, of all x, must agree
/// with it to 1e-11 of the largest |f|.
std::optional<SineLoad> as_sine_load(const Field& f);

/// The exact solution of a scene, where it is known: the scaled layer (23) or its limit (25), a load that is a sum of
/// sines, an obstacle, if any, at the distance 0 (looked at in 32769 places), nothing beyond the paper. Empty
/// otherwise. Throws as ExactSolution does.
std::optional<ExactSolution> exact_solution_of(const Scene& scene, int log2_points = 17);

}  // namespace antilock
