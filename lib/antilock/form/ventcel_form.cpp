#include <algorithm>

#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"

namespace antilock {

Eigen::SparseMatrix<double> ventcel_form(const Space& space) {
  if (space.element().degree() != 1)
    throw Error("Ventcel term: element " + space.element().name() + " is not accepted; P1 or CR");
  // Along Sigma: the clamped end, the unknowns by x, the clamped end. The ends carry u = 0, so they add to the diagonal
  // only.
  const std::vector<int>& line = space.contact();
  std::vector<Eigen::Triplet<double>> entries;
  double left = 1e300, right = -1e300;  // the ends of Sigma
  const TriangleMesh& mesh = space.mesh();
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (int end = 0; end < 2; ++end)
      if (mesh.edge_tag[e] == EdgeTag::contact) {
        left = std::min(left, mesh.vertices(mesh.edges(e, end), 0));
        right = std::max(right, mesh.vertices(mesh.edges(e, end), 0));
      }
  int before = -1;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    const int here = i < line.size() ? line[i] : -1;
    const double x = here >= 0 ? space.points()(here, 0) : right;
    const double stiffness = 1 / (x - left);
    if (before >= 0) entries.emplace_back(before, before, stiffness);
    if (here >= 0) entries.emplace_back(here, here, stiffness);
    if (before >= 0 && here >= 0) {
      entries.emplace_back(before, here, -stiffness);
      entries.emplace_back(here, before, -stiffness);
    }
    left = x;
    before = here;
  }
  Eigen::SparseMatrix<double> form(space.size(), space.size());
  form.setFromTriplets(entries.begin(), entries.end());
  return form;
}

}  // namespace antilock
