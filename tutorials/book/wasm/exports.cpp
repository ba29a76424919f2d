// What the page's script calls. A throw of the library ends the call: the script reads what it says, and starts the
// module anew.
#include <cstdlib>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "antilock/core/error.hpp"
#include "live_figure.hpp"

namespace antilock {
namespace {

struct SentMesh {
  std::vector<double> vertices;  // x, y per vertex
  std::vector<int> triangles;    // three vertices per triangle
};
std::map<std::pair<int, bool>, SentMesh> sent_meshes;  // by cells, and whether it has a layer

}  // namespace

// gmsh is not in the page: it made these meshes when the book was built. Their tags follow from where the edges lie.
TriangleMesh unstructured_mesh(int cells, const Domain& domain, Mesher) {
  const bool layer = domain.layer_depth > 0;
  const auto sent = sent_meshes.find({cells, layer});
  if (sent == sent_meshes.end())
    throw Error("mesh: the page has no unstructured mesh with 1/h = " + std::to_string(cells));
  const auto& [xy, corners] = sent->second;
  for (const int v : corners)
    if (v < 0 || 2 * static_cast<std::size_t>(v) >= xy.size()) throw Error("mesh: the page's mesh is damaged");
  const Points points = Eigen::Map<const Points>(xy.data(), static_cast<Eigen::Index>(xy.size() / 2), 2);
  const Triples triangles = Eigen::Map<const Triples>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
  std::vector<Region> region;
  std::vector<TaggedEdge> tagged;
  const double bottom = layer ? -1 : 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Eigen::RowVector3i k = triangles.row(t);
    region.push_back(points(k(0), 1) + points(k(1), 1) + points(k(2), 1) > 0 ? Region::body : Region::layer);
    for (int i = 0; i < 3; ++i) {
      const int from = k(i), to = k((i + 1) % 3);
      const auto both = [&](int axis, double at) { return points(from, axis) == at && points(to, axis) == at; };
      if (both(1, bottom))
        tagged.push_back({from, to, EdgeTag::contact});
      else if (both(0, 0) || both(0, 1) || both(1, 1))
        tagged.push_back({from, to, EdgeTag::clamped});
    }
  }
  return make_triangle_mesh(points, triangles, region, tagged, "the page's mesh");
}

}  // namespace antilock

namespace {

using namespace antilock;

struct Made {
  double amount;
  std::unique_ptr<book::LiveFigure> figure;
};
std::map<std::tuple<int, int, int>, Made> made;  // by element, kind and cells, with the amount asked for last
book::LiveFigure* figures[2];                    // of `made`, those that are seen: P1, Crouzeix-Raviart
std::unique_ptr<book::LiveTruth> truth;
book::LiveNumbers numbers;
book::RoundOff round_off_numbers;
std::vector<float> picture;
std::vector<double> line;

book::LiveFigure& figure_of(int element, int kind, int cells, double amount) {
  Made& one = made[{element, kind, cells}];
  if (!one.figure || (one.amount != amount && static_cast<book::LiveMesh>(kind) == book::LiveMesh::moved)) {
    const Element& which = element == 0 ? p1() : crouzeix_raviart();
    one = {amount, std::make_unique<book::LiveFigure>(static_cast<book::LiveMesh>(kind), cells, amount, which)};
  }
  return *one.figure;
}

const book::LiveTruth& truth_at(double epsilon) {
  if (!truth || truth->epsilon != epsilon) truth = std::make_unique<book::LiveTruth>(epsilon);
  return *truth;
}

}  // namespace

#define EXPORT(name) extern "C" __attribute__((export_name(#name)))

/// Room for a mesh of gmsh's, which the script then fills: x, y per vertex; three vertices per triangle.
EXPORT(mesh_vertices) double* mesh_vertices(int cells, int layer, int count) {
  std::vector<double>& room = sent_meshes[{cells, layer != 0}].vertices;
  room.assign(2 * static_cast<std::size_t>(count), 0);
  return room.data();
}
EXPORT(mesh_triangles) int* mesh_triangles(int cells, int layer, int count) {
  std::vector<int>& room = sent_meshes[{cells, layer != 0}].triangles;
  room.assign(3 * static_cast<std::size_t>(count), 0);
  return room.data();
}

/// element: 0 P1, 1 Crouzeix-Raviart; kind: in the order of LiveMesh. A mesh is made once.
EXPORT(discretise) void discretise(int element, int kind, int cells, double amount) {
  figures[element] = &figure_of(element, kind, cells, amount);
}
/// Makes a mesh that is not seen yet, and its factor, before it is asked for.
EXPORT(prepare) void prepare(int element, int kind, int cells, double amount, double epsilon) {
  book::LiveFigure& figure = figure_of(element, kind, cells, amount);
  if (figure.solution().u.size() > 0 || &figure == figures[element]) return;
  figure.solve(epsilon, truth_at(epsilon));
}
/// The members of LiveNumbers in their order.
EXPORT(solve) const double* solve(int element, double epsilon) {
  numbers = figures[element]->solve(epsilon, truth_at(epsilon));
  return &numbers.largest_on_contact;
}
/// x, y, u per corner; `size` tells how many numbers there are. The same for the lines below.
EXPORT(surface) const float* surface(int element) {
  picture = figures[element]->picture();
  return picture.data();
}
EXPORT(surface_size) int surface_size() { return static_cast<int>(picture.size()); }
EXPORT(trace) const double* trace(int element) {
  line = figures[element]->trace();
  return line.data();
}
EXPORT(ridge) const double* ridge(double epsilon, int points) {
  line = book::ridge_line(truth_at(epsilon), points);
  return line.data();
}
EXPORT(line_size) int line_size() { return static_cast<int>(line.size()); }
/// The members of RoundOff.
EXPORT(round_off) const double* round_off(int cells, double epsilon) {
  round_off_numbers = book::round_off(cells, epsilon, truth_at(epsilon));
  return &round_off_numbers.split;
}

#include <exception>
extern "C" __attribute__((import_module("page"), import_name("thrown"))) void page_thrown(const char* what);
extern "C" void* __cxa_allocate_exception(std::size_t size) noexcept { return std::malloc(size); }
extern "C" void __cxa_free_exception(void*) noexcept {}
extern "C" [[noreturn]] void __cxa_throw(void* thrown, void*, void (*)(void*)) {
  page_thrown(static_cast<std::exception*>(thrown)->what());
  __builtin_trap();
}
