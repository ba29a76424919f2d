// Behind 02_meshes.cpp: the reader moves vertices of the structured mesh's layer, and both
// counts of the chapter answer.
#include <CLI/CLI.hpp>
#include <sstream>

std::string moves;  // vertex, its way in x and in y; the next one

void move(const tutorial::Options& options, tutorial::Report&) {
  TriangleMesh mesh = structured_mesh(options.cells);
  std::istringstream text(moves);
  int vertex = 0;
  for (double dx = 0, dy = 0; text >> vertex >> dx >> dy;) {
    if (vertex < 0 || vertex >= mesh.vertex_count())
      throw Error(fmt::format("the mesh has no vertex {}", vertex));
    mesh.vertices.row(vertex) += Eigen::RowVector2d(dx, dy);
  }
  Table triangles({"a", "b", "c", "group"}), vertices({"x", "y", "moves"});
  const Groups groups = tied(mesh);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.twice_area(t) <= 0) throw Error("a triangle has turned over");
    triangles.add({mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2),
                   groups.leader[t]});
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const double x = mesh.vertices(v, 0), y = mesh.vertices(v, 1);
    vertices.add(
        {x, y,
         x > 0 && x < 1 && y > -1 && y < 0});  // those on lines of the domain stay there
  }
  triangles.filter_number("group", [](double group) { return group >= 0; })
      .write(options.out / "triangles.csv");
  vertices.write(options.out / "vertices.csv");
  const int left = kernel_on_layer(mesh);
  fmt::print("{} of triangles; G_h has {} on the layer{}\n",
             groups.count == 1 ? "1 group" : fmt::format("{} groups", groups.count),
             left == 1 ? "1 function" : fmt::format("{} functions", left),
             left == 0 ? ": P1 locks on this mesh." : ".");
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--moves", moves, "vertex, in x, in y; and so on");
  };
  return tutorial::run(
      argc, argv, "figure_02_meshes", "groups and kernel of a mesh with moved vertices",
      {.takes_epsilon = false, .cells = 6, .least_cells = 2, .most_cells = 12, .add = add},
      move);
}
