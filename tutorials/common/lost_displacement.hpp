#pragma once
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// What P1 loses of the layer's displacement on one mesh, over what it keeps, against 1/epsilon: curve,
/// inverse_epsilon, x. `locked`, `usual`: rows of P1 and of Crouzeix-Raviart on that mesh with columns epsilon, cells,
/// l2. Read off in L2, where P1's usual error is of second order and does not hide the loss: the share of the L2 error
/// at the smallest epsilon, where all is lost. Only where between 3 and 97 per cent are lost and P1 errs twice as much
/// as Crouzeix-Raviart.
Table lost_to_kept(const Table& locked, const Table& usual);

/// The epsilon at which half is lost, x = 1: between the two nearest, or beyond the nearest two.
double half_lost(const Table& lost);

/// The wall, mesh by mesh: cells, h, the power a in x = d epsilon^-a, "half lost at epsilon". `p1`, `cr`: rows of both
/// elements on all meshes, columns as above and h. What lost_to_kept says of each mesh is added to `lost`.
Table walls(const Table& p1, const Table& cr, Table& lost);

}  // namespace antilock::tutorial
