#include "antilock/distributed/detail/layer_strips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/distributed/detail/coarse_space.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// An unknown of the layer.
struct LayerUnknown {
  double x = 0;
  PetscInt row = 0;
};

/// An interval of x, closed on the left.
struct Interval {
  double from = infinity;
  double to = -infinity;
  bool contains(double x) const { return x >= from && x < to; }
};

/// Per unknown of the subdomain: whether a triangle of the region has it, on any rank.
std::vector<char> unknowns_of(const Space& space, const DofMap& rows, Region region) {
  Eigen::VectorXd mark = Eigen::VectorXd::Zero(space.size());
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    if (space.mesh().region[t] == region)
      for (const int unknown : space.cell_dofs().row(t)) mark(unknown) = 1;
  return marked_by_any(rows, mark);
}

/// The unknowns of the layer that this rank owns.
std::vector<LayerUnknown> owned_layer_unknowns(const Space& space, const DofMap& rows) {
  const std::vector<char> in_layer = unknowns_of(space, rows, Region::layer);
  std::vector<LayerUnknown> unknowns;
  for (int place = 0; place < rows.owned(); ++place) {
    const int unknown = rows.unknown(place);
    if (in_layer[unknown] != 0)
      unknowns.push_back({space.dof_coordinates()(unknown, 0), rows.first() + place});
  }
  return unknowns;
}

/// The range of x of this rank. The ranges of all ranks that own a part of the layer follow each
/// other without gaps. Between two of them is the middle of the border.
Interval range_of_rank(const std::vector<LayerUnknown>& own) {
  double low = infinity;
  double high = -infinity;
  for (const LayerUnknown& unknown : own) {
    low = std::min(low, unknown.x);
    high = std::max(high, unknown.x);
  }
  const std::vector<double> all = all_gather({low, high});
  std::vector<int> order;  // of the ranks with a part of the layer, by the middle of this part
  for (int r = 0; r < ranks(); ++r)
    if (all[2 * r] <= all[2 * r + 1]) order.push_back(r);
  std::stable_sort(order.begin(), order.end(), [&](int r, int s) {
    return all[2 * r] + all[2 * r + 1] < all[2 * s] + all[2 * s + 1];
  });
  double from = -infinity;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool is_last = k + 1 == order.size();
    const double end = all[2 * order[k] + 1];
    const double next = is_last ? infinity : all[2 * order[k + 1]];
    const double to = std::max(from, 0.5 * (end + next));
    if (order[k] == rank()) return {from, to};
    from = to;
  }
  return {};
}

/// All unknowns of the layer in the range of this rank. Every rank learns of those that are not in
/// the range of their owner: the teeth of the borders.
std::vector<LayerUnknown> unknowns_in_range(const std::vector<LayerUnknown>& own,
                                            const Interval& range) {
  std::vector<LayerUnknown> inside;
  std::vector<double> outside;  // x, row
  for (const LayerUnknown& unknown : own) {
    if (range.contains(unknown.x))
      inside.push_back(unknown);
    else
      outside.insert(outside.end(), {unknown.x, static_cast<double>(unknown.row)});
  }
  const std::vector<double> all = all_gather(outside);
  for (std::size_t i = 0; i < all.size(); i += 2)
    if (range.contains(all[i])) inside.push_back({all[i], static_cast<PetscInt>(all[i + 1])});
  return inside;
}

/// The length of the layer from the left end of a range, in units of the longest edge that lies
/// above, below or at x. Where this rank has no edge of the layer, length counts nothing.
class LengthInUnits {
 public:
  LengthInUnits(const TriangleMesh& mesh, double low, double high) : low_(low) {
    int sigma_edges = 0;
    for (const EdgeTag tag : mesh.edge_tag) sigma_edges += tag == EdgeTag::sigma ? 1 : 0;
    const int cells = 4 * std::max(1, sigma_edges);  // a cell is shorter than most edges
    cell_ = std::max(high - low, std::numeric_limits<double>::min()) / cells;
    std::vector<double> longest(cells, 0);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.region[t] != Region::layer) continue;
      for (const int e : mesh.triangle_edges.row(t)) add_edge(mesh, e, longest);
    }
    length_.push_back(0);
    for (const double extent : longest)
      length_.push_back(length_.back() + (extent > 0 ? cell_ / extent : 0));
  }

  double at(double x) const {
    const double cells = static_cast<double>(length_.size() - 1);
    const double place = std::clamp((x - low_) / cell_, 0.0, cells);
    const auto cell = static_cast<std::size_t>(std::min(place, cells - 1));
    const double share = place - static_cast<double>(cell);
    return length_[cell] + share * (length_[cell + 1] - length_[cell]);
  }
  double total() const { return length_.back(); }

 private:
  void add_edge(const TriangleMesh& mesh, int e, std::vector<double>& longest) const {
    const double a = mesh.vertices(mesh.edges(e, 0), 0);
    const double b = mesh.vertices(mesh.edges(e, 1), 0);
    const double last = static_cast<double>(longest.size()) - 1;
    const double from = std::floor((std::min(a, b) - low_) / cell_);
    const double to = std::floor((std::max(a, b) - low_) / cell_);
    if (to < 0 || from > last) return;
    const auto begin = static_cast<std::size_t>(std::max(from, 0.0));
    const auto end = static_cast<std::size_t>(std::min(to, last));
    for (std::size_t k = begin; k <= end; ++k) longest[k] = std::max(longest[k], std::abs(b - a));
  }

  double low_ = 0;
  double cell_ = 1;
  std::vector<double> length_;  ///< at the ends of the cells
};

