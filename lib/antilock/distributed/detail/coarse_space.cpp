#include "antilock/distributed/detail/coarse_space.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

/// The entries of a row of the interpolation, by column.
using RowEntries = std::map<PetscInt, double>;

/// An edge of Sigma. A number is that of the first coarse function of a vertex, -1 where it is
/// clamped. The functions of a vertex are numbered one after the other, downwards.
struct SigmaEdge {
  double left = 0, right = 0;
  PetscInt left_number = -1, right_number = -1;
};

/// The vertices of the subdomain and the first coarse function of each.
struct CoarseNumbers {
  std::vector<char> on_body;  ///< per vertex, according to any rank
  Eigen::VectorXd first;      ///< per vertex: the number, -1 where there is none
  PetscInt owned = 0;         ///< coarse functions of this rank
};

/// Each rank numbers the functions of its own vertices, and the others learn the numbers.
CoarseNumbers number_coarse_functions(const TriangleMesh& mesh, const DofMap& vertices, int rows) {
  Eigen::VectorXd body_mark = Eigen::VectorXd::Zero(mesh.vertex_count());
  Eigen::VectorXd sigma_mark = Eigen::VectorXd::Zero(mesh.vertex_count());
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::body)
      for (const int v : mesh.triangles.row(t)) body_mark(v) = 1;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::sigma)
      for (const int v : mesh.edges.row(e)) sigma_mark(v) = 1;
  CoarseNumbers numbers;
  numbers.on_body = marked_by_any(vertices, body_mark);
  const std::vector<char> on_sigma = marked_by_any(vertices, sigma_mark);

  std::vector<double> first(vertices.owned(), -1);
  for (int place = 0; place < vertices.owned(); ++place) {
    const int v = vertices.unknown(place);
    if (numbers.on_body[v] == 0 || vertices.clamped(v)) continue;
    first[place] = static_cast<double>(numbers.owned);
    numbers.owned += on_sigma[v] != 0 ? rows + 1 : 1;
  }
  double start = 0;  // the functions of the ranks before this one
  const std::vector<long long> counts = all_gather(static_cast<long long>(numbers.owned));
  for (int r = 0; r < rank(); ++r) start += static_cast<double>(counts[r]);
  const Vector of_all = vertices.vector();
  {
    Entries number(of_all);
    for (int place = 0; place < vertices.owned(); ++place)
      number[place] = first[place] < 0 ? -1 : start + first[place];
  }
  numbers.first = vertices.local(of_all);
  return numbers;
}

/// The edges of Sigma of all ranks, by x. Two ranks have the edges between them.
std::vector<SigmaEdge> gathered_sigma(const TriangleMesh& mesh, const CoarseNumbers& numbers) {
  std::vector<double> mine;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::sigma) continue;
    int a = mesh.edges(e, 0);
    int b = mesh.edges(e, 1);
    if (mesh.vertices(a, 0) > mesh.vertices(b, 0)) std::swap(a, b);
    mine.insert(mine.end(),
                {mesh.vertices(a, 0), mesh.vertices(b, 0), numbers.first(a), numbers.first(b)});
  }
  const std::vector<double> all = all_gather(mine);
  std::map<double, SigmaEdge> by_left;  // the same vertex has the same x, to the last bit
  for (std::size_t i = 0; i < all.size(); i += 4)
    by_left[all[i]] = {all[i], all[i + 1], static_cast<PetscInt>(all[i + 2]),
                       static_cast<PetscInt>(all[i + 3])};
  std::vector<SigmaEdge> edges;
  edges.reserve(by_left.size());
  for (const auto& [left, edge] : by_left) edges.push_back(edge);
  return edges;
}

/// The coarse functions in the layer, whose upper side Sigma is the line y = 0.
class LayerFunctions {
 public:
  LayerFunctions(std::vector<SigmaEdge> sigma, double depth, int rows)
      : sigma_(std::move(sigma)), depth_(depth), rows_(rows) {
    if (!sigma_.empty()) slack_ = 1e-9 * (sigma_.back().right - sigma_.front().left);
  }

  /// Adds the values at a point.
  void add_value(RowEntries& entries, const Eigen::Vector2d& point) const {
    add(entries, cell_at(point), point, 1);
  }

