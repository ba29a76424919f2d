#include "antilock/distributed/detail/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "antilock/core/error.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

/// What comes before each rank's own, and the sum of all.
std::vector<long long> starts(std::size_t owned) {
  const std::vector<long long> counts = each(static_cast<long long>(owned));
  std::vector<long long> start(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), start.begin() + 1);
  return start;
}

using IndexSet = Handle<IS, ISDestroy>;
IndexSet index_set(const std::vector<PetscInt>& indices) {
  IndexSet set;
  ok(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(indices.size()), indices.data(), PETSC_COPY_VALUES, &set));
  return set;
}

}  // namespace

Numbers numbers(const TriangleMesh& piece, bool at_vertices) {
  const int count = at_vertices ? piece.vertex_count() : piece.edge_count();
  Numbers all{std::vector<long long>(count), {}, std::vector<char>(count, 0)};
  for (int e = 0; e < piece.edge_count(); ++e) {
    const bool cut = piece.edge_tag[e] == EdgeTag::interior || piece.edge_tag[e] == EdgeTag::sigma;
    if (!cut || piece.edge_triangles(e, 1) >= 0) continue;
    if (at_vertices)
      all.shared[piece.edges(e, 0)] = all.shared[piece.edges(e, 1)] = 1;
    else
      all.shared[e] = 1;
  }
  // the ranks know each other's by their places, the same to the last bit
  const auto place = [&](int i) -> std::array<double, 2> {
    if (at_vertices) return {piece.vertices(i, 0), piece.vertices(i, 1)};
    const Eigen::RowVector2d middle =
        0.5 * (piece.vertices.row(piece.edges(i, 0)) + piece.vertices.row(piece.edges(i, 1)));
    return {middle(0), middle(1)};
  };
  std::vector<double> mine;
  for (int i = 0; i < count; ++i)
    if (all.shared[i] != 0) mine.insert(mine.end(), {place(i)[0], place(i)[1]});
  const std::vector<double> places = gathered(mine);
  const std::vector<long long> ends = starts(mine.size());
  // the first rank that has it, and how many of them it owns before
  std::map<std::array<double, 2>, std::pair<int, int>> owners;
  for (int r = 0; r < ranks(); ++r)
    for (long long k = ends[r], before = 0; k < ends[r + 1]; k += 2)
      before += owners.try_emplace({places[k], places[k + 1]}, r, before).second;
  for (int i = 0; i < count; ++i)
    if (all.shared[i] != 0 && owners.at(place(i)).first == rank()) all.own.push_back(i);
  for (int i = 0; i < count; ++i)
    if (all.shared[i] == 0) all.own.push_back(i);
  const std::vector<long long> start = starts(all.own.size());
  for (int i = 0; i < count; ++i) {
    if (all.shared[i] == 0) continue;
    const auto [owner, before] = owners.at(place(i));
    all.number[i] = start[owner] + before;
  }
  for (std::size_t k = 0; k < all.own.size(); ++k) all.number[all.own[k]] = start[rank()] + static_cast<long long>(k);
  all.total = start.back();
  return all;
}

Exchange::Exchange(const std::vector<PetscInt>& row, int owned)
    : unknowns_(static_cast<Eigen::Index>(row.size())), owned_(owned) {
  std::vector<PetscInt> from, to;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] < 0) continue;
    from.push_back(row[i]);
    to.push_back(static_cast<PetscInt>(i));
  }
  const Eigen::VectorXd here = Eigen::VectorXd::Zero(unknowns_);
  ok(VecScatterCreate(vector(), index_set(from), view(here), index_set(to), &scatter_));
}

Vector Exchange::vector() const {
  Vector v;
  ok(VecCreateMPI(PETSC_COMM_WORLD, owned_, PETSC_DETERMINE, &v));
  return v;
}

Vector Exchange::view(const Eigen::VectorXd& values) {
  Vector v;
  ok(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(values.size()), values.data(), &v));
  return v;
}

Eigen::VectorXd Exchange::local(Vec v) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(unknowns_);
  const Vector here = view(values);
  ok(VecScatterBegin(scatter_, v, here, INSERT_VALUES, SCATTER_FORWARD));
  ok(VecScatterEnd(scatter_, v, here, INSERT_VALUES, SCATTER_FORWARD));
  return values;
}

void Exchange::summed(const Eigen::VectorXd& local, Vec v) const {
  const Vector here = view(local);
  ok(VecSet(v, 0));
  ok(VecScatterBegin(scatter_, here, v, ADD_VALUES, SCATTER_REVERSE));
  ok(VecScatterEnd(scatter_, here, v, ADD_VALUES, SCATTER_REVERSE));
}

Rows::Rows(const Space& space) {
  Numbers all = numbers(space.mesh(), space.element().per_vertex() > 0);
  if (all.total > std::numeric_limits<PetscInt>::max() / 16)  // 16 entries per row fit into the indices of the matrices
    throw Error(fmt::format("mesh: {} unknowns; accepted by this build of PETSc (32-bit indices): {}", all.total,
                            std::numeric_limits<PetscInt>::max() / 16));
  everywhere_ = Exchange({all.number.begin(), all.number.end()}, static_cast<int>(all.own.size()));
  shared_ = std::move(all.shared);
  const Vector message = everywhere_.vector();
  // a piece may hold a boundary vertex without a boundary edge: another rank knows
  const auto on_any_rank = [&](const std::vector<int>& unknowns) {
    Eigen::VectorXd mark = Eigen::VectorXd::Zero(space.size());
    for (const int i : unknowns) mark(i) = 1;
    everywhere_.summed(mark, message);
    return everywhere_.local(message);
  };
  const Eigen::VectorXd clamped = on_any_rank(space.clamped()), contact = on_any_rank(space.contact());
  for (int i = 0; i < space.size(); ++i) on_contact_.push_back(contact(i) > 0 && clamped(i) == 0 ? 1 : 0);

  for (const int i : all.own)
    if (clamped(i) == 0) unknown_.push_back(i);
  const Points& at = space.points();
  const auto by_column = [&](int i, int j) { return std::tie(at(i, 0), at(i, 1)) < std::tie(at(j, 0), at(j, 1)); };
  std::sort(unknown_.begin(), unknown_.end(), by_column);
  const std::vector<long long> start = starts(unknown_.size());
  first_ = static_cast<PetscInt>(start[rank()]);
  total_ = start.back();

  // the owner of an unknown tells the others its row, as a double: exact up to 2^53
  Eigen::VectorXd row = Eigen::VectorXd::Constant(space.size(), -1);
  for (std::size_t place = 0; place < unknown_.size(); ++place)
    row(unknown_[place]) = first_ + static_cast<double>(place);
  Entries{message} = row(all.own);
  row = everywhere_.local(message);
  for (const double r : row) row_.push_back(static_cast<PetscInt>(r));
  static_cast<Exchange&>(*this) = Exchange(row_, static_cast<int>(unknown_.size()));
}

double Rows::largest_at_clamped(const Eigen::VectorXd& local) const {
  const Vector sums = everywhere_.vector();
  everywhere_.summed(local, sums);
  const Eigen::VectorXd sum = everywhere_.local(sums);
  double most = 0;
  for (std::size_t i = 0; i < row_.size(); ++i)
    if (row_[i] < 0) most = std::max(most, std::abs(sum(static_cast<Eigen::Index>(i))));
  return largest(most);
}

}  // namespace antilock::distributed