/// The unknowns of each strip, before it is grown.
using StripRows = std::vector<std::vector<PetscInt>>;

StripRows cut_into(int count, const std::vector<LayerUnknown>& unknowns,
                   const LengthInUnits& length) {
  StripRows strips(count);
  for (const LayerUnknown& unknown : unknowns) {
    const double share = length.total() > 0 ? length.at(unknown.x) / length.total() : 0;
    strips[std::min(static_cast<int>(share * count), count - 1)].push_back(unknown.row);
  }
  return strips;
}

/// Strips of about `width` units. Where the cells of the layer shrink towards a point of Gamma_C it
/// has few units, and narrower strips are the smaller evil (measured: 14 iterations with 2 units
/// per strip).
StripRows cut_into_strips(const std::vector<LayerUnknown>& unknowns, const LengthInUnits& length,
                          long long most_unknowns) {
  constexpr double least_width = 2;
  const auto large = static_cast<std::size_t>(most_unknowns / 4);  // the strip grows later
  int count = std::max(1, static_cast<int>(std::lround(length.total() / LayerStrips::width)));
  for (;; count *= 2) {
    StripRows strips = cut_into(count, unknowns, length);
    std::size_t most = 0;
    for (const std::vector<PetscInt>& strip : strips) most = std::max(most, strip.size());
    if (most <= large || length.total() / (2 * count) < least_width) return strips;
  }
}

/// Grows the strips by the graph of the matrix. Every rank must give one strip or more, because
/// MatIncreaseOverlap returns at once where there is none, and the other ranks would wait for it.
std::vector<IndexSet> grown(Mat matrix, const StripRows& strips) {
  std::vector<IS> raw;
  for (const std::vector<PetscInt>& strip : strips) {
    raw.push_back(nullptr);
    ok(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(strip.size()), strip.data(),
                       PETSC_COPY_VALUES, &raw.back()));
    ok(ISSort(raw.back()));
  }
  ok(MatIncreaseOverlap(matrix, static_cast<PetscInt>(raw.size()), raw.data(),
                        LayerStrips::growth));
  std::vector<IndexSet> sets;
  for (IS set : raw) {
    IndexSet owner(set);
    PetscInt size = 0;
    ok(ISGetLocalSize(owner, &size));
    if (size == 0) continue;
    ok(ISSort(owner));
    sets.push_back(std::move(owner));
  }
  return sets;
}

IndexSet owned_body_unknowns(const Space& space, const DofMap& rows) {
  const std::vector<char> in_body = unknowns_of(space, rows, Region::body);
  std::vector<PetscInt> body;
  for (int place = 0; place < rows.owned(); ++place)
    if (in_body[rows.unknown(place)] != 0) body.push_back(rows.first() + place);
  IndexSet set;
  ok(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(body.size()), body.data(),
                     PETSC_COPY_VALUES, &set));
  return set;
}

void require_small_strips(const std::vector<IndexSet>& sets, double units,
                          long long most_unknowns) {
  PetscInt most = 0;
  for (std::size_t k = 0; k + 1 < sets.size(); ++k) {
    PetscInt size = 0;
    ok(ISGetLocalSize(sets[k], &size));
    most = std::max(most, size);
  }
  const double of_all = largest(static_cast<double>(most));
  const long long strips = sum(static_cast<long long>(sets.size()) - 1);
  if (of_all <= static_cast<double>(most_unknowns)) return;
  const char* one = "the layer is one strip wide, because an edge is nearly as long as it";
  const char* several = "its cells are small";
  throw NotConverged(
      fmt::format("petsc: a strip of the layer has {:.0f} unknowns ({} strips on {:.1f} longest "
                  "edges: {}), and {} is the limit of what is factored; accepted: fewer cells, a "
                  "layer whose cells do not shrink to a point, or --direct (MUMPS)",
                  of_all, strips, units, strips == 1 ? one : several, most_unknowns),
      1, 0);
}

