// The mesh that a scene file asks for: made here, or read and held against the scene.
#include "antilock/runner/scene_mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/runner/scene_checks.hpp"
#include "antilock/runner/scene_file.hpp"

namespace antilock {
namespace {

/// How far two lengths that are meant to be one may differ, as a share of the size of the body or
/// of the depth of the layer: mesh generators place corners to 1e-12 of it, formats with few digits
/// to 1e-8.
constexpr double slack = 1e-6;

/// A part of a mesh: its bounding box, and its area or its length.
struct Extent {
  Eigen::AlignedBox2d box;
  double size = 0;
};

Extent extent_of(const TriangleMesh& mesh, Region region) {
  Extent extent;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    extent.size += mesh.area(t);
    for (const int v : mesh.triangles.row(t)) extent.box.extend(mesh.vertices.row(v).transpose());
  }
  return extent;
}

/// The body's edges on the line y = 0, all of which are in the group `tag`, or the rest would be
/// clamped, another problem.
Extent check_bottom_edge(const TriangleMesh& mesh, EdgeTag tag) {
  const double off = slack * body_size(mesh);
  const Eigen::AlignedBox2d box = extent_of(mesh, Region::body).box;
  const Eigen::Vector2d low = box.min(), high = box.max();
  if (low(1) < -off)
    throw Error(fmt::format(
        "the group body reaches down to y = {:.6g}; accepted: a body on and above y = 0", low(1)));
  const auto body = [&](int t) { return t >= 0 && mesh.region[t] == Region::body; };
  Extent bottom;
  double tagged = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const Eigen::Matrix2d ends = mesh.vertices(mesh.edges.row(e), Eigen::indexing::all);
    if (ends.col(1).cwiseAbs().maxCoeff() > off) continue;
    if (body(mesh.edge_triangles(e, 0)) == body(mesh.edge_triangles(e, 1)))
      continue;  // not where the body ends
    const Eigen::RowVector2d along = (ends.row(1) - ends.row(0)).cwiseAbs();
    if (along(1) > along(0)) continue;  // the lowest edges of a side, in a mesh that is fine there
    bottom.size += mesh.edge_length(e);
    if (mesh.edge_tag[e] == tag) tagged += mesh.edge_length(e);
    bottom.box.extend(ends.row(0).transpose()).extend(ends.row(1).transpose());
  }
  if (bottom.size == 0)
    throw Error(
        fmt::format("the group body has no edge on the line y = 0 (it spans ({:.6g}, {:.6g}) x "
                    "({:.6g}, {:.6g})); "
                    "accepted: a body above y = 0 with its bottom edge on that line",
                    low(0), high(0), low(1), high(1)));
  if (std::abs(tagged - bottom.size) > off)
    throw Error(fmt::format(
        "of the body's bottom edge on y = 0, {:.6g} long, {:.6g} are {}; accepted: all of it",
        bottom.size, tagged, tag == EdgeTag::contact ? "in the group contact" : "above the layer"));
  return bottom;
}

/// The layer fills the strip of the given depth below Sigma: its area and its box say so.
void check_layer(const TriangleMesh& mesh, const Extent& sigma, double depth) {
  const auto [box, area] = extent_of(mesh, Region::layer);
  const Eigen::Vector2d low = box.min(), high = box.max();
  const double left = sigma.box.min()(0), right = sigma.box.max()(0);
  const double size = body_size(mesh), height = std::max(size, depth);
  const double beside = std::max(std::abs(low(0) - left), std::abs(high(0) - right));
  const double below = std::max(std::abs(low(1) + depth), std::abs(high(1)));
  const double unfilled = std::abs(area - sigma.size * depth);
  if (beside <= slack * size && below <= slack * height && unfilled <= slack * height * size)
    return;
  throw Error(fmt::format(
      "the group layer spans ({:.6g}, {:.6g}) x ({:.6g}, {:.6g}) with area {:.6g}; accepted for "
      "this scene: the strip "
      "below the body's bottom edge, ({:.6g}, {:.6g}) x ({:.6g}, 0), filled (area {:.6g})",
      low(0), high(0), low(1), high(1), area, left, right, -depth, sigma.size * depth));
}

/// The contact edges lie on the lower side, all of it.
void check_contact_side(const TriangleMesh& mesh, double bottom, double wanted) {
  const double size = body_size(mesh), height = std::max(size, -bottom);
  double length = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    length += mesh.edge_length(e);
    for (const int v : mesh.edges.row(e))
      if (const auto vertex = mesh.vertices.row(v); std::abs(vertex(1) - bottom) > slack * height)
        throw Error(fmt::format(
            "the contact edge at ({:.6g}, {:.6g}) is not on the lower side; accepted: y = {:.6g}",
            vertex(0), vertex(1), bottom));
  }
  if (std::abs(length - wanted) > slack * size)
    throw Error(fmt::format(
        "the group contact is {:.6g} long; accepted: the whole side y = {:.6g}, {:.6g} long",
        length, bottom, wanted));
}

