#include "antilock/space/space.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/space/cell_map.hpp"

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
  return one.kind == two.kind && one.vertex_count() == two.vertex_count() &&
         one.triangle_count() == two.triangle_count() && one.vertices == two.vertices &&
         one.triangles == two.triangles && one.region == two.region && one.edge_tag == two.edge_tag;
}

template <CellKind kind>
void Space::Numbering::number_cells(const TriangleMesh& mesh, const Element& element,
                                    const FirstDofs& first, const CellEdges& edges) {
  constexpr ReferenceCell cell = reference_cell(kind);
  const int dofs_per_vertex = element.dofs_per_vertex();
  const int dofs_per_edge = element.dofs_per_edge();
  const int dofs_per_face = cell.dimension == 3 ? element.dofs_per_face() : 0;
  const int dofs_per_cell = element.dofs_per_cell();
  const ReferencePoints support = element.support_points();
  // N_i at the support points
  Eigen::Matrix<double, Eigen::Dynamic, cell.vertices> nodes(support.rows(), cell.vertices);
  for (Eigen::Index i = 0; i < support.rows(); ++i)
    nodes.row(i) = vertex_functions<kind>(support.row(i).transpose()).transpose();
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    int local = 0;
    for (int i = 0; i < cell.vertices; ++i)
      for (int k = 0; k < dofs_per_vertex; ++k)
        cell_dofs(t, local++) = dofs_per_vertex * mesh.triangles(t, i) + k;
    for (int i = 0; i < cell.edges && dofs_per_edge > 0; ++i) {
      const int e = cell.dimension == 2 ? mesh.triangle_edges(t, i) : edges.of_cell(t, i);
      // unknowns of an edge are numbered from its smaller vertex, whichever cell looks at it
      const bool forward = mesh.triangles(t, cell.edge[i][0]) < mesh.triangles(t, cell.edge[i][1]);
      for (int k = 0; k < dofs_per_edge; ++k)
        cell_dofs(t, local++) =
            first.on_edges + dofs_per_edge * e + (forward ? k : dofs_per_edge - 1 - k);
    }
    for (int i = 0; i < cell.facets; ++i)
      for (int k = 0; k < dofs_per_face; ++k)
        cell_dofs(t, local++) = first.on_faces + dofs_per_face * mesh.triangle_edges(t, i) + k;
    for (int k = 0; k < dofs_per_cell; ++k)
      cell_dofs(t, local++) = first.in_cells + dofs_per_cell * t + k;
    const Eigen::Matrix<double, cell.vertices, cell.dimension> corners =
        CellMap<kind>(mesh, t).corners().transpose();
    for (int i = 0; i < local; ++i) {
      const Eigen::Index first_coordinate = Eigen::Index(cell.dimension) * cell_dofs(t, i);
      Eigen::Map<Eigen::Matrix<double, 1, cell.dimension>>(
          dof_coordinates.data() + first_coordinate) = nodes.row(i) * corners;
    }
  }
}

Space::Numbering::Numbering(const TriangleMesh& mesh, const Element& element) {
  if (element.kind() != mesh.kind)
    throw Error("space: the element " + element.name() + " of a " +
                reference_cell(element.kind()).name + " on a mesh of " + mesh.reference().plural +
                "; accepted: both of one kind");
  const bool in_space = mesh.dimension() == 3;
  CellEdges edges;  // in the plane the facets, which the mesh has numbered
  if (in_space && element.dofs_per_edge() > 0) edges = cell_edges(mesh);
  FirstDofs first;
  first.on_edges = element.dofs_per_vertex() * mesh.vertex_count();
  first.on_faces =
      first.on_edges + element.dofs_per_edge() * (in_space ? edges.count : mesh.edge_count());
  first.in_cells = first.on_faces + (in_space ? element.dofs_per_face() * mesh.edge_count() : 0);
  const int size = first.in_cells + element.dofs_per_cell() * mesh.triangle_count();
  dof_coordinates.resize(size, mesh.dimension());
  cell_dofs.resize(mesh.triangle_count(), element.dofs());
  with_kind(mesh.kind, [&]<CellKind kind>() { number_cells<kind>(mesh, element, first, edges); });
  mark_boundary(mesh, element);
}

