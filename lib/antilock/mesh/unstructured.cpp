// Figure 6: an arbitrary triangulation, compatible with the decomposition into body and layer; gmsh makes it.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "antilock/core/error.hpp"
#include "antilock/mesh/detail/gmsh_session.hpp"
#include "antilock/mesh/detail/kept_meshes.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/refine.hpp"

namespace antilock {

namespace {

struct Curves {
  std::vector<int> clamped, contact, sigma;
  int body = 0, layer = 0;  ///< surfaces
};

/// The outline of Figure 2: corners from the bottom up, the layer (if any) below the body.
Curves add_geometry(const GmshSession& gmsh, double depth, double h_body, double h_layer) {
  Curves c;
  const int a = gmsh.add_point(0, 0, h_layer), b = gmsh.add_point(1, 0, h_layer);
  const int top_left = gmsh.add_point(0, 1, h_body), top_right = gmsh.add_point(1, 1, h_body);
  const int interface = gmsh.add_line(a, b), right = gmsh.add_line(b, top_right);
  const int top = gmsh.add_line(top_right, top_left), left = gmsh.add_line(top_left, a);
  c.body = gmsh.add_surface({interface, right, top, left});
  c.clamped = {right, top, left};
  if (depth > 0) {
    const int d = gmsh.add_point(0, -depth, h_layer), e = gmsh.add_point(1, -depth, h_layer);
    const int bottom = gmsh.add_line(d, e), up = gmsh.add_line(e, b), down = gmsh.add_line(a, d);
    c.layer = gmsh.add_surface({bottom, up, -interface, down});
    c.clamped.insert(c.clamped.end(), {up, down});
    c.contact = {bottom};
    c.sigma = {interface};
  } else {
    c.contact = {interface};
  }
  return c;
}

struct Vertices {
  Points points;
  std::unordered_map<std::size_t, int> of_tag;
};

Vertices read_vertices(const GmshSession& gmsh, double depth) {
  const auto [tags, xyz] = gmsh.nodes();
  Vertices v;
  v.points.resize(static_cast<Eigen::Index>(tags.size()), 2);
  // gmsh places points of the outline to about 1e-12: put them exactly on it
  const auto snap = [](double value, std::initializer_list<double> lines) {
    for (const double line : lines)
      if (std::abs(value - line) < 1e-9) return line;
    return value;
  };
  for (std::size_t i = 0; i < tags.size(); ++i) {
    v.points.row(static_cast<Eigen::Index>(i)) << snap(xyz[3 * i], {0, 1}), snap(xyz[3 * i + 1], {-depth, 0, 1});
    v.of_tag[tags[i]] = static_cast<int>(i);
  }
  return v;
}

/// The elements of one line (dimension 1) or surface (2): two or three vertices each.
std::vector<int> elements_of(const GmshSession& gmsh, int dimension, int entity, const Vertices& vertices) {
  std::vector<int> all;
  for (const std::size_t node : gmsh.elements_of(dimension, entity)) all.push_back(vertices.of_tag.at(node));
  return all;
}

/// gmsh's mesh with edges of about h in the body and h_layer along and below Sigma.
MeshArrays by_gmsh(double depth, double h, double h_layer, Mesher mesher) {
  const GmshSession gmsh;
  gmsh.set("Mesh.Algorithm", static_cast<int>(mesher));
  const Curves curves = add_geometry(gmsh, depth, h, h_layer);
  gmsh.generate();

  const Vertices vertices = read_vertices(gmsh, depth);
  std::vector<int> corners;
  std::vector<Region> region;
  for (const auto& [surface, name] : {std::pair{curves.body, Region::body}, std::pair{curves.layer, Region::layer}}) {
    if (surface == 0) continue;
    const auto some = elements_of(gmsh, 2, surface, vertices);
    corners.insert(corners.end(), some.begin(), some.end());
    region.resize(corners.size() / 3, name);
  }
  std::vector<TaggedEdge> tagged;
  for (const auto& [lines, tag] :
       {std::pair{curves.clamped, EdgeTag::clamped}, std::pair{curves.contact, EdgeTag::contact},
        std::pair{curves.sigma, EdgeTag::sigma}})
    for (const int line : lines) {
      const auto ends = elements_of(gmsh, 1, line, vertices);
      for (std::size_t i = 0; i < ends.size(); i += 2) tagged.push_back({ends[i], ends[i + 1], tag});
    }
  Triples triangles = Eigen::Map<Triples>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
  return {vertices.points, std::move(triangles), std::move(region), std::move(tagged)};
}

}  // namespace

TriangleMesh unstructured_mesh(int cells, const Domain& domain, Mesher mesher) {
  check_mesh_request(cells, 512, domain);
  const double depth = domain.layer_depth, h = 1.0 / cells, h_layer = depth > 0 ? std::min(h, depth / 2) : h;
  // gmsh's seconds grow faster than its triangles: 0.5 s at 64 cells, 4 at 128, 28 at 256
  constexpr int most_by_gmsh = 128, most_to_refine = 80;
  int halvings = 0;
  const auto fits = [&](int k) { return depth == 0 || (1 << k) * h_layer <= depth; };  // else its triangles were flat
  if (cells > most_by_gmsh)
    while ((most_to_refine << halvings) < cells && fits(halvings + 1)) ++halvings;
  const double h_made = (1 << halvings) * h, h_layer_made = (1 << halvings) * h_layer;
  MeshArrays made =
      kept_mesh(fmt::format("unstructured{}_{:a}_{:a}_{:a}", static_cast<int>(mesher), depth, h_made, h_layer_made),
                [&] { return by_gmsh(depth, h_made, h_layer_made, mesher); });
  TriangleMesh mesh = make_triangle_mesh(std::move(made.vertices), std::move(made.triangles), std::move(made.region),
                                         made.tagged, "unstructured mesh");
  for (int i = 0; i < halvings; ++i) mesh = refined(mesh);
  return mesh;
}

}  // namespace antilock
