#include "two_levels.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "antilock/core/matrix.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/space/space.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {
namespace {

using Rows = std::vector<int>;
using Triplets = std::vector<Eigen::Triplet<double>>;
using Factor = Eigen::SimplicialLLT<SparseMatrix>;

/// A_delta on the free unknowns of Crouzeix-Raviart.
struct System {
  explicit System(const TriangleMesh& mesh, double delta)
      : space(mesh, crouzeix_raviart()), row(space.size(), 0) {
    const VariationalInequality problem = assemble(paper_scene(1), space);
    for (const int i : problem.dirichlet_dofs) row[i] = -1;
    int free = 0;
    for (int& r : row)
      if (r == 0) r = free++;
    const SparseMatrix b = problem.b;
    const SparseMatrix weighted = problem.m.asDiagonal() * b;
    const SparseMatrix stiff = SparseMatrix(b.transpose()) * weighted;
    const SparseMatrix whole = problem.a1 + stiff / delta;
    Triplets entries;
    for (int column = 0; column < whole.outerSize(); ++column)
      for (SparseMatrix::InnerIterator it(whole, column); it; ++it)
        if (row[it.row()] >= 0 && row[it.col()] >= 0)
          entries.emplace_back(row[it.row()], row[it.col()], it.value());
    a.resize(free, free);
    a.setFromTriplets(entries.begin(), entries.end());
  }
  Space space;
  Rows row;  ///< per unknown of the space; -1 where it is clamped
  SparseMatrix a;
};

bool is_on_region(const TriangleMesh& mesh, int edge, Region region) {
  for (const int t : mesh.edge_triangles.row(edge))
    if (t >= 0 && mesh.region[t] == region) return true;
  return false;
}

/// The coarse functions as columns. On the body each is P1 of a vertex; an edge of it has
/// the mean of its two ends.
SparseMatrix coarse_functions(const System& system, bool hats) {
  const TriangleMesh& mesh = system.space.mesh();
  std::vector<char> clamped(mesh.vertex_count(), 0);
  std::vector<char> on_body(mesh.vertex_count(), 0);
  for (int e = 0; e < mesh.edge_count(); ++e)
    for (const int v : mesh.edges.row(e)) {
      if (is_dirichlet(mesh.edge_tag[e])) clamped[v] = 1;
      if (is_on_region(mesh, e, Region::body)) on_body[v] = 1;
    }
  int count = 0;
  Rows number(mesh.vertex_count(), -1);
  std::vector<std::pair<double, int>> sigma;  // x and vertex
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (on_body[v] == 0) continue;
    if (clamped[v] == 0) number[v] = count++;
    if (std::abs(mesh.vertices(v, 1)) < 1e-9) sigma.emplace_back(mesh.vertices(v, 0), v);
  }
  std::sort(sigma.begin(), sigma.end());

  Triplets entries;
  const auto add = [&](int row, int vertex, double value) {
    if (number[vertex] >= 0 && value != 0) entries.emplace_back(row, number[vertex], value);
  };
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int row = system.row[e];  // the unknown of Crouzeix-Raviart is the edge
    if (row < 0) continue;
    if (is_on_region(mesh, e, Region::body)) {
      for (const int v : mesh.edges.row(e)) add(row, v, 0.5);
      continue;
    }
    if (!hats) continue;
    // between two lines x = x_i a hat function is linear: its mean there is its value in
    // the middle
    const double at_first = mesh.vertices(mesh.edges(e, 0), 0);
    const double at_second = mesh.vertices(mesh.edges(e, 1), 0);
    const double a = std::min(at_first, at_second);
    const double b = std::max(at_first, at_second);
    for (std::size_t i = 0; i + 1 < sigma.size(); ++i) {
      const double left = sigma[i].first;
      const double right = sigma[i + 1].first;
      const bool is_vertical = b - a < 1e-12;
      if (is_vertical && (a < left || (a >= right && i + 2 < sigma.size()))) continue;
      const double from = std::max(a, left);
      const double to = std::min(b, right);
      if (!is_vertical && to <= from) continue;
      const double share = is_vertical ? 1 : (to - from) / (b - a);
      const double middle = is_vertical ? a : 0.5 * (from + to);
      const double hat = (middle - left) / (right - left);
      add(row, sigma[i].second, share * (1 - hat));
      add(row, sigma[i + 1].second, share * hat);
    }
  }
  SparseMatrix p(system.a.rows(), count);
  p.setFromTriplets(entries.begin(), entries.end());
  return p;
}

