#pragma once
#include <vector>

#include "antilock/exact/truth_table.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock::tutorial {

/// The problem of Section 4, (23): body, scaled layer, contact. The paper gives no load; ours is f
/// = 10 sin(2 pi x).
///
///     u in K,  a+(u, v - u) + a_x^-(u, v - u) + epsilon^-2 a_y^-(u, v - u) >= (f, v - u)   for all v in K
///
///     a+(u, v)    = int_body  grad u . grad v    the body
///     a_x^-(u, v) = int_layer d/dx u d/dx v      the layer along itself
///     a_y^-(u, v) = int_layer d/dy u d/dy v      the layer across: the stiff part, epsilon^-2 in front
///     K           = { v >= 0 on Gamma_C, v = 0 on Gamma_D }
Scene paper_scene(double epsilon);

/// The exact solution of a scene with a scaled layer, ready for whole meshes. It is made from the scene that is solved,
/// so that nothing is measured against the truth of another load.
struct Exact {
  /// Throws Error for a scene whose truth is not known (exact/sine_load.hpp says which is). The series has 2^log2_points
  /// points; 14 give gradients to 1e-6.
  explicit Exact(Scene scene, int log2_points = 17);

  Errors errors(const Space& space, const Solution& solution) const;
  Reference reference() const { return antilock::reference(table); }
  double contact_from() const;  ///< the left end of the contact zone; 1 where there is none

  Scene scene;
  double epsilon;
  Truth truth;
  TruthTable table;
};
/// Those of `paper_scene` for each epsilon.
std::vector<Exact> exact_solutions(const std::vector<double>& epsilons, int log2_points = 17);

}  // namespace antilock::tutorial
