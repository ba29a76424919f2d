#include "antilock/form/forms.hpp"
#include "antilock/form/quadrature.hpp"

namespace antilock {

const Quadrature& strain_rule(const Element& element) { return triangle_rule(2 * (element.degree() - 1)); }

FactoredForm layer_strain(const Space& space, const std::function<Eigen::Vector2d(int)>& direction) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Quadrature& rule = strain_rule(element);
  const auto points = rule.weights.size(), m = static_cast<Eigen::Index>(element.unknowns());
  std::vector<Eigen::MatrixX3d> derivative;
  for (Eigen::Index q = 0; q < points; ++q) derivative.push_back(element.derivative(rule.points.row(q)));

  FactoredForm strain;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer) strain.cell.insert(strain.cell.end(), points, t);
  const auto rows = static_cast<Eigen::Index>(strain.cell.size());
  strain.m.resize(rows);
  strain.b.resize(rows, space.size());
  strain.b.resizeNonZeros(rows * m);
  strain.b.outerIndexPtr()[0] = 0;
  Eigen::VectorXd dy(m);
  std::vector<std::pair<int, double>> row(m);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const int t = strain.cell[r];
    const Eigen::Index q = r % points;
    strain.m(r) = rule.weights(q) * mesh.area(t);
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    const Eigen::Vector3d slope = direction ? Eigen::Vector3d(lambda * direction(t)) : Eigen::Vector3d(lambda.col(1));
    dy.noalias() = derivative[q] * slope;
    for (Eigen::Index i = 0; i < m; ++i) row[i] = {space.unknowns()(t, i), dy(i)};
    std::sort(row.begin(), row.end());
    for (Eigen::Index i = 0; i < m; ++i) {
      strain.b.innerIndexPtr()[r * m + i] = row[i].first;
      strain.b.valuePtr()[r * m + i] = row[i].second;
    }
    strain.b.outerIndexPtr()[r + 1] = static_cast<int>((r + 1) * m);
  }
  return strain;
}

}  // namespace antilock