/// The first of the numbers of this rank, where each rank numbers `count` things.
PetscInt first_number(long long count) {
  const std::vector<long long> counts = all_gather(count);
  long long first = 0;
  for (int r = 0; r < rank(); ++r) first += counts[r];
  return static_cast<PetscInt>(first);
}

/// The incidence of unknowns and sets, and that of triangles and unknowns. The entries of a row of
/// their product are the sets that have an unknown of the triangle.
int most_sets_of_a_triangle(const Space& space, const DofMap& rows,
                            const std::vector<IndexSet>& sets) {
  const auto count = static_cast<PetscInt>(sets.size());
  const auto triangles = static_cast<PetscInt>(space.mesh().triangle_count());
  Matrix is_in;
  ok(MatCreateAIJ(PETSC_COMM_WORLD, rows.owned(), count, PETSC_DETERMINE, PETSC_DETERMINE, 4,
                  nullptr, 4, nullptr, &is_in));
  ok(MatSetOption(is_in, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscInt number = first_number(count);
  for (const IndexSet& set : sets) {
    PetscInt size = 0;
    const PetscInt* members = nullptr;
    ok(ISGetLocalSize(set, &size));
    ok(ISGetIndices(set, &members));
    const std::vector<PetscScalar> ones(size, 1);
    ok(MatSetValues(is_in, size, members, 1, &number, ones.data(), INSERT_VALUES));
    ok(ISRestoreIndices(set, &members));
    ++number;
  }
  ok(MatAssemblyBegin(is_in, MAT_FINAL_ASSEMBLY));
  ok(MatAssemblyEnd(is_in, MAT_FINAL_ASSEMBLY));

  Matrix has;
  ok(MatCreateAIJ(PETSC_COMM_WORLD, triangles, rows.owned(), PETSC_DETERMINE, PETSC_DETERMINE, 3,
                  nullptr, 3, nullptr, &has));
  const PetscInt first = first_number(triangles);
  const std::vector<PetscScalar> ones(space.cell_dofs().cols(), 1);
  for (PetscInt t = 0; t < triangles; ++t) {
    const PetscInt row = first + t;
    std::vector<PetscInt> unknowns;
    for (const int unknown : space.cell_dofs().row(t))
      if (!rows.clamped(unknown)) unknowns.push_back(rows.row()[unknown]);
    ok(MatSetValues(has, 1, &row, static_cast<PetscInt>(unknowns.size()), unknowns.data(),
                    ones.data(), INSERT_VALUES));
  }
  ok(MatAssemblyBegin(has, MAT_FINAL_ASSEMBLY));
  ok(MatAssemblyEnd(has, MAT_FINAL_ASSEMBLY));

  Matrix meets;
  ok(MatMatMult(has, is_in, MAT_INITIAL_MATRIX, 2, &meets));
  PetscInt most = 1;
  for (PetscInt t = 0; t < triangles; ++t) {
    PetscInt entries = 0;
    ok(MatGetRow(meets, first + t, &entries, nullptr, nullptr));
    most = std::max(most, entries);
    ok(MatRestoreRow(meets, first + t, &entries, nullptr, nullptr));
  }
  return static_cast<int>(largest(static_cast<double>(most)));
}

}  // namespace

LayerStrips::LayerStrips(const DistributedProblem& problem, long long most_unknowns) {
  const Space& space = problem.space();
  const DofMap& rows = problem.rows();
  const std::vector<LayerUnknown> own = owned_layer_unknowns(space, rows);
  const std::vector<LayerUnknown> here = unknowns_in_range(own, range_of_rank(own));
  double low = 0;
  double high = 0;
  if (!here.empty()) {
    const auto by_x = [](const LayerUnknown& a, const LayerUnknown& b) { return a.x < b.x; };
    const auto [left, right] = std::minmax_element(here.begin(), here.end(), by_x);
    low = left->x;
    high = right->x;
  }
  const LengthInUnits length(space.mesh(), low, high);
  units_ = sum(length.total());
  sets_ = grown(problem.k(), cut_into_strips(here, length, most_unknowns));
  sets_.push_back(owned_body_unknowns(space, rows));
  require_small_strips(sets_, units_, most_unknowns);
  most_sets_per_triangle_ = most_sets_of_a_triangle(space, rows, sets_);
}

}  // namespace antilock::distributed
