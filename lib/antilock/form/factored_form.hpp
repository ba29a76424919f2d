#pragma once
#include <vector>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// A form kept as its factors: (u, v) -> (B u, M B v), M diagonal. A row of B is a strain at one quadrature point of a
/// cell, M the weight of that point. The form is never summed into another one (see problem/).
struct FactoredForm {
  RowMatrix b;            ///< R x N
  Eigen::VectorXd m;      ///< R, positive, the diagonal of M
  std::vector<int> cell;  ///< R, the cell (a triangle of the mesh) behind each row
};

/// The form sum_j stiffness_j m_j (b_j u) (b_j v) as rows: M holds what comes from the mesh and the rule, and the moduli
/// stand beside it, however far apart they are.
struct WeightedFactoredForm {
  FactoredForm form;          ///< R rows
  Eigen::VectorXd stiffness;  ///< R, positive
};

}  // namespace antilock
