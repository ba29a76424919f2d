// Figure 6: an arbitrary triangulation, compatible with the decomposition into body and layer; gmsh
// makes it.
//
// Where the environment variable ANTILOCK_MESHES names a folder, what gmsh made is kept there under
// a name that says all that it depends on, and whoever asks for it again reads it, in this program
// or in another one. Meant for one run of many programs: tests/run, whose 300 programs ask 1,100
// times for 50 meshes, empties the folder before.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "antilock/core/atomic_file.hpp"
#include "antilock/mesh/detail/gmsh_session.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/refine.hpp"

namespace antilock {

namespace {

/// Vertices and cells, all that gmsh hands over.
using MeshArrays = std::pair<Points, IndexRows>;

/// gmsh places points of the outline to about 1e-12: this puts them exactly on it.
void snap_to_outline(Points& points, double depth) {
  const auto snap = [](double& value, std::initializer_list<double> lines) {
    for (const double line : lines)
      if (std::abs(value - line) < 1e-9) {
        value = line;
        return;
      }
  };
  const Eigen::Index vertical = points.cols() - 1;
  for (auto point : points.rowwise()) {
    for (Eigen::Index k = 0; k < vertical; ++k) snap(point(k), {0, 1});
    snap(point(vertical), {-depth, 0, 1});
  }
}

/// gmsh's mesh of Figure 2, with edges of about h in the body and h_layer along and below Sigma.
/// Quadrilaterals are pairs of its triangles. A triangle without a partner would remain, so gmsh
/// pairs the triangles of a mesh of width 2 h, and then cuts each cell into quadrilaterals from its
/// centre to the midpoints of its edges (RecombinationAlgorithm 3, "blossom full-quad").
MeshArrays by_gmsh(double depth, double h, double h_layer, Mesher mesher, CellKind kind) {
  GmshSession gmsh;
  gmsh.set("Mesh.Algorithm", static_cast<int>(mesher));
  if (kind == CellKind::quadrilateral) {
    gmsh.set("Mesh.RecombineAll", 1);
    gmsh.set("Mesh.RecombinationAlgorithm", 3);
  }
  const int a = gmsh.add_point(0, 0, h_layer),
            b = gmsh.add_point(1, 0, h_layer);  // the ends of Sigma
  const int top_left = gmsh.add_point(0, 1, h), top_right = gmsh.add_point(1, 1, h),
            sigma = gmsh.add_line(a, b);
  gmsh.add_surface({sigma, gmsh.add_line(b, top_right), gmsh.add_line(top_right, top_left),
                    gmsh.add_line(top_left, a)});
  if (depth > 0) {
    const int d = gmsh.add_point(0, -depth, h_layer), e = gmsh.add_point(1, -depth, h_layer);
    gmsh.add_surface({gmsh.add_line(d, e), gmsh.add_line(e, b), -sigma, gmsh.add_line(a, d)});
  }
  MeshArrays made = gmsh.generate(kind);
  snap_to_outline(made.first, depth);
  return made;
}

/// The same in space: a box above another one.
MeshArrays boxes_by_gmsh(double depth, double h, double h_layer) {
  GmshSession gmsh;
  std::vector<double> heights{0, 1};
  if (depth > 0) heights.insert(heights.begin(), -depth);
  // the corners and the four sides of each level, from (0, 0) counterclockwise
  std::vector<std::array<int, 4>> corners, sides;
  std::vector<int> floors;
  for (const double z : heights) {
    const double size = z > 0 ? h : h_layer;
    corners.push_back({gmsh.add_point(0, 0, size, z), gmsh.add_point(1, 0, size, z),
                       gmsh.add_point(1, 1, size, z), gmsh.add_point(0, 1, size, z)});
    sides.emplace_back();
    for (int i = 0; i < 4; ++i)
      sides.back()[i] = gmsh.add_line(corners.back()[i], corners.back()[(i + 1) % 4]);
    floors.push_back(gmsh.add_surface(sides.back()));
  }
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    std::array<int, 4> posts{}, walls{};
    for (int i = 0; i < 4; ++i) posts[i] = gmsh.add_line(corners[k][i], corners[k + 1][i]);
    for (int i = 0; i < 4; ++i)
      walls[i] = gmsh.add_surface({sides[k][i], posts[(i + 1) % 4], -sides[k + 1][i], -posts[i]});
    gmsh.add_volume({floors[k], floors[k + 1], walls[0], walls[1], walls[2], walls[3]});
  }
  MeshArrays made = gmsh.generate(CellKind::tetrahedron);
  snap_to_outline(made.first, depth);
  return made;
}

/// What `make` makes, or what was kept under that name: the numbers of vertices and of triangles,
/// then both arrays as they lie in memory. A file that does not hold what its numbers promise is
/// made anew.
template <class Make>
MeshArrays kept_mesh(const std::string& name, CellKind kind, Make&& make) {
  const char* folder = std::getenv("ANTILOCK_MESHES");
  if (folder == nullptr || *folder == '\0') return make();
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  const int dimension = reference_cell(kind).dimension, corners = reference_cell(kind).vertices;
  const std::size_t vertex = dimension * sizeof(double), triangle = corners * sizeof(int);
  std::array<std::uint64_t, 2> counts{};
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  std::ifstream in;
  if (!error) in.open(path, std::ios::binary);  // a pipe has no size, and opening it may never end
  const auto get = [&](auto* data, std::uint64_t bytes) -> bool {
    return !!in.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(bytes));
  };
  if (!error && get(counts.data(), sizeof counts) && counts[0] <= size / vertex &&
      counts[1] <= size / triangle &&
      size == sizeof counts + counts[0] * vertex + counts[1] * triangle) {
    MeshArrays kept{Points(counts[0], dimension), IndexRows(counts[1], corners)};
    if (get(kept.first.data(), counts[0] * vertex) &&
        get(kept.second.data(), counts[1] * triangle) && counts[1] > 0 &&
        kept.second.minCoeff() >= 0 && kept.second.maxCoeff() < kept.first.rows())
      return kept;
  }
  MeshArrays made = make();
  counts = {static_cast<std::uint64_t>(made.first.rows()),
            static_cast<std::uint64_t>(made.second.rows())};
  write_file(path, [&](std::ostream& out) {
    const auto put = [&](const auto* data, std::uint64_t bytes) {
      out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(bytes));
    };
    put(counts.data(), sizeof counts);
    put(made.first.data(), counts[0] * vertex);
    put(made.second.data(), counts[1] * triangle);
  });
  return made;
}

