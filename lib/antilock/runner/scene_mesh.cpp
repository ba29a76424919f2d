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
/// How far the depth and the measure of a layer may be from those of the scene, as a share of them.
/// A layer may be thinner than `slack` of the body, and a wrong depth changes its stiffness by the
/// same share.
constexpr double layer_slack = 1e-3;

/// A part of a mesh: its bounding box, with z = 0 in the plane, and its measure.
struct Extent {
  Eigen::AlignedBox3d box;
  double size = 0;
};

Eigen::Vector3d place_of(const Mesh& mesh, int vertex) {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  place.head(mesh.dimension()) = mesh.vertices.row(vertex).transpose();
  return place;
}

Extent extent_of(const Mesh& mesh, Region region) {
  Extent extent;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    extent.size += mesh.measure(t);
    for (const int v : mesh.triangles.row(t)) extent.box.extend(place_of(mesh, v));
  }
  return extent;
}

/// The words of messages, which differ between the plane and space.
struct Words {
  const char* axis;    ///< across the layer
  const char* facet;   ///< of the boundary
  const char* bottom;  ///< of the body
  const char* on;      ///< where the bottom is
  const char* size;    ///< of a facet
  const char* extent;  ///< of a cell
  const char* strip;   ///< the layer
};
const Words& words_of(const Mesh& mesh) {
  static constexpr Words plane{"y", "edge", "bottom edge", "line", "long", "area", "strip"};
  static constexpr Words space{"z", "face", "bottom", "plane", "large", "volume", "slab"};
  return mesh.dimension() == 2 ? plane : space;
}

/// "(0, 1) x (0, 2)", the sides of a box.
std::string box_text(const Eigen::Vector3d& low, const Eigen::Vector3d& high, int dimension) {
  std::string text;
  for (int k = 0; k < dimension; ++k)
    text += fmt::format("{}({:.6g}, {:.6g})", k > 0 ? " x " : "", low(k), high(k));
  return text;
}

/// Whether a facet rises by more than it goes along.
bool is_steep(const Mesh& mesh, int e) {
  const Eigen::Vector3d from = place_of(mesh, mesh.edges(e, 0));
  const Eigen::Vector3d along = place_of(mesh, mesh.edges(e, 1)) - from;
  if (mesh.dimension() == 2) return std::abs(along(1)) > std::abs(along(0));
  const Eigen::Vector3d normal = along.cross(place_of(mesh, mesh.edges(e, 2)) - from);
  return normal.head<2>().norm() > std::abs(normal(2));
}

/// The share `slack` of a facet as large as the body.
double facet_slack(const Mesh& mesh) {
  const double size = body_size(mesh);
  return slack * (mesh.dimension() == 2 ? size : size * size);
}

/// The body's facets on y = 0, in space on z = 0. All of them are in the group `tag`, or the rest
/// would be clamped, another problem.
Extent check_bottom_edge(const Mesh& mesh, EdgeTag tag) {
  const double off = slack * body_size(mesh);
  const Words& words = words_of(mesh);
  const int up = mesh.vertical();
  const Eigen::AlignedBox3d box = extent_of(mesh, Region::body).box;
  const Eigen::Vector3d low = box.min(), high = box.max();
  if (low(up) < -off)
    throw Error(fmt::format(
        "the group body reaches down to {0} = {1:.6g}; accepted: a body on and above {0} = 0",
        words.axis, low(up)));
  const auto body = [&](int t) { return t >= 0 && mesh.region[t] == Region::body; };
  Extent bottom;
  double tagged = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    double highest = 0;
    for (const int v : mesh.edges.row(e))
      highest = std::max(highest, std::abs(mesh.vertices(v, up)));
    if (highest > off) continue;
    if (body(mesh.edge_triangles(e, 0)) == body(mesh.edge_triangles(e, 1)))
      continue;                       // not where the body ends
    if (is_steep(mesh, e)) continue;  // the lowest of a side, in a mesh that is fine there
    bottom.size += mesh.facet_measure(e);
    if (mesh.edge_tag[e] == tag) tagged += mesh.facet_measure(e);
    for (const int v : mesh.edges.row(e)) bottom.box.extend(place_of(mesh, v));
  }
  if (bottom.size == 0)
    throw Error(fmt::format(
        "the group body has no {0} on the {1} {2} = 0 (it spans {3}); "
        "accepted: a body above {2} = 0 with its {4} on that {1}",
        words.facet, words.on, words.axis, box_text(low, high, mesh.dimension()), words.bottom));
  if (std::abs(tagged - bottom.size) > facet_slack(mesh))
    throw Error(
        fmt::format("of the body's {} on {} = 0, {:.6g} {}, {:.6g} are {}; accepted: all of it",
                    words.bottom, words.axis, bottom.size, words.size, tagged,
                    tag == EdgeTag::contact ? "in the group contact" : "above the layer"));
  return bottom;
}

