#include "antilock/distributed/detail/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "antilock/core/error.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

/// Where an unknown that several ranks hold stands among the rows of its owner.
struct Shared {
  int unknown, owner, position;
};

/// P1: the corners, then the vertices inside each seam. CR: the edges of each seam. Counted are all of them, or those
/// alone that have a row (then a clamped corner has position -1).
std::vector<Shared> shared_unknowns(const MeshPart& piece, bool at_vertices, bool with_clamped) {
  const std::vector<int>& corners = with_clamped ? piece.corner_count : piece.corner_rows;
  std::vector<Shared> shared;
  if (at_vertices)
    for (const SharedCorner& corner : piece.corners)
      shared.push_back({corner.vertex, corner.owner, with_clamped ? corner.index : corner.row});
  for (const Seam& seam : piece.seams) {
    const int pieces = static_cast<int>(seam.edges.size()), inner = at_vertices ? pieces - 1 : pieces;
    const int start = (at_vertices ? corners[seam.owner] : 0) + seam.index * inner;
    for (int s = 0; s < inner; ++s)
      shared.push_back({at_vertices ? seam.vertices[s + 1] : seam.edges[s], seam.owner, start + s});
  }
  return shared;
}

/// What comes before each rank's own, and the sum of all.
std::vector<long long> starts(long long owned) {
  const std::vector<long long> counts = each(owned);
  std::vector<long long> start(counts.size() + 1, 0);
  std::partial_sum(counts.begin(), counts.end(), start.begin() + 1);
  return start;
}

}  // namespace

Rows::Rows(const MeshPart& piece, const Space& space) {
  const bool at_vertices = space.element().per_vertex() > 0;
  place_.assign(space.size(), 0);
  on_contact_.assign(space.size(), 0);
  for (const int i : space.contact()) on_contact_[i] = 1;
  for (const int i : space.clamped()) place_[i] = -1;
  if (at_vertices) {  // a piece may hold a boundary vertex without a boundary edge
    for (const int i : piece.contact) on_contact_[i] = 1;
    for (const int i : piece.clamped) place_[i] = -1;
  }
  for (int i = 0; i < space.size(); ++i)
    if (place_[i] < 0) on_contact_[i] = 0;

  if (at_vertices) {
    for (const SharedCorner& corner : piece.corners)
      if (corner.row < 0)
        clamped_corners_.emplace_back(
            corner.vertex,
            corner.index + std::accumulate(piece.corner_count.begin(), piece.corner_count.begin() + corner.owner, 0));
    corners_ = std::accumulate(piece.corner_count.begin(), piece.corner_count.end(), 0);
  }

  std::vector<Shared> shared = shared_unknowns(piece, at_vertices, false);
  std::erase_if(shared, [&](const Shared& s) { return place_[s.unknown] < 0; });
  std::vector<char> taken(space.size(), 0);
  for (const Shared& s : shared) {
    taken[s.unknown] = 1;
    if (s.owner == rank()) shared_ = std::max(shared_, s.position + 1);
  }
  unknown_.resize(shared_);
  for (const Shared& s : shared)
    if (s.owner == rank()) unknown_[s.position] = s.unknown;
  for (int i = 0; i < space.size(); ++i)
    if (place_[i] >= 0 && taken[i] == 0) unknown_.push_back(i);
  const Points& at = space.points();
  const auto by_column = [&](int i, int j) { return std::tie(at(i, 0), at(i, 1)) < std::tie(at(j, 0), at(j, 1)); };
  std::sort(unknown_.begin() + shared_, unknown_.end(), by_column);
  owned_ = static_cast<int>(unknown_.size());

  const std::vector<long long> start = starts(owned_);
  total_ = start.back();
  if (total_ > std::numeric_limits<PetscInt>::max() / 16)  // 16 entries per row fit into the indices of the matrices
    throw Error(fmt::format("mesh: {} unknowns; accepted by this build of PETSc (32-bit indices): {}", total_,
                            std::numeric_limits<PetscInt>::max() / 16));
  first_ = static_cast<PetscInt>(start[rank()]);
  for (const Shared& s : shared) {
    if (s.owner == rank()) continue;
    unknown_.push_back(s.unknown);
    ghosts_.push_back(static_cast<PetscInt>(start[s.owner] + s.position));
  }
  for (int p = 0; p < held(); ++p) place_[unknown_[p]] = p;
}

