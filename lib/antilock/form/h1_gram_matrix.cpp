#include "antilock/form/h1_gram_matrix.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "antilock/form/gradient_forms.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/space/cell_map.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

Eigen::SparseMatrix<double> h1_gram_matrix(const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = cell_rule(mesh.kind, 2 * space.element().basis_degree());
  const Eigen::Index m = space.element().dofs();
  std::vector<Eigen::MatrixXd> squares;  // phi_i phi_j at the points, times their weights
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(m, m);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::VectorXd basis = space.element().basis(rule.points.row(q));
    squares.emplace_back(rule.weights(q) * basis * basis.transpose());
    unit += squares.back();
  }
  const auto mass_of = [&](int t) -> Eigen::MatrixXd {
    // int phi_i phi_j is the same on every simplex but for the measure
    if (mesh.reference().simplex) return mesh.measure(t) * unit;
    const CellMap<CellKind::quadrilateral> map(mesh, t);
    Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(m, m);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
      mass += map.at(rule.points.row(q).transpose()).factor * squares[q];
    return mass;
  };
  const Eigen::SparseMatrix<double> mass = assemble_cells(space, mass_of);
  return mass + gradient_form(space, {1, 1}, {1, 1});
}

}  // namespace antilock