/// Throws where gmsh has left triangles without a partner: the quadrilaterals then have holes.
void check_filled(const TriangleMesh& mesh, double area) {
  double covered = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) covered += mesh.measure(t);
  if (!(std::abs(covered - area) < 1e-9 * area))
    throw MeshError(
        fmt::format("mesh: gmsh covers {:.6g} of the area {:.6g} with quadrilaterals; accepted: "
                    "another number of cells, or a structured mesh",
                    covered, area));
}

/// A number >= 0 as printf's %a writes it. fmt 10 writes 0 as 0x0p-1022.
std::string hexadecimal(double x) { return x == 0 ? "0x0p+0" : fmt::format("{:a}", x); }

}  // namespace

TriangleMesh unstructured_mesh(int cells, const Domain& domain, Mesher mesher) {
  const bool in_space = domain.kind == CellKind::tetrahedron;
  const bool recombined = domain.kind == CellKind::quadrilateral;
  constexpr int most_to_recombine = 128;  // not refined beyond
  int most = most_unstructured;
  if (in_space) most = most_unstructured_in_space;
  if (recombined) most = most_to_recombine;
  check_mesh_request(cells, most, domain);
  const double depth = domain.layer_depth, h = 1.0 / cells,
               h_layer = depth > 0 ? std::min(h, depth / 2) : h;
  // gmsh's seconds grow faster than its triangles: 0.5 s at 64 cells, 4 at 128, 28 at 256
  constexpr int most_by_gmsh = 128, most_to_refine = 80;
  int halvings = 0;
  const auto fits = [&](int k) {
    return depth == 0 || (1 << k) * h_layer <= depth;
  };  // else its triangles were flat
  if (cells > most_by_gmsh)
    while ((most_to_refine << halvings) < cells && fits(halvings + 1)) ++halvings;
  const double h_made = (1 << halvings) * h, h_layer_made = (1 << halvings) * h_layer;
  if (in_space) {
    auto [vertices, tetrahedra] =
        kept_mesh(fmt::format("tetrahedra_{}_{}_{}", hexadecimal(depth), hexadecimal(h),
                              hexadecimal(h_layer)),
                  domain.kind, [&] { return boxes_by_gmsh(depth, h, h_layer); });
    return tag_by_position(std::move(vertices), std::move(tetrahedra), domain.kind);
  }
  auto [vertices, triangles] = kept_mesh(
      fmt::format("{}{}_{}_{}_{}", recombined ? "recombined" : "unstructured",
                  static_cast<int>(mesher), hexadecimal(depth), hexadecimal(h_made),
                  hexadecimal(h_layer_made)),
      domain.kind, [&] { return by_gmsh(depth, h_made, h_layer_made, mesher, domain.kind); });
  TriangleMesh mesh = tag_by_position(std::move(vertices), std::move(triangles), domain.kind);
  if (recombined) check_filled(mesh, 1 + depth);
  for (int i = 0; i < halvings; ++i) mesh = refined(mesh);
  return mesh;
}

}  // namespace antilock