/// The layer fills the strip of the given depth below Sigma: its measure and its box say so.
void check_layer(const Mesh& mesh, const Extent& sigma, double depth) {
  const auto [box, measure] = extent_of(mesh, Region::layer);
  const Words& words = words_of(mesh);
  const int up = mesh.vertical();
  const Eigen::Vector3d low = box.min(), high = box.max();
  Eigen::Vector3d lowest = sigma.box.min(), highest = sigma.box.max();
  lowest(up) = -depth;
  highest(up) = 0;
  const double size = body_size(mesh), height = std::max(size, depth);
  const Eigen::Vector3d off = (low - lowest).cwiseAbs().cwiseMax((high - highest).cwiseAbs());
  const double beside = off.head(up).maxCoeff(), below = off(up);
  const double wanted = sigma.size * depth, unfilled = std::abs(measure - wanted);
  if (beside <= slack * size && below <= std::min(slack * height, layer_slack * depth) &&
      unfilled <= std::min(height * facet_slack(mesh), layer_slack * wanted))
    return;
  throw Error(fmt::format(
      "the group layer spans {} with {} {:.6g}; accepted for this scene: the {} below the body's "
      "{}, {}, filled ({} {:.6g})",
      box_text(low, high, mesh.dimension()), words.extent, measure, words.strip, words.bottom,
      box_text(lowest, highest, mesh.dimension()), words.extent, wanted));
}

/// The contact facets lie on the lower side, all of it.
void check_contact_side(const Mesh& mesh, double bottom, double wanted) {
  const double height = std::max(body_size(mesh), -bottom);
  const Words& words = words_of(mesh);
  double size = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    size += mesh.facet_measure(e);
    for (const int v : mesh.edges.row(e))
      if (std::abs(mesh.vertices(v, mesh.vertical()) - bottom) > slack * height)
        throw Error(
            fmt::format("the contact {} at {} is not on the lower side; accepted: {} = {:.6g}",
                        words.facet, mesh.location_text(v), words.axis, bottom));
  }
  if (std::abs(size - wanted) > facet_slack(mesh))
    throw Error(fmt::format(
        "the group contact is {0:.6g} {1}; accepted: the whole side {2} = {3:.6g}, {4:.6g} {1}",
        size, words.size, words.axis, bottom, wanted));
}

/// The edges of the mesh: of each cell in space, where the mesh does not number them.
std::vector<std::array<int, 2>> edges_of(const Mesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  if (mesh.dimension() == 2) {
    for (int e = 0; e < mesh.edge_count(); ++e)
      edges.push_back({mesh.edges(e, 0), mesh.edges(e, 1)});
    return edges;
  }
  const ReferenceCell& cell = mesh.reference();
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    for (int i = 0; i < cell.edges; ++i)
      edges.push_back({mesh.triangles(t, cell.edge[i][0]), mesh.triangles(t, cell.edge[i][1])});
  }
  return edges;
}