void Space::Numbering::mark_boundary(const TriangleMesh& mesh, const Element& element) {
  const auto size = static_cast<int>(dof_coordinates.rows());
  const ReferencePoints nodes = element.support_points();
  const Eigen::Index first_inner = nodes.rows() - element.dofs_per_cell();
  std::vector<char> on_clamped(size, 0), on_contact(size, 0);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < mesh.reference().facets; ++i) {
      const EdgeTag tag = mesh.edge_tag[mesh.triangle_edges(t, i)];
      const bool held = is_dirichlet(tag);
      if (!held && tag != EdgeTag::contact) continue;
      auto& marked = held ? on_clamped : on_contact;
      // An unknown inside a triangle whose support point lies on an edge, as those of P1dc, belongs
      // to the triangle alone. It is bounded on Gamma_C. It is not prescribed on a Dirichlet edge,
      // where its form imposes the value weakly.
      const Eigen::Index count = held ? first_inner : nodes.rows();
      for (Eigen::Index k = 0; k < count; ++k)
        if (lies_on_facet(mesh.kind, i, nodes.row(k))) marked[cell_dofs(t, k)] = 1;
    }
  for (int i = 0; i < size; ++i) {
    if (on_clamped[i]) dirichlet_dofs.push_back(i);
    if (on_contact[i] && !on_clamped[i]) contact_dofs.push_back(i);
  }
  const auto before = [&](int a, int b) {
    for (int k = 0; k < mesh.vertical(); ++k)
      if (dof_coordinates(a, k) != dof_coordinates(b, k))
        return dof_coordinates(a, k) < dof_coordinates(b, k);
    return false;
  };
  std::stable_sort(contact_dofs.begin(), contact_dofs.end(), before);
}

double dof_value(const Space& space, int t, Eigen::Index i,
                 const std::function<double(const Position&)>& v) {
  // the position of a shared unknown is the same from both triangles, to the last digit
  if (space.element().nodal()) return v(space.dof_coordinates().row(space.cell_dofs()(t, i)));
  const DofFunctional functional = space.element().functional(static_cast<int>(i));
  double value = 0;
  for (Eigen::Index q = 0; q < functional.weights.size(); ++q)
    value += functional.weights(q) * v(position(space.mesh(), t, functional.points.row(q))
                                           .head(space.mesh().dimension())
                                           .transpose());
  return value;
}

double field_value(const Field& v, const Position& x) {
  return v(x(0), x(1), x.size() == 3 ? x(2) : 0);
}

Eigen::VectorXd dof_values(const Space& space, const std::vector<int>& dofs, const Field& v) {
  const Points& at = space.dof_coordinates();
  Eigen::VectorXd values(static_cast<Eigen::Index>(dofs.size()));
  if (space.element().nodal()) {
    for (std::size_t k = 0; k < dofs.size(); ++k)
      values(static_cast<Eigen::Index>(k)) = field_value(v, at.row(dofs[k]));
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
      values(k) = dof_value(space, t, i, [&](const Position& x) { return field_value(v, x); });
      k = not_asked;
    }
  return values;
}

Eigen::VectorXd dof_values(const Space& space, const Field& v) {
  std::vector<int> all(static_cast<std::size_t>(space.size()));
  std::iota(all.begin(), all.end(), 0);
  return dof_values(space, all, v);
}

Eigen::VectorXd values_at_dofs(const Space& space, const Eigen::VectorXd& u) {
  if (space.element().nodal()) return u;
  const ReferencePoints points = space.element().support_points();
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

Eigen::Vector3d centroid(const TriangleMesh& mesh, int t) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const int corners = mesh.reference().vertices;
  for (int i = 0; i < corners; ++i)
    mean.head(mesh.dimension()) +=
        (1.0 / corners) * mesh.vertices.row(mesh.triangles(t, i)).transpose();
  return mean;
}

Eigen::Vector3d position(const TriangleMesh& mesh, int t, const ReferencePoint& xi) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  with_kind(mesh.kind, [&]<CellKind kind>() {
    x.head<CellMap<kind>::d>() = CellMap<kind>(mesh, t).point(xi);
  });
  return x;
}

Eigen::Vector2d point_in(const TriangleMesh& mesh, int t, const Eigen::Vector3d& lambda) {
  require_triangles(mesh, "point of a triangle");
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  for (int i = 0; i < 3; ++i)
    point += lambda(i) * mesh.vertices.row(mesh.triangles(t, i)).transpose();
  return point;
}

}  // namespace antilock
