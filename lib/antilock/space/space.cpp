#include "antilock/space/space.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace antilock {

Space::Space(TriangleMesh mesh, const Element& element)
    : Space(std::make_shared<const TriangleMesh>(std::move(mesh)), element) {}

Space::Space(std::shared_ptr<const TriangleMesh> mesh, const Element& element)
    : mesh_(std::move(mesh)),
      element_(&element),
      numbering_(std::make_shared<const Numbering>(*mesh_, element)) {}

Space::Space(const Space& other, const Element& element) : Space(other.mesh_, element) {}

bool have_one_mesh(const Space& a, const Space& b) {
  const TriangleMesh& one = a.mesh();
  const TriangleMesh& two = b.mesh();
  if (&one == &two) return true;
  return one.vertex_count() == two.vertex_count() && one.triangle_count() == two.triangle_count() &&
         one.vertices == two.vertices && one.triangles == two.triangles &&
         one.region == two.region && one.edge_tag == two.edge_tag;
}

Space::Numbering::Numbering(const TriangleMesh& mesh, const Element& element) {
  const int dofs_per_vertex = element.dofs_per_vertex(), dofs_per_edge = element.dofs_per_edge(),
            dofs_per_cell = element.dofs_per_cell();
  const int first_edge = dofs_per_vertex * mesh.vertex_count();
  const int first_inner = first_edge + dofs_per_edge * mesh.edge_count();
  const int size = first_inner + dofs_per_cell * mesh.triangle_count();
  const Eigen::MatrixX3d nodes = element.support_points();
  dof_coordinates.resize(size, 2);
  cell_dofs.resize(mesh.triangle_count(), element.dofs());
  std::vector<char> on_clamped(size, 0), on_contact(size, 0);

  for (int t = 0; t < mesh.triangle_count(); ++t) {
    int local = 0;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < dofs_per_vertex; ++k)
        cell_dofs(t, local++) = dofs_per_vertex * mesh.triangles(t, i) + k;
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      // unknowns of an edge are numbered from its smaller vertex, whichever triangle looks at it
      const bool forward = mesh.triangles(t, (i + 1) % 3) == mesh.edges(e, 0);
      for (int k = 0; k < dofs_per_edge; ++k)
        cell_dofs(t, local++) =
            first_edge + dofs_per_edge * e + (forward ? k : dofs_per_edge - 1 - k);
    }
    for (int k = 0; k < dofs_per_cell; ++k)
      cell_dofs(t, local++) = first_inner + dofs_per_cell * t + k;
    const Eigen::Matrix<double, 3, 2> corners =
        mesh.vertices(mesh.triangles.row(t), Eigen::indexing::all);
    for (int i = 0; i < local; ++i) dof_coordinates.row(cell_dofs(t, i)) = nodes.row(i) * corners;
  }

  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool held = is_dirichlet(mesh.edge_tag[e]);
    if (!held && mesh.edge_tag[e] != EdgeTag::contact) continue;
    auto& marked = held ? on_clamped : on_contact;
    for (int k = 0; k < dofs_per_edge; ++k) marked[first_edge + dofs_per_edge * e + k] = 1;
    for (int k = 0; k < dofs_per_vertex; ++k)
      for (const int v : {mesh.edges(e, 0), mesh.edges(e, 1)}) marked[dofs_per_vertex * v + k] = 1;
  }
  // An unknown inside a triangle whose support point lies on an edge, as those of P1dc, belongs to
  // the triangle alone. It is bounded on Gamma_C. It is not prescribed on a Dirichlet edge, where
  // its form imposes the value weakly.
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      if (mesh.edge_tag[mesh.triangle_edges(t, i)] != EdgeTag::contact) continue;
      for (Eigen::Index k = nodes.rows() - dofs_per_cell; k < nodes.rows(); ++k)
        if (nodes(k, i) == 0) on_contact[cell_dofs(t, k)] = 1;
    }
  for (int i = 0; i < size; ++i) {
    if (on_clamped[i]) dirichlet_dofs.push_back(i);
    if (on_contact[i] && !on_clamped[i]) contact_dofs.push_back(i);
  }
  std::stable_sort(contact_dofs.begin(), contact_dofs.end(),
                   [&](int a, int b) { return dof_coordinates(a, 0) < dof_coordinates(b, 0); });
}

double dof_value(const Space& space, int t, Eigen::Index i,
                 const std::function<double(const Eigen::RowVector2d&)>& v) {
  // the position of a shared unknown is the same from both triangles, to the last digit
  if (space.element().nodal()) return v(space.dof_coordinates().row(space.cell_dofs()(t, i)));
  const DofFunctional functional = space.element().functional(static_cast<int>(i));
  double value = 0;
  for (Eigen::Index q = 0; q < functional.weights.size(); ++q)
    value +=
        functional.weights(q) * v(point_in(space.mesh(), t, functional.points.row(q)).transpose());
  return value;
}

Eigen::VectorXd dof_values(const Space& space, const std::vector<int>& dofs,
                           const std::function<double(double, double)>& v) {
  const Points& at = space.dof_coordinates();
  Eigen::VectorXd values(static_cast<Eigen::Index>(dofs.size()));
  if (space.element().nodal()) {
    for (std::size_t k = 0; k < dofs.size(); ++k)
      values(static_cast<Eigen::Index>(k)) = v(at(dofs[k], 0), at(dofs[k], 1));
    return values;
  }
  constexpr int not_asked = -1;
  std::vector<int> place(static_cast<std::size_t>(space.size()), not_asked);
  for (std::size_t k = 0; k < dofs.size(); ++k)
    place[static_cast<std::size_t>(dofs[k])] = static_cast<int>(k);
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    for (int i = 0; i < space.element().dofs(); ++i) {
      // an unknown on an edge between two triangles is computed once
      int& k = place[static_cast<std::size_t>(space.cell_dofs()(t, i))];
      if (k == not_asked) continue;
      values(k) =
          dof_value(space, t, i, [&](const Eigen::RowVector2d& x) { return v(x(0), x(1)); });
      k = not_asked;
    }
  return values;
}

Eigen::VectorXd dof_values(const Space& space, const std::function<double(double, double)>& v) {
  std::vector<int> all(static_cast<std::size_t>(space.size()));
  std::iota(all.begin(), all.end(), 0);
  return dof_values(space, all, v);
}

Eigen::VectorXd values_at_dofs(const Space& space, const Eigen::VectorXd& u) {
  if (space.element().nodal()) return u;
  const Eigen::MatrixX3d points = space.element().support_points();
  Eigen::MatrixXd basis(points.rows(), points.rows());  // at each point
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    basis.row(i) = space.element().basis(points.row(i)).transpose();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(space.size()), triangles = sum;
  for (int t = 0; t < space.mesh().triangle_count(); ++t) {
    sum(space.cell_dofs().row(t)) += basis * u(space.cell_dofs().row(t));
    triangles(space.cell_dofs().row(t)).array() += 1;
  }
  return sum.cwiseQuotient(triangles);
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
  for (int i = 0; i < 3; ++i)
    point += lambda(i) * mesh.vertices.row(mesh.triangles(t, i)).transpose();
  return point;
}

}  // namespace antilock
