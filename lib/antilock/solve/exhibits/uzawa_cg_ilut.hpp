#pragma once
#include "antilock/solve/uzawa.hpp"

namespace antilock {

/// The paper's algorithm with the paper's linear solver (Section 4.2): A1 + compliance^-1 B' M B summed into one
/// matrix, one run of conjugate gradients preconditioned by ILUT a step. Kept to be compared against: the sum loses
/// digits, and ILUT breaks down on stiff meshes that are not aligned with the layer, which is reported, never returned
/// as an answer. Throws Error at compliance = 0, where the sum does not exist, and for options.enough: the duality gap
/// asks for the matrix condensed on Gamma_C.
Solution uzawa_cg_ilut(const VariationalInequality& problem, const UzawaOptions& options = {});

}  // namespace antilock
