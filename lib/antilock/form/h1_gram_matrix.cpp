#include "antilock/form/h1_gram_matrix.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "antilock/core/error.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

Eigen::SparseMatrix<double> h1_gram_matrix(const Space& space) {
  if (!space.mesh().reference().simplex)
    throw Error("H1 norm: a mesh of quadrilaterals; accepted: triangles and tetrahedra");
  const Quadrature& rule = cell_rule(space.mesh().kind, 2 * space.element().basis_degree());
  // int phi_i phi_j is the same on every simplex but for the measure
  const Eigen::Index m = space.element().dofs();
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(m, m);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::VectorXd basis = space.element().basis(rule.points.row(q));
    unit += rule.weights(q) * basis * basis.transpose();
  }
  const Eigen::SparseMatrix<double> mass = assemble_cells(
      space, [&](int t) -> Eigen::MatrixXd { return space.mesh().measure(t) * unit; });
  return mass + gradient_form(space, {1, 1}, {1, 1});
}

}  // namespace antilock