/// The set and the unknowns that the graph of the matrix reaches from it in `times` steps.
Rows grown(const SparseMatrix& a, Rows members, int times) {
  std::vector<char> is_in(a.rows(), 0);
  for (const int i : members) is_in[i] = 1;
  for (int k = 0; k < times; ++k) {
    const Rows before = members;
    for (const int column : before)
      for (SparseMatrix::InnerIterator it(a, column); it; ++it) {
        const int row = static_cast<int>(it.row());
        if (is_in[row] != 0) continue;
        is_in[row] = 1;
        members.push_back(row);
      }
  }
  std::sort(members.begin(), members.end());
  return members;
}

/// The layers of the graph by which a strip is grown.
constexpr int growth = 6;

/// Strips of full height, 16 h wide, grown by that many layers of the graph.
std::vector<Rows> strips_of_layer(const System& system, int cells, int layers) {
  const int count = std::max(1, cells / 16);
  std::vector<Rows> strips(count);
  for (int e = 0; e < system.space.size(); ++e) {
    if (system.row[e] < 0 || !is_on_region(system.space.mesh(), e, Region::layer)) continue;
    const int place = static_cast<int>(system.space.dof_coordinates()(e, 0) * count);
    strips[std::clamp(place, 0, count - 1)].push_back(system.row[e]);
  }
  for (Rows& strip : strips) strip = grown(system.a, strip, layers);
  return strips;
}

/// The edges at each vertex of the layer.
std::vector<Rows> patches_of_layer(const System& system) {
  const TriangleMesh& mesh = system.space.mesh();
  std::vector<Rows> stars(mesh.vertex_count());
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (system.row[e] >= 0 && is_on_region(mesh, e, Region::layer))
      for (const int v : mesh.edges.row(e)) stars[v].push_back(system.row[e]);
  std::erase_if(stars, [](const Rows& star) { return star.empty(); });
  return stars;
}

SparseMatrix submatrix(const SparseMatrix& a, const Rows& rows) {
  std::vector<int> place(a.rows(), -1);
  for (std::size_t k = 0; k < rows.size(); ++k) place[rows[k]] = static_cast<int>(k);
  Triplets entries;
  for (const int column : rows)
    for (SparseMatrix::InnerIterator it(a, column); it; ++it)
      if (place[it.row()] >= 0)
        entries.emplace_back(place[it.row()], place[column], it.value());
  const auto size = static_cast<Eigen::Index>(rows.size());
  SparseMatrix sub(size, size);
  sub.setFromTriplets(entries.begin(), entries.end());
  return sub;
}

/// One damped smoothing step, the coarse correction, and one damped smoothing step.
class Cycle {
 public:
  Cycle(const System& system, const TwoLevels& choice, int cells) : a_(system.a) {
    const TriangleMesh& mesh = system.space.mesh();
    sets_ =
        choice.strips ? strips_of_layer(system, cells, growth) : patches_of_layer(system);
    for (const Rows& set : sets_)
      factors_.push_back(std::make_unique<Factor>(submatrix(a_, set)));
    for (int e = 0; e < mesh.edge_count(); ++e)
      if (system.row[e] >= 0 && is_on_region(mesh, e, Region::body))
        body_.push_back(system.row[e]);
    body_matrix_ = submatrix(a_, body_);
    p_ = coarse_functions(system, choice.hats);
    const SparseMatrix coarse = SparseMatrix(p_.transpose()) * a_ * p_;
    coarse_.compute(coarse);
    // The sum over the sets has no eigenvalue above the number of sets that meet in a
    // triangle: with this damping all are 1.5 or less, and the cycle is positive definite.
    damping_ = 1.5 / most_sets_in_a_triangle(system);
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& r) const {
    Eigen::VectorXd z = damping_ * smoothed(r);
    const Eigen::VectorXd coarse_load = p_.transpose() * (r - a_ * z);
    const Eigen::VectorXd coarse = coarse_.solve(coarse_load);
    z += p_ * coarse;
    z += damping_ * smoothed(r - a_ * z);
    return z;
  }

 private:
  /// The sum of the corrections on all sets, each exact, and of symmetric Gauss-Seidel on
  /// the body.
  Eigen::VectorXd smoothed(const Eigen::VectorXd& r) const {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(r.size());
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      const Eigen::VectorXd here = r(sets_[k]);
      const Eigen::VectorXd correction = factors_[k]->solve(here);
      z(sets_[k]) += correction;
    }
    const Eigen::VectorXd diagonal = body_matrix_.diagonal();
    Eigen::VectorXd body = r(body_);
    body_matrix_.triangularView<Eigen::Lower>().solveInPlace(body);
    body = (diagonal.array() * body.array()).matrix().eval();
    body_matrix_.triangularView<Eigen::Upper>().solveInPlace(body);
    z(body_) += body;
    return z;
  }

  int most_sets_in_a_triangle(const System& system) const {
    std::vector<Rows> sets_of(a_.rows());
    for (std::size_t k = 0; k < sets_.size(); ++k)
      for (const int row : sets_[k]) sets_of[row].push_back(static_cast<int>(k));
    for (const int row : body_) sets_of[row].push_back(-1);
    std::size_t most = 1;
    for (Eigen::Index t = 0; t < system.space.cell_dofs().rows(); ++t) {
      Rows met;
      for (const int unknown : system.space.cell_dofs().row(t)) {
        if (system.row[unknown] < 0) continue;
        const Rows& here = sets_of[system.row[unknown]];
        met.insert(met.end(), here.begin(), here.end());
      }
      std::sort(met.begin(), met.end());
      met.erase(std::unique(met.begin(), met.end()), met.end());
      most = std::max(most, met.size());
    }
    return static_cast<int>(most);
  }

  const SparseMatrix& a_;
  std::vector<Rows> sets_;
  std::vector<std::unique_ptr<Factor>> factors_;
  Rows body_;
  SparseMatrix body_matrix_;
  SparseMatrix p_;
  Factor coarse_;
  double damping_ = 1;
};

