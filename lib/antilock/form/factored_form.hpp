#pragma once
#include <vector>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// A bilinear form that is kept as its factors: (u, v) -> (B u, M B v), M diagonal. A row of B is a
/// strain at one quadrature point of a cell, and M holds the weight of that point. The form is not
/// assembled into another one, because a sum would lose digits
/// (problem/variational_inequality.hpp). N is the number of unknowns, R the number of rows.
struct FactoredForm {
  RowMatrix b;            ///< R x N
  Eigen::VectorXd m;      ///< R, positive, the diagonal of M
  std::vector<int> cell;  ///< R, the cell (a triangle of the mesh) of each row
};

/// The factored form sum_j stiffness_j m_j (b_j u) (b_j v) over rows b_j of B. M holds the weights
/// of the quadrature rule. The moduli are kept in `stiffness` and not in M, because they may be
/// many orders of magnitude apart.
struct WeightedFactoredForm {
  FactoredForm form;          ///< R rows
  Eigen::VectorXd stiffness;  ///< R, positive
};

}  // namespace antilock
