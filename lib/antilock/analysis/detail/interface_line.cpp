#include "antilock/analysis/detail/interface_line.hpp"

#include <algorithm>

namespace antilock {
namespace {

/// The unknowns on the edge of triangle t that lies opposite corner i, ascending in x.
std::vector<int> dofs_on_edge(const Space& space, int t, int i) {
  const Eigen::MatrixX3d nodes = space.element().support_points();
  std::vector<int> dofs;
  for (Eigen::Index r = 0; r < nodes.rows(); ++r)
    if (nodes(r, i) == 0) dofs.push_back(space.cell_dofs()(t, r));
  const auto x = space.dof_coordinates().col(0);
  std::sort(dofs.begin(), dofs.end(), [&](int a, int b) { return x(a) < x(b); });
  return dofs;
}

/// Numbers the unknowns of the edges, which are sorted, and replaces them by their places.
void number_places(InterfaceLine& line, int unknowns) {
  line.place.assign(unknowns, -1);
  for (std::vector<int>& edge : line.edges)
    for (int& dof : edge) {
      int& place = line.place[dof];
      if (place < 0) {
        place = line.size();
        line.dof.push_back(dof);
      }
      dof = place;
    }
}

}  // namespace

InterfaceLine interface_line(const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  const auto x = space.dof_coordinates().col(0);
  InterfaceLine line;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::sigma) continue;
    const int t = mesh.edge_triangles(e, 0);
    line.edges.push_back(dofs_on_edge(space, t, local_edge(mesh, t, e)));
    const std::vector<int>& dofs = line.edges.back();
    line.length += x(dofs.back()) - x(dofs.front());
  }
  const auto is_left_of = [&](const auto& a, const auto& b) { return x(a[0]) < x(b[0]); };
  std::sort(line.edges.begin(), line.edges.end(), is_left_of);
  number_places(line, space.size());
  line.x = x(line.dof);
  return line;
}

std::pair<int, double> interval_of(const Eigen::VectorXd& points, double x) {
  const double* const first = points.data();
  const double* const last = first + points.size() - 1;
  // x beyond the last point belongs to the last interval: `right` is never behind `last`
  const double* const right = std::upper_bound(first + 1, last, x);
  const double share = (x - right[-1]) / (right[0] - right[-1]);
  return {static_cast<int>(right - first) - 1, std::clamp(share, 0.0, 1.0)};
}

double piecewise_linear(const Eigen::VectorXd& points, const Eigen::VectorXd& y, double x) {
  if (points.size() == 1) return y(0);
  const auto [i, s] = interval_of(points, x);
  // at the points themselves the values are exact, even beside an infinite bound
  if (s == 0) return y(i);
  if (s == 1) return y(i + 1);
  return (1 - s) * y(i) + s * y(i + 1);
}

EdgeBasis edge_basis(const Element& element, const Eigen::VectorXd& s) {
  const Eigen::MatrixX3d nodes = element.support_points();
  std::vector<int> on_edge;  // the basis functions of the edge opposite corner 0, from corner 1
  for (Eigen::Index r = 0; r < nodes.rows(); ++r)
    if (nodes(r, 0) == 0) on_edge.push_back(static_cast<int>(r));
  std::sort(on_edge.begin(), on_edge.end(),
            [&](int a, int b) { return nodes(a, 2) < nodes(b, 2); });
  const auto size = static_cast<Eigen::Index>(on_edge.size());
  EdgeBasis basis;
  basis.value.resize(s.size(), size);
  basis.slope.resize(s.size(), size);
  for (Eigen::Index q = 0; q < s.size(); ++q) {
    const Eigen::Vector3d lambda(0, 1 - s(q), s(q));
    const Eigen::Vector3d lambda_slope(0, -1, 1);
    basis.value.row(q) = element.basis(lambda)(on_edge);
    const Eigen::MatrixX3d derivative = element.derivative(lambda);
    basis.slope.row(q) = (derivative * lambda_slope)(on_edge);
  }
  return basis;
}

}  // namespace antilock
