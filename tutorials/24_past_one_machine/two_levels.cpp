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
    sets_ = choice.strips ? strips_of_layer(system, cells, growth) : patches_of_layer(system);
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

void write_parts(const std::filesystem::path& folder) {
  constexpr int cells = 32;
  const System system(mesh_without_columns(cells), 1);
  const TriangleMesh& mesh = system.space.mesh();
  std::vector<double> in_patch(system.a.rows(), 0);
  std::vector<double> in_strip(system.a.rows(), 0);
  const std::vector<Rows> patches = patches_of_layer(system);
  for (const int row : patches[patches.size() / 2]) in_patch[row] = 1;
  const Rows strip = strips_of_layer(system, cells, 0).front();
  for (const int row : grown(system.a, strip, growth)) in_strip[row] = 0.5;
  for (const int row : strip) in_strip[row] = 1;

  // a triangle has the smallest value of its edges, so that the drawing has no half triangles
  const auto write = [&](const char* name, const std::vector<double>& value) {
    Eigen::MatrixX3d corners(mesh.triangle_count(), 3);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      double least = 1;
      for (const int e : mesh.triangle_edges.row(t))
        least = std::min(least, system.row[e] < 0 ? 0 : value[system.row[e]]);
      corners.row(t).setConstant(least);
    }
    write_vtu(folder / name, mesh, corners);
  };
  write("patch.vtu", in_patch);
  write("strip.vtu", in_strip);

  const SparseMatrix hats = coarse_functions(system, true);
  // the hat function nearest to the middle of Sigma is the one with the largest value there
  Eigen::Index middle = 0;
  (system.space.dof_coordinates().rowwise() - Eigen::RowVector2d(0.5, -0.5))
      .rowwise()
      .squaredNorm()
      .minCoeff(&middle);
  Eigen::Index largest = 0;
  Eigen::VectorXd(SparseMatrix(hats.transpose()).col(system.row[middle])).maxCoeff(&largest);
  const Eigen::VectorXd hat = hats.col(largest);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(system.space.size());
  for (int e = 0; e < system.space.size(); ++e)
    if (system.row[e] >= 0) u(e) = hat(system.row[e]);
  write_vtu(folder / "hat.vtu", system.space, u);
}

}  // namespace antilock::tutorial