/// A drawing as figures/pictures/domain.cpp reads it: one row per corner, and the first
/// word of a name chooses the colour.
struct Drawing {
  Table table = Table({"kind", "name", "label", "x", "y"});
  void points(const std::string& kind, const std::string& name,
              const std::vector<Eigen::RowVector2d>& corners) {
    for (const auto& corner : corners) table.add({kind, name, "", corner(0), corner(1)});
  }
  void label(const std::string& name, const std::string& text,
             const Eigen::RowVector2d& at) {
    table.add({"label", name, text, at(0), at(1)});
  }
};

/// Per triangle: whether the set has all of its edges that are not clamped.
std::vector<char> triangles_of(const System& system, const Rows& set) {
  const TriangleMesh& mesh = system.space.mesh();
  std::vector<char> is_in(system.a.rows(), 0);
  for (const int row : set) is_in[row] = 1;
  std::vector<char> has(mesh.triangle_count(), 1);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (const int e : mesh.triangle_edges.row(t))
      if (system.row[e] >= 0 && is_in[system.row[e]] == 0) has[t] = 0;
  return has;
}

std::vector<Eigen::RowVector2d> corners_of(const TriangleMesh& mesh, int triangle) {
  std::vector<Eigen::RowVector2d> corners;
  for (const int v : mesh.triangles.row(triangle)) corners.push_back(mesh.vertices.row(v));
  return corners;
}

/// The triangles of the layer and of the body near it: in one colour those that the second
/// of three strips has alone, in another those that it shares with a neighbour, and in a
/// third those of the neighbours.
void draw_triangles(Drawing& drawing, const System& system,
                    const std::vector<Rows>& strips) {
  const TriangleMesh& mesh = system.space.mesh();
  std::vector<std::vector<char>> in_strip;
  for (const Rows& strip : strips) in_strip.push_back(triangles_of(system, strip));
  std::vector<char> is_drawn(mesh.edge_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const std::vector<Eigen::RowVector2d> corners = corners_of(mesh, t);
    if (std::min({corners[0](1), corners[1](1), corners[2](1)}) > 0.13) continue;
    const bool beside = in_strip[0][t] != 0 || in_strip[2][t] != 0;
    std::string colour = beside ? "tied0" : "body";
    if (in_strip[1][t] != 0) colour = beside ? "tied3" : "tied1";
    drawing.points("fill", colour + " " + std::to_string(t), corners);
    for (const int e : mesh.triangle_edges.row(t)) is_drawn[e] = 1;
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (is_drawn[e] == 0) continue;
    std::string colour = "axis";
    if (mesh.edge_tag[e] == EdgeTag::sigma) colour = "sigma";
    if (mesh.edge_tag[e] == EdgeTag::contact) colour = "contact";
    drawing.points(
        "line", colour + " " + std::to_string(e),
        {mesh.vertices.row(mesh.edges(e, 0)), mesh.vertices.row(mesh.edges(e, 1))});
  }
}

/// The triangles of one small patch, with an arrow to them.
void draw_patch(Drawing& drawing, const TriangleMesh& mesh) {
  const Eigen::RowVector2d place(0.13, -0.5);
  Eigen::Index vertex = 0;
  (mesh.vertices.rowwise() - place).rowwise().squaredNorm().minCoeff(&vertex);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if ((mesh.triangles.row(t).array() == static_cast<int>(vertex)).any())
      drawing.points("fill", "contact " + std::to_string(t), corners_of(mesh, t));
  drawing.points("arrow", "", {{-0.06, -0.5}, {0.1, -0.5}});
  drawing.label("", "patch", {-0.18, -0.5});
}