/// Columns whose x a file has rounded are columns: from Sigma down, a layer edge that is off the
/// vertical by no more than a file's digits is made vertical. At a tiny epsilon such an edge would
/// tie its neighbours to each other.
void straighten_columns(TriangleMesh& mesh, double depth) {
  const double size = body_size(mesh);
  const double digits = 1e-8 * size;
  std::vector<std::array<int, 2>> edges;  // of the layer, the upper vertex first
  for (int e = 0; e < mesh.edge_count(); ++e) {
    std::array<int, 2> ends{mesh.edges(e, 0), mesh.edges(e, 1)};
    if (mesh.vertices(ends[0], 1) < mesh.vertices(ends[1], 1)) std::swap(ends[0], ends[1]);
    const bool from_sigma_or_below = mesh.vertices(ends[0], 1) <= slack * size;
    if (from_sigma_or_below && mesh.vertices(ends[1], 1) < -slack * std::max(size, depth))
      edges.push_back(ends);
  }
  const auto y = [&](const std::array<int, 2>& edge) { return mesh.vertices(edge[0], 1); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return y(a) > y(b); });
  for (const auto& [upper, lower] : edges) {
    const Eigen::RowVector2d along =
        (mesh.vertices.row(upper) - mesh.vertices.row(lower)).cwiseAbs();
    if (along(0) <= std::min(digits, 1e-3 * along(1)))
      mesh.vertices(lower, 0) = mesh.vertices(upper, 0);
  }
}

/// Every edge of the boundary lies on a curve of the geometry.
void check_geometry(const TriangleMesh& mesh) {
  Points middles(mesh.edge_count(), 2);
  std::vector<int> all(mesh.edge_count());
  std::iota(all.begin(), all.end(), 0);
  follow_geometry(mesh, all, middles);
}

/// The part of a scene that needs contact edges on the line y = 0, in words; empty where nothing
/// does.
std::string straight_contact_of(const SceneFile& file) {
  if (const ModelTraits& model = traits_of(file.model); !model.curved_contact) return model.name;
  if (file.method.solver == "petsc") return "solver = \"petsc\"";
  const auto* layer = std::get_if<StiffLayer>(&file.scene.layer());
  if (layer == nullptr) return file.scene.epsilon() ? "this model of a layer" : "";
  if (layer->load) return "a load on the layer";
  return file.method.accuracy ? "an accuracy asked of a layer" : "";
}

/// Whether Gamma_C of a body is no straight line y = const. Throws Error for what does not go with
/// that.
bool is_curved(const SceneFile& file, const TriangleMesh& mesh) {
  Eigen::AlignedBox2d line;
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e))
      if (mesh.edge_tag[e] == EdgeTag::contact) line.extend(mesh.vertices.row(v).transpose());
  const bool curved = line.sizes()(1) > slack * body_size(mesh);
  const std::string what = straight_contact_of(file);
  if (curved && !what.empty())
    throw Error(fmt::format(
        "has contact edges off the line y = 0, which do not go with {}; accepted: all on that line",
        what));
  return curved;
}

