// The mesh that a scene file asks for: made here, or read and held against the scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/io/expression.hpp"
#include "antilock/io/scene_file.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/msh_file.hpp"

namespace antilock {
namespace {

constexpr double slack = 1e-6;  // mesh generators place corners to 1e-12, formats with few digits to 1e-8

/// A region must fill its rectangle (0,1) x (bottom, bottom + height): its box and its area say so.
void check_covers(const TriangleMesh& mesh, Region region, double bottom, double height) {
  double area = 0;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = -low;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    area += mesh.area(t);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d vertex = mesh.vertices.row(mesh.triangles(t, i));
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
  }
  const Eigen::Vector2d low_wanted(0, bottom), high_wanted(1, bottom + height);
  const bool box =
      (low - low_wanted).cwiseAbs().maxCoeff() <= slack && (high - high_wanted).cwiseAbs().maxCoeff() <= slack;
  if (box && std::abs(area - height) <= slack) return;
  throw Error(fmt::format(
      "the group {} spans ({:.6g}, {:.6g}) x ({:.6g}, {:.6g}) with area {:.6g}; accepted for this scene: (0, 1) x "
      "({:.6g}, {:.6g}), filled",
      region == Region::body ? "body" : "layer", low(0), high(0), low(1), high(1), area, bottom, bottom + height));
}

/// The contact edges lie on the lower side, all of it: what is not in contact there would be clamped, another problem.
void check_contact_side(const TriangleMesh& mesh, double bottom) {
  double length = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    length += mesh.edge_length(e);
    for (int end = 0; end < 2; ++end)
      if (const auto vertex = mesh.vertices.row(mesh.edges(e, end)); std::abs(vertex(1) - bottom) > slack)
        throw Error(fmt::format("the contact edge at ({:.6g}, {:.6g}) is not on the lower side; accepted: y = {:.6g}",
                                vertex(0), vertex(1), bottom));
  }
  if (std::abs(length - 1) > slack)
    throw Error(fmt::format("the group contact is {:.6g} long; accepted: the whole side y = {:.6g}", length, bottom));
}

TriangleMesh read_mesh_of(const Scene& scene, const std::string& path) {
  TriangleMesh mesh = read_msh(path);
  const double depth = scene.layer_depth();
  const bool has_layer = std::count(mesh.region.begin(), mesh.region.end(), Region::layer) > 0;
  try {
    if (has_layer && depth == 0)
      throw Error("has a group layer, which this scene has no use for; accepted: a mesh of the body alone");
    if (!has_layer && depth > 0) throw Error("has nothing in the physical group \"layer\", which this scene needs");
    check_covers(mesh, Region::body, 0, 1);
    if (has_layer) check_covers(mesh, Region::layer, -depth, depth);
    check_contact_side(mesh, -depth);
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
  return mesh;
}

}  // namespace

TriangleMesh make_mesh(const SceneFile& file) {
  const Domain domain{file.scene.layer_depth()};
  const bool from_file = file.mesh.kind == MeshRequest::Kind::file;
  try {
    if (from_file) return read_mesh_of(file.scene, file.mesh.file.string());
    if (file.mesh.kind == MeshRequest::Kind::structured) return structured_mesh(file.mesh.cells, domain);
    return unstructured_mesh(file.mesh.cells, domain);
  } catch (const Error& error) {
    std::string what = printable(error.what(), 2000);
    if (what.find("accepted") == std::string::npos)
      what +=
          "; accepted: MSH 2.2 or 4.1 with the groups body, layer (if the scene has one), clamped and contact, its "
          "triangles proper and connected";
    throw Error(file.name + (from_file ? ": mesh.file: " : ": mesh.cells: ") + what);
  }
}

double mesh_width(const SceneFile& file, const TriangleMesh& mesh) {
  return file.mesh.kind == MeshRequest::Kind::file ? mesh.diameter() : 1.0 / file.mesh.cells;
}

}  // namespace antilock