/// Columns whose x a file has rounded are columns: from Sigma down, a layer edge that is off the
/// vertical by no more than a file's digits is made vertical. At a tiny epsilon such an edge would
/// tie its neighbours to each other.
void straighten_columns(Mesh& mesh, double depth) {
  const double size = body_size(mesh);
  const double digits = 1e-8 * size;
  const int up = mesh.vertical();
  std::vector<std::array<int, 2>> edges;  // of the layer, the upper vertex first
  for (std::array<int, 2> ends : edges_of(mesh)) {
    if (mesh.vertices(ends[0], up) < mesh.vertices(ends[1], up)) std::swap(ends[0], ends[1]);
    const bool from_sigma_or_below = mesh.vertices(ends[0], up) <= slack * size;
    if (from_sigma_or_below && mesh.vertices(ends[1], up) < -slack * std::max(size, depth))
      edges.push_back(ends);
  }
  const auto height = [&](const std::array<int, 2>& edge) { return mesh.vertices(edge[0], up); };
  std::sort(edges.begin(), edges.end(),
            [&](const auto& a, const auto& b) { return height(a) > height(b); });
  for (const auto& [upper, lower] : edges) {
    const Position along = (mesh.vertices.row(upper) - mesh.vertices.row(lower)).cwiseAbs();
    if (along.head(up).maxCoeff() <= std::min(digits, 1e-3 * along(up)))
      mesh.vertices.row(lower).head(up) = mesh.vertices.row(upper).head(up);
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
  if (file.mesh.dimension == 3) return "tetrahedra";
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
  Eigen::AlignedBox3d line;
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e))
      if (mesh.edge_tag[e] == EdgeTag::contact) line.extend(place_of(mesh, v));
  const bool curved = line.sizes()(mesh.vertical()) > slack * body_size(mesh);
  const Words& words = words_of(mesh);
  const std::string what = straight_contact_of(file);
  if (curved && !what.empty())
    throw Error(fmt::format(
        "has contact {0}s off the {1} {2} = 0, which do not go with {3}; accepted: all on that {1}",
        words.facet, words.on, words.axis, what));
  return curved;
}

TriangleMesh read_mesh_of(const SceneFile& scene_file, const Geometry& geometry) {
  const Scene& scene = scene_file.scene;
  const std::string path = scene_file.mesh.file.string();
  TriangleMesh mesh = read_msh(path, scene_file.groups);
  if (mesh.dimension() != scene_file.mesh.dimension)
    throw InputError(
        fmt::format("{}: mesh.dimension: is {}, and {} has {}; accepted: {}, or another file",
                    scene_file.name, scene_file.mesh.dimension, printable(path, 1000),
                    mesh.reference().plural, mesh.dimension()));
  const double depth = scene.layer_depth();
  const auto layered = [&] {
    return std::count(mesh.region.begin(), mesh.region.end(), Region::layer) > 0;
  };
  mesh.geometry = geometry;
  if (mesh.dimension() == 2) check_geometry(mesh);
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
  const std::string& kind = file.mesh.kind;
  const int cells = file.mesh.cells;
  const CellKind cell = file.mesh.cell_kind();
  const auto at_its_key = [&](const Error& error) {
    const char* const key = file.mesh.from_file() ? ": mesh.file: " : ": mesh.cells: ";
    return file.name + key + printable(error.what(), 2000);
  };
  const Domain domain{file.scene.layer_depth(), cell};
  const Geometry named = named_geometry(file);
  try {
    if (kind == "structured") return structured_mesh(cells, domain);
    if (kind == "unstructured") return unstructured_mesh(cells, domain);
    if (kind == "layered") return layered_mesh(cells, file.scene.epsilon().value_or(1), cell);
    return read_mesh_of(file, named);
  } catch (const InputError&) {
    throw;
  } catch (const MeshError& error) {
    throw InputError(at_its_key(error) +
                     "; accepted: MSH 2.2 or 4.1 with the groups body, layer (if the scene has "
                     "one), clamped and contact, its " +
                     reference_cell(cell).plural + " proper and connected");
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
  // the reader of scenes has asked the formulas on a plane mesh that is made here
  if (file.mesh.from_file() || file.mesh.dimension == 3) check_on_mesh(file, mesh);
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