Vector Rows::vector() const {
  Vector v;
  ok(VecCreateGhost(PETSC_COMM_WORLD, owned_, static_cast<PetscInt>(total_), static_cast<PetscInt>(ghosts_.size()),
                    ghosts_.data(), &v));
  ok(VecSet(v, 0));
  return v;
}

Eigen::VectorXd Rows::local(Vec v) const {
  ok(VecGhostUpdateBegin(v, INSERT_VALUES, SCATTER_FORWARD));
  ok(VecGhostUpdateEnd(v, INSERT_VALUES, SCATTER_FORWARD));
  Eigen::VectorXd values = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(place_.size()));
  Vec form = nullptr;
  const PetscScalar* held = nullptr;
  ok(VecGhostGetLocalForm(v, &form)), ok(VecGetArrayRead(form, &held));
  for (std::size_t p = 0; p < unknown_.size(); ++p) values(unknown_[p]) = held[p];
  ok(VecRestoreArrayRead(form, &held)), ok(VecGhostRestoreLocalForm(v, &form));
  return values;
}

void Rows::summed(const Eigen::VectorXd& local, Vec v) const {
  Vec form = nullptr;
  PetscScalar* held = nullptr;
  ok(VecGhostGetLocalForm(v, &form)), ok(VecGetArray(form, &held));
  for (std::size_t p = 0; p < unknown_.size(); ++p) held[p] = local(unknown_[p]);
  ok(VecRestoreArray(form, &held)), ok(VecGhostRestoreLocalForm(v, &form));
  ok(VecGhostUpdateBegin(v, ADD_VALUES, SCATTER_REVERSE));
  ok(VecGhostUpdateEnd(v, ADD_VALUES, SCATTER_REVERSE));
}

void Rows::owned_part(const Eigen::VectorXd& local, Vec v) const {
  PetscScalar* values = nullptr;
  ok(VecGetArray(v, &values));
  for (int p = 0; p < owned_; ++p) values[p] = local(unknown_[p]);
  ok(VecRestoreArray(v, &values));
}

double Rows::largest_at_clamped(Eigen::VectorXd local) const {
  std::vector<double> at_corner(corners_, 0);
  for (const auto& [unknown, number] : clamped_corners_) at_corner[number] = local(unknown);
  MPI_Allreduce(MPI_IN_PLACE, at_corner.data(), corners_, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  for (const auto& [unknown, number] : clamped_corners_) local(unknown) = at_corner[number];
  double most = 0;
  for (std::size_t i = 0; i < place_.size(); ++i)
    if (place_[i] < 0) most = std::max(most, std::abs(local(static_cast<Eigen::Index>(i))));
  return largest(most);
}

Numbers numbers(const MeshPart& piece, bool at_vertices) {
  const int count = at_vertices ? piece.mesh.vertex_count() : piece.mesh.edge_count();
  const std::vector<Shared> shared = shared_unknowns(piece, at_vertices, true);
  std::vector<char> taken(count, 0);
  long long next = 0;
  for (const Shared& s : shared) {
    taken[s.unknown] = 1;
    if (s.owner == rank()) ++next;
  }
  Numbers all{std::vector<long long>(count), std::vector<int>(next)};
  for (int i = 0; i < count; ++i)
    if (taken[i] == 0) all.own.push_back(i);
  const std::vector<long long> start = starts(static_cast<long long>(all.own.size()));
  for (const Shared& s : shared) {
    all.number[s.unknown] = start[s.owner] + s.position;
    if (s.owner == rank()) all.own[s.position] = s.unknown;
  }
  for (std::size_t i = 0; i < all.own.size(); ++i) all.number[all.own[i]] = start[rank()] + static_cast<long long>(i);
  all.total = start.back();
  return all;
}

}  // namespace antilock::distributed
