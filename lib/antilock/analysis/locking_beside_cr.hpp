#pragma once
#include <functional>
#include <string>

#include "antilock/measure/result.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Returns the problem with u = `height` in the layer, except where other values are prescribed.
/// Bounds on unknowns are left out, because Gamma_C, the contact boundary, belongs to the layer.
/// Throws Error where u = height violates them.
VariationalInequality with_layer_at_rest(VariationalInequality problem, const Space& space,
                                         double height = 0);

/// The share beside another mesh or element from which a loss is attributed to locking. At epsilon
/// = 1, where nothing locks, the share beside columns was 0 to 24 % for loads of one to three waves
/// on gmsh's tetrahedra with 3 to 12 cells.
inline constexpr double comparison_significance = 0.25;

/// Reports how much a conforming element loses beside Crouzeix-Raviart on the same mesh. For both
/// elements the motion of the layer releases the energy R = J_0 - J, where J is the minimum and J_0
/// the one with u = 0 in the layer. The share 1 - R_h / R_CR is lost. Each R is a difference within
/// one element, so that most of the errors in the body cancel. `assemble_on` assembles the problem
/// of `result` on a space. This takes three more solves.
///
/// It warns if comparison_significance is lost. At epsilon = 1, where nothing locks, the share was 0 to 12 %
/// for a load of one wave on gmsh's tetrahedra with 3 to 12 cells. It can be larger where the mesh
/// does not resolve the load: three waves on six cells gave 38 %.
///
/// `diagnosis` is the beginning of the diagnosis. Where a solve throws Error, the diagnosis says so
/// and there is no number.
LockingReport locking_beside_cr(
    const Result& result, const std::function<VariationalInequality(const Space&)>& assemble_on,
    const std::function<Solution(const VariationalInequality&)>& solver, std::string diagnosis);

}  // namespace antilock