TriangleMesh read_mesh_of(const SceneFile& scene_file, const Geometry& geometry) {
  const Scene& scene = scene_file.scene;
  const std::string path = scene_file.mesh.file.string();
  TriangleMesh mesh = read_msh(path, scene_file.groups);
  require_triangles(mesh, path.c_str());
  const double depth = scene.layer_depth();
  const auto layered = [&] {
    return std::count(mesh.region.begin(), mesh.region.end(), Region::layer) > 0;
  };
  mesh.geometry = geometry;
  check_geometry(mesh);
  // In plane strain without layer and contact the group contact is free, wherever its edges lie.
  // Two bodies have no contact edges; models/two_bodies.hpp checks their sides and their layer.
  const bool any_shape =
      std::holds_alternative<TwoBodyModel>(scene_file.model) ||
      (traits_of(scene_file.model).components > 1 && !scene.contact() && depth == 0);
  if (!any_shape && !layered() && is_curved(scene_file, mesh)) {
    TriangleMesh below =
        extruded(mesh, scene.epsilon().value_or(0), true);  // which says what Sigma may be
    return depth > 0 ? below : mesh;
  }
  if (depth > 0) straighten_columns(mesh, depth);
  if (!layered() && !any_shape && std::holds_alternative<StiffLayer>(scene.layer())) {
    check_bottom_edge(mesh, EdgeTag::contact);
    mesh = extruded(mesh, *scene.epsilon());  // the layer grows below the body
  }
  const bool has_layer = layered();
  try {
    if (has_layer && depth == 0)
      throw Error(
          "has a group layer, which this scene has no use for; accepted: a mesh of the body alone");
    if (!has_layer && depth > 0)
      throw MeshError("has nothing in the physical group \"layer\", which this scene needs");
    const auto& tags = mesh.edge_tag;
    if (std::holds_alternative<TwoBodyModel>(scene_file.model) &&
        std::find(tags.begin(), tags.end(), EdgeTag::contact) != tags.end())
      throw Error(
          "has edges in the group contact, although [contact] names slave and master; accepted: "
          "other groups");
    if (any_shape) return mesh;
    const Extent sigma = check_bottom_edge(mesh, has_layer ? EdgeTag::sigma : EdgeTag::contact);
    if (has_layer) check_layer(mesh, sigma, depth);
    check_contact_side(mesh, -depth, sigma.size);
    if (std::holds_alternative<VentcelLayer>(scene.layer()) &&
        sigma.box.sizes()(0) > sigma.size + slack * body_size(mesh))
      throw Error(
          "the body's bottom edge is in several pieces; accepted with model = \"ventcel\": one "
          "piece");
    if (std::holds_alternative<VentcelLayer>(scene.layer()))  // what its term refuses
      assemble(Scene({[](double, double) { return 0; }}, VentcelLayer{}, {}, scene.edges()),
               Space(mesh, p1()));
  } catch (const InputError&) {
    throw;
  } catch (const MeshError& error) {
    throw MeshError(path + ": " + error.what());
  } catch (const Error& error) {
    throw Error(path + ": " + error.what());
  }
  return mesh;
}

/// The geometry that the scene names, if it names one.
Geometry named_geometry(const SceneFile& file) {
  if (file.mesh.geometry.empty()) return {};
  try {
    return read_geometry(file.mesh.geometry);
  } catch (const Error& error) {
    throw InputError(file.name + ": mesh.geometry: " + error.what());
  }
}

TriangleMesh checked_mesh(const SceneFile& file) {
  const auto& [kind, cells, path, refinements, geometry] = file.mesh;
  const auto at_its_key = [&](const Error& error) {
    const char* const key = file.mesh.from_file() ? ": mesh.file: " : ": mesh.cells: ";
    return file.name + key + printable(error.what(), 2000);
  };
  const Domain domain{file.scene.layer_depth()};
  const Geometry named = named_geometry(file);
  try {
    if (kind == "structured") return structured_mesh(cells, domain);
    if (kind == "unstructured") return unstructured_mesh(cells, domain);
    if (kind == "layered") return layered_mesh(cells, file.scene.epsilon().value_or(1));
    return read_mesh_of(file, named);
  } catch (const InputError&) {
    throw;
  } catch (const MeshError& error) {
    throw InputError(at_its_key(error) +
                     "; accepted: MSH 2.2 or 4.1 with the groups body, layer (if the scene has "
                     "one), clamped and "
                     "contact, its triangles proper and connected");
  } catch (const Error& error) {
    throw InputError(at_its_key(error));
  }
}

}  // namespace

TriangleMesh make_mesh(const SceneFile& file) {
  constexpr std::int64_t most_triangles = 1 << 25;
  TriangleMesh mesh = checked_mesh(file);
  if (traits_of(file.model).free_sides && !file.mesh.from_file())
    mesh = with_free_sides(std::move(mesh));
  if (file.mesh.from_file()) check_on_mesh(file, mesh);
  const std::int64_t triangles = static_cast<std::int64_t>(mesh.triangle_count())
                                 << (2 * file.mesh.refinements);
  if (triangles > most_triangles)
    throw InputError(fmt::format(
        "{}: mesh.refinements: {} refinements of {} triangles make {}; accepted: up to {}",
        file.name, file.mesh.refinements, mesh.triangle_count(), triangles, most_triangles));
  for (int i = 0; i < file.mesh.refinements; ++i) mesh = refined(mesh);
  return mesh;
}

double mesh_width(const SceneFile& file, const TriangleMesh& mesh) {
  return file.mesh.from_file() || file.method.accuracy
             ? mesh.diameter()
             : 1.0 / (file.mesh.cells << file.mesh.refinements);
}

}  // namespace antilock
