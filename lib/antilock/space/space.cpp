#include "antilock/space/space.hpp"

#include <algorithm>

namespace antilock {

Space::Space(const TriangleMesh& mesh, const Element& element) : mesh_(&mesh), element_(&element) {
  const int per_vertex = element.per_vertex(), per_edge = element.per_edge(), per_triangle = element.per_triangle();
  const int first_edge = per_vertex * mesh.vertex_count();
  const int first_inner = first_edge + per_edge * mesh.edge_count();
  const int size = first_inner + per_triangle * mesh.triangle_count();
  const Eigen::MatrixX3d nodes = element.nodes();
  points_.resize(size, 2);
  unknowns_.resize(mesh.triangle_count(), element.unknowns());
  std::vector<char> on_clamped(size, 0), on_contact(size, 0);

  for (int t = 0; t < mesh.triangle_count(); ++t) {
    int local = 0;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < per_vertex; ++k) unknowns_(t, local++) = per_vertex * mesh.triangles(t, i) + k;
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      // unknowns of an edge are numbered from its smaller vertex, whichever triangle looks at it
      const bool forward = mesh.triangles(t, (i + 1) % 3) == mesh.edges(e, 0);
      for (int k = 0; k < per_edge; ++k)
        unknowns_(t, local++) = first_edge + per_edge * e + (forward ? k : per_edge - 1 - k);
    }
    for (int k = 0; k < per_triangle; ++k) unknowns_(t, local++) = first_inner + per_triangle * t + k;
    const Eigen::Matrix<double, 3, 2> corners = mesh.vertices(mesh.triangles.row(t), Eigen::all);
    for (int i = 0; i < local; ++i) points_.row(unknowns_(t, i)) = nodes.row(i) * corners;
  }

  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool held = is_dirichlet(mesh.edge_tag[e]);
    if (!held && mesh.edge_tag[e] != EdgeTag::contact) continue;
    auto& marked = held ? on_clamped : on_contact;
    for (int k = 0; k < per_edge; ++k) marked[first_edge + per_edge * e + k] = 1;
    for (int k = 0; k < per_vertex; ++k)
      for (const int v : {mesh.edges(e, 0), mesh.edges(e, 1)}) marked[per_vertex * v + k] = 1;
  }
  for (int i = 0; i < size; ++i) {
    if (on_clamped[i]) clamped_.push_back(i);
    if (on_contact[i] && !on_clamped[i]) contact_.push_back(i);
  }
  std::stable_sort(contact_.begin(), contact_.end(), [&](int a, int b) { return points_(a, 0) < points_(b, 0); });
}

Eigen::Matrix<double, 3, 2> barycentric_gradients(const TriangleMesh& mesh, int t) {
  Eigen::Matrix<double, 3, 2> gradients;
  const double scale = 1 / mesh.twice_area(t);
  for (int i = 0; i < 3; ++i) {
    const int j = mesh.triangles(t, (i + 1) % 3), k = mesh.triangles(t, (i + 2) % 3);
    gradients(i, 0) = (mesh.vertices(j, 1) - mesh.vertices(k, 1)) * scale;
    gradients(i, 1) = (mesh.vertices(k, 0) - mesh.vertices(j, 0)) * scale;
  }
  return gradients;
}

Eigen::Vector2d point_in(const TriangleMesh& mesh, int t, const Eigen::Vector3d& lambda) {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  for (int i = 0; i < 3; ++i) point += lambda(i) * mesh.vertices.row(mesh.triangles(t, i)).transpose();
  return point;
}

}  // namespace antilock
