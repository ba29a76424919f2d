// Figures 3 and 6. Two meshes of the same domain, and the one property that decides between them.
//
// Run: 02_meshes                 16 cells a unit side, as drawn; a moment
// Run: 02_meshes --cells 64
//
// What the pictures show. Figure 3: squares cut by a diagonal. Figure 6: an arbitrary triangulation of about the same
// size, by gmsh. Both are conforming, both respect the interface Sigma (no triangle lies on both sides), both are as
// regular as one could wish. By every rule of thumb they are equally good.
//
// What differs. As epsilon -> 0 the layer may only carry functions with d/dy v = 0. On a mesh such a function of P1 is
// constant along the normal in every triangle; it can bend only where a straight line of mesh edges crosses the whole
// layer along the normal, from Sigma to Gamma_C. So count these lines: cells + 1 on the structured mesh; on the
// unstructured one only the two ends of the layer, where v = 0 is prescribed. The kernel G_h of a0 has a function for
// each line inside, and none at all on the unstructured mesh: K_0h = {0}, the solution must vanish on the layer.
// That is locking, seen before anything is solved (Figure 7, tutorial 05).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// What a reader wants to know of a mesh.
struct Facts {
  int triangles, vertices, lines;
  double h, smallest_angle;        // longest edge; degrees
  double body_area, layer_area;    // 1 and 1
  double sigma, clamped, contact;  // lengths 1, 5 and 1
  int across;                      // triangles with vertices on both sides of Sigma
};

// Lines of mesh edges that cross the whole layer along the normal: climb from each vertex of Gamma_C, edge by edge.
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

Facts facts_of(const TriangleMesh& mesh) {
  Facts facts{mesh.triangle_count(),
              mesh.vertex_count(),
              normal_lines(mesh),
              mesh.diameter(),
              smallest_angle(mesh),
              0,
              0,
              0,
              0,
              0,
              0};
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    (mesh.region[t] == Region::body ? facts.body_area : facts.layer_area) += mesh.area(t);
    double low = 1, high = -1;
    for (int i = 0; i < 3; ++i) {
      low = std::min(low, mesh.vertices(mesh.triangles(t, i), 1));
      high = std::max(high, mesh.vertices(mesh.triangles(t, i), 1));
    }
    facts.across += low < 0 && high > 0;
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] == EdgeTag::sigma) facts.sigma += mesh.edge_length(e);
    if (mesh.edge_tag[e] == EdgeTag::clamped) facts.clamped += mesh.edge_length(e);
    if (mesh.edge_tag[e] == EdgeTag::contact) facts.contact += mesh.edge_length(e);
  }
  return facts;
}

bool covers_the_domain(const Facts& facts) {
  constexpr double exact = 1e-10;  // sums of some thousand areas and lengths
  const auto is = [](double measured, double wanted) { return std::abs(measured - wanted) < exact; };
  return is(facts.body_area, 1) && is(facts.layer_area, 1) && is(facts.sigma, 1) && is(facts.clamped, 5) &&
         is(facts.contact, 1) && facts.across == 0;
}

void print(const Facts& structured, const Facts& unstructured) {
  const auto row = [](const char* name, auto a, auto b) { fmt::print("  {:<46}{:>14}{:>14}\n", name, a, b); };
  const auto number = [](double value) { return fmt::format("{:.5g}", value); };
  fmt::print("\n");
  row("", "structured", "unstructured");
  row("triangles", structured.triangles, unstructured.triangles);
  row("vertices", structured.vertices, unstructured.vertices);
  row("longest edge h", number(structured.h), number(unstructured.h));
  row("smallest angle (degrees)", number(structured.smallest_angle), number(unstructured.smallest_angle));
  row("area of the body", number(structured.body_area), number(unstructured.body_area));
  row("area of the layer", number(structured.layer_area), number(unstructured.layer_area));
  row("length of Sigma", number(structured.sigma), number(unstructured.sigma));
  row("length of Gamma_D", number(structured.clamped), number(unstructured.clamped));
  row("length of Gamma_C", number(structured.contact), number(unstructured.contact));
  row("triangles on both sides of Sigma", structured.across, unstructured.across);
  row("lines of edges across the layer, both ends in", structured.lines, unstructured.lines);
  fmt::print("\n");
}

void meshes(const tutorial::Options& options, tutorial::Report& report) {
  report.stage("structured mesh");
  const TriangleMesh structured = structured_mesh(options.cells);
  report.stage("unstructured mesh, by gmsh, twice");
  const TriangleMesh unstructured = unstructured_mesh(options.cells), again = unstructured_mesh(options.cells);

  report.stage("write files");  // MSH for this library and others, FreeFEM's own format beside it
  write_msh(options.out / "structured.msh", structured);
  write_msh(options.out / "unstructured.msh", unstructured);
  write_freefem_mesh(options.out / "structured.freefem.msh", structured);
  write_freefem_mesh(options.out / "unstructured.freefem.msh", unstructured);
  report.finish();

  const Facts regular = facts_of(structured), arbitrary = facts_of(unstructured);
  print(regular, arbitrary);

  report.claim(covers_the_domain(regular) && covers_the_domain(arbitrary),
               "both meshes cover Figure 2: areas, boundary parts, and no triangle across Sigma");
  // A regular family: angles that stay away from 0, whatever h. 45 degrees by construction; gmsh is asked for its best.
  report.claim(std::min(regular.smallest_angle, arbitrary.smallest_angle) > 25,
               fmt::format("both are regular: no angle below {:.0f} degrees",
                           std::floor(std::min(regular.smallest_angle, arbitrary.smallest_angle))));
  report.claim(unstructured.vertices == again.vertices && unstructured.triangles == again.triangles,
               "the unstructured mesh is the same at every run, to the last bit");
  report.claim(regular.lines == options.cells + 1 && arbitrary.lines == 2,
               fmt::format("lines across the layer: {} = cells + 1 on the structured mesh, {} on the unstructured one "
                           "(its clamped ends)",
                           regular.lines, arbitrary.lines));
}

// Three things to try:
// - --cells 2, 3, 4: even the coarsest meshes of gmsh have no line across inside the layer.
// - structured_mesh(options.cells, {}, Diagonal::left): every number stays as it is.
// - jitter the vertices inside the layer of the structured mesh by 1e-9: how many lines are left? (tutorial 05: what
//   that does to the solution.)
int main(int argc, char** argv) {
  tutorial::Options options;
  options.takes_epsilon = false;
  options.cells = 16;
  return tutorial::run(argc, argv, "02_meshes", "Figures 3 and 6: the structured and the unstructured mesh", options,
                       meshes);
}
