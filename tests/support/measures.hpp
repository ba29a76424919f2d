#pragma once
#include "antilock/form/gradient_forms.hpp"
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock::test {

/// The area of the triangles of a region.
inline double area(const TriangleMesh& mesh, Region region) {
  double sum = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == region) sum += mesh.area(t);
  return sum;
}

/// u' B' M B u.
inline double value(const FactoredForm& form, const Eigen::VectorXd& u) {
  const Eigen::VectorXd bu = form.b * u;
  return bu.dot(form.m.cwiseProduct(bu));
}

/// The length of the edges with a tag.
inline double length(const TriangleMesh& mesh, EdgeTag tag) {
  double sum = 0;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == tag) sum += mesh.edge_length(e);
  return sum;
}

}  // namespace antilock::test
