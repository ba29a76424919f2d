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

}  // namespace antilock