/// The smallest and the largest x of the unknowns of a set that lie in the layer.
std::pair<double, double> extent_in_layer(const System& system, const Rows& set) {
  std::vector<char> is_in(system.a.rows(), 0);
  for (const int row : set) is_in[row] = 1;
  double left = 1;
  double right = 0;
  for (int e = 0; e < system.space.size(); ++e) {
    const auto place = system.space.dof_coordinates().row(e);
    if (system.row[e] < 0 || is_in[system.row[e]] == 0 || place(1) > 0) continue;
    left = std::min(left, place(0));
    right = std::max(right, place(0));
  }
  return {left, right};
}

}  // namespace

int iterations_of(const TwoLevels& choice, const TriangleMesh& mesh, int cells,
                  double delta, int most) {
  const System system(mesh, delta);
  const Cycle cycle(system, choice, cells);
  Eigen::VectorXd r(system.a.rows());
  for (Eigen::Index i = 0; i < r.size(); ++i)
    r(i) = std::sin(static_cast<double>(i * i % 10007));
  Eigen::VectorXd z = cycle(r);
  Eigen::VectorXd direction = z;
  double product = r.dot(z);
  const double first = product;
  for (int k = 1; k <= most; ++k) {
    const Eigen::VectorXd image = system.a * direction;
    r -= product / direction.dot(image) * image;
    z = cycle(r);
    const double next = r.dot(z);
    if (next <= 1e-16 * first) return k;
    direction = z + next / product * direction;
    product = next;
  }
  return most;
}

std::string name_of(const TwoLevels& choice) {
  const std::string subdomains = choice.strips ? "strips" : "patches";
  return choice.hats ? subdomains + " and hats" : subdomains;
}

TriangleMesh mesh_without_columns(int cells) {
  int coarse = 16;
  TriangleMesh mesh = jittered_mesh(coarse, 0.2);
  for (; coarse < cells; coarse *= 2) mesh = refined(mesh);
  return mesh;
}

Table iterations_table(const std::vector<TwoLevels>& choices, const std::vector<int>& cells,
                       const std::vector<double>& deltas) {
  Table table({"pair", "cells", "delta", "iterations"});
  for (const int n : cells) {
    const TriangleMesh mesh = mesh_without_columns(n);
    for (const TwoLevels& choice : choices)
      for (const double delta : deltas)
        table.add({name_of(choice), n, delta, iterations_of(choice, mesh, n, delta)});
  }
  return table;
}

void write_four_pairs(const std::filesystem::path& path, const Table& runs, int most) {
  Table picture({"pair", "h", "delta", "iterations"});
  for (const Table& run : runs.rows()) {
    const double iterations = run.number("iterations");
    picture.add({run.entry("pair"), 1 / run.number("cells"), run.entry("delta"),
                 iterations < most ? iterations : std::nan("")});
  }
  picture.write(path);
}

void write_strip(const std::filesystem::path& path) {
  constexpr int cells = 48;
  const System system(unstructured_mesh(cells), 1);
  Drawing drawing;
  drawing.points("page", "", {{-0.32, -1.4}, {1.2, 0.22}});
  const std::vector<Rows> strips = strips_of_layer(system, cells, growth);
  draw_triangles(drawing, system, strips);
  draw_patch(drawing, system.space.mesh());
  for (int k = 0; k < 3; ++k) {
    const auto [left, right] = extent_in_layer(system, strips[k]);
    const double y = k == 1 ? -1.22 : -1.1;
    drawing.points("dimension", "axis strip " + std::to_string(k), {{left, y}, {right, y}});
  }
  drawing.label("axis", "one strip", {0.5, -1.31});
  for (const double x : {0.11, 0.89}) drawing.label("axis", "neighbour", {x, -1.19});
  drawing.label("sigma", "$Σ$", {1.08, 0});
  drawing.label("contact", "$Γ_C$", {1.1, -1});
  drawing.table.write(path);
}

void write_coarse_function(const std::filesystem::path& folder) {
  const System system(unstructured_mesh(16), 1);
  const SparseMatrix hats = coarse_functions(system, true);
  // the function of a vertex in the middle of Sigma is the one with the largest value on an
  // edge below it
  Eigen::Index edge = 0;
  Eigen::Index function = 0;
  (system.space.dof_coordinates().rowwise() - Eigen::RowVector2d(0.5, -0.5))
      .rowwise()
      .squaredNorm()
      .minCoeff(&edge);
  Eigen::VectorXd(SparseMatrix(hats.transpose()).col(system.row[edge])).maxCoeff(&function);
  for (const bool goes_on : {false, true}) {
    const SparseMatrix all = coarse_functions(system, goes_on);
    const Eigen::VectorXd values = all.col(function);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(system.space.size());
    for (int e = 0; e < system.space.size(); ++e)
      if (system.row[e] >= 0) u(e) = values(system.row[e]);
    write_vtu(folder / (goes_on ? "hat.vtu" : "no_hat.vtu"), system.space, u);
  }
}

}  // namespace antilock::tutorial
