// Figures 3 and 6. Two meshes of the same domain, and the one property that decides between them.
//
// Run: 02_meshes   16 cells per unit side, as drawn; a moment
// Run: 02_meshes --cells 64
//
// What the pictures show. Figure 3: squares cut by a diagonal. Figure 6: an arbitrary triangulation
// of about the same size, by gmsh. Both are conforming, both respect the interface Sigma (no
// triangle lies on both sides), and both have good angles. By every rule of thumb they are equally
// good.
//
// What differs. As epsilon -> 0 the layer may only carry functions with d/dy v = 0. A P1 function
// with this property is constant along the normal in every triangle. It can bend only where a
// straight line of mesh edges crosses the whole layer along the normal, from Sigma to Gamma_C. So
// count these lines. The structured mesh has cells + 1; the unstructured mesh has two, the ends of
// the layer, where v = 0 is prescribed. The kernel of a0 is G_h = { v in V_h : d/dy v = 0 in the
// layer }. On the layer, its functions are one per line inside: on the unstructured mesh every
// function of G_h, and of K_0h = K_h n G_h, vanishes on the layer. (In the body G_h asks nothing:
// every function is left there.) In the limit epsilon = 0 the discrete solution must vanish on the
// layer. That is locking, seen before anything is solved (Figure 7, tutorial 06).

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "antilock/io/writers.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

int normal_lines(const TriangleMesh& mesh);
std::map<std::string, double> facts(const TriangleMesh& mesh);  // what a reader wants to know of a mesh, by name

void meshes(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("structured mesh");
  const TriangleMesh regular = structured().mesh(options.cells);
  report.stage("unstructured mesh, by gmsh, twice");
  const TriangleMesh arbitrary = unstructured().mesh(options.cells), again = unstructured().mesh(options.cells);
  report.stage("write files");  // MSH for this library and others, FreeFEM's own format beside it
  write_msh(options.out / "structured.msh", regular);
  write_msh(options.out / "unstructured.msh", arbitrary);
  write_freefem_mesh(options.out / "structured.freefem.msh", regular);
  write_freefem_mesh(options.out / "unstructured.freefem.msh", arbitrary);
  report.finish();

  Table table({"", "structured", "unstructured"});
  const auto of_regular = facts(regular), of_arbitrary = facts(arbitrary);
  for (const auto& [name, value] : of_regular) table.add({name, value, of_arbitrary.at(name)});
  table.print("", 5);

  // 1e-10: sums of some thousand areas and lengths. 25 degrees: the angles of a regular family stay
  // away from 0.
  const std::map<std::string, double> figure2{{"area of the body", 1},  {"area of the layer", 1},
                                              {"length of Sigma", 1},   {"length of Gamma_D", 5},
                                              {"length of Gamma_C", 1}, {"triangles on both sides of Sigma", 0}};
  double off = 0;
  for (const auto& [name, wanted] : figure2)
    off = std::max({off, std::abs(of_regular.at(name) - wanted), std::abs(of_arbitrary.at(name) - wanted)});
  const double angle = std::min(of_regular.at("smallest angle (degrees)"), of_arbitrary.at("smallest angle (degrees)"));
  report.claim(off < 1e-10, "both meshes cover Figure 2: areas, boundary parts, and no triangle across Sigma");
  report.claim(angle > 25, "both are regular: no angle below {:.0f} degrees", std::floor(angle));
  report.claim(arbitrary.vertices == again.vertices && arbitrary.triangles == again.triangles,
               "the unstructured mesh is the same at every run, to the last bit");
  report.claim(normal_lines(regular) == options.cells + 1 && normal_lines(arbitrary) == 2,
               "lines across the layer: {} = cells + 1 on the structured mesh, {} on the unstructured one (its clamped "
               "ends)",
               normal_lines(regular), normal_lines(arbitrary));
}

// Lines of mesh edges that cross the whole layer along the normal: climb from each vertex of
// Gamma_C, edge by edge.
int normal_lines(const TriangleMesh& mesh) {
  constexpr double straight = 1e-12;  // of coordinates that are rounded once
  std::map<int, int> above;           // the vertex straight above another, where an edge leads there
  for (int e = 0; e < mesh.edge_count(); ++e) {
    int low = mesh.edges(e, 0), high = mesh.edges(e, 1);
    if (std::abs(mesh.vertices(low, 0) - mesh.vertices(high, 0)) > straight) continue;
    if (mesh.vertices(low, 1) > mesh.vertices(high, 1)) std::swap(low, high);
    above[low] = high;
  }
  int lines = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.vertices(v, 1) != -1) continue;
    int top = v;
    while (mesh.vertices(top, 1) < 0 && above.contains(top)) top = above[top];
    lines += mesh.vertices(top, 1) >= 0;
  }
  return lines;
}

// Three things to try:
// - --cells 2, 3, 4: even the coarsest meshes of gmsh have no line across inside the layer.
// - structured({}, Diagonal::left) in `meshes`: every number stays as it is.
// - jitter the vertices inside the layer of the structured mesh by 1e-9: how many lines are left?
//   (Tutorial 06: what that does to the solution.)
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.cells = 16;
  return tutorial::run(argc, argv, "02_meshes", "Figures 3 and 6: the structured and the unstructured mesh", options,
                       meshes);
}

double smallest_angle(const TriangleMesh& mesh) {
  double smallest = std::numbers::pi;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const Eigen::RowVector2d at = mesh.vertices.row(mesh.triangles(t, i));
      const Eigen::RowVector2d a = mesh.vertices.row(mesh.triangles(t, (i + 1) % 3)) - at;
      const Eigen::RowVector2d b = mesh.vertices.row(mesh.triangles(t, (i + 2) % 3)) - at;
      smallest = std::min(smallest, std::acos(a.dot(b) / (a.norm() * b.norm())));
    }
  return smallest * 180 / std::numbers::pi;
}

std::map<std::string, double> facts(const TriangleMesh& mesh) {
  std::map<std::string, double> facts{{"triangles", mesh.triangle_count()},
                                      {"vertices", mesh.vertex_count()},
                                      {"longest edge h", mesh.diameter()},
                                      {"smallest angle (degrees)", smallest_angle(mesh)},
                                      {"lines of edges across the layer, both ends in", normal_lines(mesh)}};
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    facts[mesh.region[t] == Region::body ? "area of the body" : "area of the layer"] += mesh.area(t);
    Eigen::Array3d y;
    for (int i = 0; i < 3; ++i) y(i) = mesh.vertices(mesh.triangles(t, i), 1);
    facts["triangles on both sides of Sigma"] += y.minCoeff() < 0 && y.maxCoeff() > 0;
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] == EdgeTag::sigma) facts["length of Sigma"] += mesh.edge_length(e);
    if (mesh.edge_tag[e] == EdgeTag::clamped) facts["length of Gamma_D"] += mesh.edge_length(e);
    if (mesh.edge_tag[e] == EdgeTag::contact) facts["length of Gamma_C"] += mesh.edge_length(e);
  }
  return facts;
}