  /// Adds the means over the segment from a to b. Between the lines on which a coarse function has
  /// a kink it is a polynomial of degree 2 or less, for which Simpson's rule is exact.
  void add_mean(RowEntries& entries, const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    const std::vector<double> cuts = kinks_between(a, b);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
      const double length = cuts[i + 1] - cuts[i];
      const auto point = [&](double t) -> Eigen::Vector2d { return a + t * (b - a); };
      const Cell cell = cell_at(point(middle));
      add(entries, cell, point(cuts[i]), length / 6);
      add(entries, cell, point(middle), 4 * length / 6);
      add(entries, cell, point(cuts[i + 1]), length / 6);
    }
  }

 private:
  /// A rectangle of the layer on which every coarse function is bilinear.
  struct Cell {
    const SigmaEdge* above = nullptr;
    int row = 0;  ///< from the top
  };

  /// The distance of y below Sigma, in rows.
  double row_coordinate(double y) const { return -y / depth_ * rows_; }

  Cell cell_at(const Eigen::Vector2d& point) const {
    const auto after =
        std::upper_bound(sigma_.begin(), sigma_.end(), point(0),
                         [](double x, const SigmaEdge& edge) { return x < edge.left; });
    const auto found = after == sigma_.begin() ? after : after - 1;
    if (found == sigma_.end() || point(0) < found->left - slack_ ||
        point(0) > found->right + slack_)
      throw NotConverged(
          fmt::format("petsc: the layer at ({:.6g}, {:.6g}) has no Sigma above it, and the coarse "
                      "functions of this preconditioner are hat functions of Sigma's vertices; "
                      "accepted: a layer below Sigma alone, or --direct (MUMPS)",
                      point(0), point(1)),
          1, 0);
    Cell cell;
    cell.above = &*found;
    if (rows_ > 0)
      cell.row = std::clamp(static_cast<int>(std::floor(row_coordinate(point(1)))), 0, rows_ - 1);
    return cell;
  }

  /// Adds `weight` times the values at a point of the cell.
  void add(RowEntries& entries, const Cell& cell, const Eigen::Vector2d& point,
           double weight) const {
    constexpr double round_off = 1e-13;  // of a hat function at its foot
    const auto add_one = [&](PetscInt column, double value) {
      if (std::abs(value) > round_off) entries[column] += value;
    };
    const SigmaEdge& edge = *cell.above;
    const double right = (point(0) - edge.left) / (edge.right - edge.left);
    const std::array<PetscInt, 2> numbers{edge.left_number, edge.right_number};
    const std::array<double, 2> hats{1 - right, right};
    for (std::size_t side = 0; side < 2; ++side) {
      if (numbers[side] < 0) continue;
      if (rows_ == 0) {
        add_one(numbers[side], weight * hats[side]);
        continue;
      }
      const double below = row_coordinate(point(1)) - cell.row;
      const PetscInt upper = numbers[side] + cell.row;
      add_one(upper, weight * hats[side] * (1 - below));
      add_one(upper + 1, weight * hats[side] * below);
    }
  }

  /// 0, 1 and the parameters t at which a + t (b - a) crosses the line x = x_i of a vertex of Sigma
  /// or the line between two rows, ascending.
  std::vector<double> kinks_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    std::vector<double> cuts{0, 1};
    const auto cut_at = [&](double t) {
      if (t > 0 && t < 1) cuts.push_back(t);
    };
    const double low = std::min(a(0), b(0));
    const double high = std::max(a(0), b(0));
    auto edge = std::lower_bound(sigma_.begin(), sigma_.end(), low,
                                 [](const SigmaEdge& e, double x) { return e.right < x; });
    for (; high - low > slack_ && edge != sigma_.end() && edge->left < high; ++edge) {
      cut_at((edge->left - a(0)) / (b(0) - a(0)));
      cut_at((edge->right - a(0)) / (b(0) - a(0)));
    }
    const double from = row_coordinate(a(1));
    const double to = row_coordinate(b(1));
    for (int row = 1; std::abs(to - from) > 1e-9 && row < rows_; ++row)
      cut_at((row - from) / (to - from));
    std::sort(cuts.begin(), cuts.end());
    // shorter than this is a line that passes through an end
    const auto is_same = [](double s, double t) { return t - s < 1e-9; };
    cuts.erase(std::unique(cuts.begin(), cuts.end(), is_same), cuts.end());
    cuts.back() = 1;
    return cuts;
  }

  std::vector<SigmaEdge> sigma_;
  double depth_ = 1;
  int rows_ = 0;
  double slack_ = 0;
};

