// VTU, the unstructured grid of VTK's XML formats: for ParaView and for the figures.
#include <fmt/format.h>

#include "antilock/core/error.hpp"
#include "antilock/io/detail/vtu_grid.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/layered.hpp"

namespace antilock {
namespace {

Points drawn(const TriangleMesh& mesh) { return mesh.curved() ? drawn_along_normals(mesh) : mesh.vertices; }

/// Three points per triangle, so that a field that jumps from triangle to triangle can.
VtuGrid torn_grid(const TriangleMesh& mesh) {
  const Points vertices = drawn(mesh);
  const int corners = 3 * mesh.triangle_count();
  VtuGrid grid{Points(corners, 2), Triples(mesh.triangle_count(), 3), {}, {}};
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      grid.points.row(3 * t + i) = vertices.row(mesh.triangles(t, i));
      grid.triangles(t, i) = 3 * t + i;
    }
  return grid;
}

void add_regions(VtuGrid& grid, const TriangleMesh& mesh) {
  Eigen::VectorXd region(mesh.triangle_count());
  for (int t = 0; t < mesh.triangle_count(); ++t) region(t) = static_cast<int>(mesh.region[t]);
  grid.cell_data.push_back({"region", region, true});
  grid.region_names = {"none", "body", "layer"};
}

/// The values of u at the points of torn_grid (for CR they are m_j + m_k - m_i).
Eigen::VectorXd corner_values(const Space& space, const Eigen::VectorXd& u) {
  const Element& element = space.element();
  Eigen::MatrixXd basis(3, element.unknowns());  // a row per corner
  for (int i = 0; i < 3; ++i) basis.row(i) = element.basis(Eigen::Vector3d::Unit(i)).transpose();
  Eigen::VectorXd values(3 * space.mesh().triangle_count());
  for (int t = 0; t < space.mesh().triangle_count(); ++t) {
    const Eigen::VectorXi unknowns = space.unknowns().row(t);
    values.segment<3>(3 * t) = basis * u(unknowns);
  }
  return values;
}

/// The contact pressure at the points of the grid: at a vertex its own, on a Crouzeix-Raviart edge that of the edge.
Eigen::VectorXd point_pressure(const Space& space, const Eigen::VectorXd& pressure) {
  const TriangleMesh& mesh = space.mesh();
  const std::vector<int>& contact = space.contact();
  if (space.element().per_vertex() > 0) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(mesh.vertex_count());
    for (std::size_t k = 0; k < contact.size(); ++k)
      if (contact[k] < mesh.vertex_count()) values(contact[k]) = pressure(static_cast<Eigen::Index>(k));
    return values;
  }
  Eigen::VectorXd values = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(mesh.triangle_count()));
  for (std::size_t k = 0; k < contact.size(); ++k) {
    const int triangle = mesh.edge_triangles(contact[k], 0);
    for (int i = 0; i < 3; ++i)
      if (mesh.triangle_edges(triangle, i) == contact[k])
        values(3 * triangle + (i + 1) % 3) = values(3 * triangle + (i + 2) % 3) =
            pressure(static_cast<Eigen::Index>(k));
  }
  return values;
}

void check_values(const std::filesystem::path& path, const char* name, const char* each, const Eigen::VectorXd& values,
                  int count) {
  if (values.size() != count || !values.allFinite())
    throw Error(fmt::format("{}: {} must be {} finite values, one {}; it has {}, {} of them finite", path.string(),
                            name, count, each, values.size(), values.array().isFinite().count()));
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Space& space, const Eigen::VectorXd& u, const VtuFields& more) {
  check_values(path, "u", "per unknown", u, space.size());
  const TriangleMesh& mesh = space.mesh();
  if (more.p.size() > 0) check_values(path, "p", "per triangle", more.p, mesh.triangle_count());
  if (more.pressure.size() > 0)
    check_values(path, "pressure", "per contact unknown", more.pressure, static_cast<int>(space.contact().size()));
  // elements with unknowns at the vertices share them; the others jump there
  const bool shared = space.element().per_vertex() > 0;
  VtuGrid grid = shared ? VtuGrid{drawn(mesh), mesh.triangles, {}, {}} : torn_grid(mesh);
  grid.point_data.push_back({"u", shared ? Eigen::VectorXd(u.head(mesh.vertex_count())) : corner_values(space, u)});
  if (more.pressure.size() > 0) grid.point_data.push_back({"pressure", point_pressure(space, more.pressure)});
  add_regions(grid, mesh);
  if (more.p.size() > 0) grid.cell_data.push_back({"p", more.p});
  write_grid(path, grid);
}

void write_vtu(const std::filesystem::path& path, const TriangleMesh& mesh, const Eigen::MatrixX3d& corners) {
  const Eigen::VectorXd values = corners.transpose().reshaped();
  check_values(path, "u", "per corner", values, 3 * mesh.triangle_count());
  VtuGrid grid = torn_grid(mesh);
  grid.point_data.push_back({"u", values});
  add_regions(grid, mesh);
  write_grid(path, grid);
}

void write_deformed_vtu(const std::filesystem::path& path, const VectorSpace& space, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& pressure) {
  const TriangleMesh& mesh = space.x.mesh();
  check_values(path, "u", "per unknown", u, space.size());
  check_values(path, "pressure", "per triangle", pressure, mesh.triangle_count());
  VtuGrid grid = torn_grid(mesh);
  Eigen::MatrixXd displacement = Eigen::MatrixXd::Zero(grid.points.rows(), 3);
  displacement.col(0) = corner_values(space.x, u.head(space.x.size()));
  displacement.col(1) = corner_values(space.y, u.tail(space.y.size()));
  grid.points += displacement.leftCols(2);
  grid.point_data.push_back({"displacement", displacement});
  grid.cell_data.push_back({"pressure", pressure});
  write_grid(path, grid);
}

}  // namespace antilock
