#pragma once
#include <optional>

#include "antilock/exact/exact_solution.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Returns the load f(x, y) of the body as a sum of sines in x with polynomials in y as
/// coefficients, or nothing if it is not such a sum. A SineLoad is returned unchanged. Any other
/// function is sampled. 127 x 13 points give the sum, with waves up to 32 (the limit of ExactTable)
/// and degrees up to 12 (the limit of ExactSolution). Then f must agree with this sum at 32768
/// further points, all with different x, to 1e-11 of the largest |f|.
std::optional<SineLoad> as_sine_load(const Field& f);

/// Returns the exact solution of a scene, or nothing if it is not known. It is known for the scaled
/// layer (23) of [SR04] (cited in problem/variational_inequality.hpp) or its limit (25), a load
/// that is a sum of sines, an obstacle, if any, at the distance 0 (checked at 32769 points), and no
/// feature beyond the paper (Scene::beyond_the_paper). Throws as ExactSolution does.
std::optional<ExactSolution> exact_solution_of(const Scene& scene, int log2_points = 17);

}  // namespace antilock