/// The entries of the rows that this rank owns, in compressed rows.
struct CompressedRows {
  std::vector<PetscInt> start{0};
  std::vector<PetscInt> column;
  std::vector<PetscScalar> value;

  void append(const RowEntries& entries) {
    for (const auto& [number, entry] : entries) {
      column.push_back(number);
      value.push_back(entry);
    }
    start.push_back(static_cast<PetscInt>(column.size()));
  }
};

/// The unknown of an edge (Crouzeix-Raviart). On the body a coarse function is linear along it.
RowEntries entries_of_edge(const TriangleMesh& mesh, const CoarseNumbers& numbers,
                           const LayerFunctions& layer, int e) {
  RowEntries entries;
  bool on_body = mesh.edge_tag[e] == EdgeTag::sigma;
  for (const int t : mesh.edge_triangles.row(e))
    if (t >= 0 && mesh.region[t] == Region::body) on_body = true;
  const int a = mesh.edges(e, 0);
  const int b = mesh.edges(e, 1);
  if (!on_body) {
    layer.add_mean(entries, mesh.vertices.row(a).transpose(), mesh.vertices.row(b).transpose());
    return entries;
  }
  for (const int v : {a, b})
    if (numbers.first(v) >= 0) entries[static_cast<PetscInt>(numbers.first(v))] += 0.5;
  return entries;
}

/// The unknown of a vertex (P1).
RowEntries entries_of_vertex(const TriangleMesh& mesh, const CoarseNumbers& numbers,
                             const LayerFunctions& layer, int v) {
  RowEntries entries;
  if (numbers.on_body[v] == 0)
    layer.add_value(entries, mesh.vertices.row(v).transpose());
  else if (numbers.first(v) >= 0)
    entries[static_cast<PetscInt>(numbers.first(v))] = 1;
  return entries;
}

/// The depth of the layer of all ranks, below Sigma on y = 0.
double depth_of_layer(const TriangleMesh& mesh) {
  double depth = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer)
      for (const int v : mesh.triangles.row(t)) depth = std::max(depth, -mesh.vertices(v, 1));
  return largest(depth);
}

}  // namespace

std::vector<char> marked_by_any(const DofMap& rows, const Eigen::VectorXd& mark) {
  const Vector sum_of_marks = rows.vector();
  rows.summed(mark, sum_of_marks);
  std::vector<char> marked;
  for (const double value : rows.local(sum_of_marks)) marked.push_back(value > 0 ? 1 : 0);
  return marked;
}

CoarseSpace::CoarseSpace(const Space& space, const DofMap& dofs, int rows) {
  const TriangleMesh& mesh = space.mesh();
  if (sum(static_cast<long long>(mesh.curved() ? 1 : 0)) > 0)
    throw NotConverged(
        "petsc: the layer follows the normals of a curved Sigma, and this preconditioner needs a "
        "layer below y = 0; accepted: a straight Sigma, multigrid in columns, or --direct (MUMPS)",
        1, 0);
  const DofMap vertices(Space(space, p1()));
  const CoarseNumbers numbers = number_coarse_functions(mesh, vertices, rows);
  const LayerFunctions layer(gathered_sigma(mesh, numbers), depth_of_layer(mesh), rows);
  const bool on_vertices = space.element().dofs_per_vertex() > 0;
  CompressedRows entries;
  collectively([&] {
    for (int place = 0; place < dofs.owned(); ++place) {
      const int unknown = dofs.unknown(place);
      if (dofs.clamped(unknown))
        entries.append({});
      else if (on_vertices)
        entries.append(entries_of_vertex(mesh, numbers, layer, unknown));
      else
        entries.append(entries_of_edge(mesh, numbers, layer, unknown));
    }
  });
  size_ = sum(static_cast<long long>(numbers.owned));
  ok(MatCreate(PETSC_COMM_WORLD, &interpolation_));
  ok(MatSetSizes(interpolation_, dofs.owned(), numbers.owned, PETSC_DETERMINE, PETSC_DETERMINE));
  ok(MatSetType(interpolation_, MATAIJ));
  // one of the two fits the type, the other one does nothing
  ok(MatSeqAIJSetPreallocationCSR(interpolation_, entries.start.data(), entries.column.data(),
                                  entries.value.data()));
  ok(MatMPIAIJSetPreallocationCSR(interpolation_, entries.start.data(), entries.column.data(),
                                  entries.value.data()));
}

}  // namespace antilock::distributed
