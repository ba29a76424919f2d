#include "antilock/distributed/rows.hpp"

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

/// P1: the corners, then the vertices inside each seam. CR: the edges of each seam. Clamped ones have position -1.
std::vector<Shared> shared_unknowns(const Piece& piece, bool at_vertices) {
  std::vector<Shared> shared;
  if (at_vertices)
    for (const SharedCorner& corner : piece.corners) shared.push_back({corner.vertex, corner.owner, corner.index});
  for (const Seam& seam : piece.seams) {
    const int pieces = static_cast<int>(seam.edges.size()), inner = at_vertices ? pieces - 1 : pieces;
    const int start = (at_vertices ? piece.corner_rows[seam.owner] : 0) + seam.index * inner;
    for (int s = 0; s < inner; ++s)
      shared.push_back({at_vertices ? seam.vertices[s + 1] : seam.edges[s], seam.owner, start + s});
  }
  return shared;
}

}  // namespace

Rows::Rows(const Piece& piece, const Space& space) {
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

  std::vector<Shared> shared = shared_unknowns(piece, at_vertices);
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

  const std::vector<long long> owned = each(owned_);
  total_ = std::accumulate(owned.begin(), owned.end(), 0LL);
  if (total_ > std::numeric_limits<PetscInt>::max() / 16)  // 16 entries per row fit into the indices of the matrices
    throw Error(fmt::format("mesh: {} unknowns; accepted by this build of PETSc (32-bit indices): {}", total_,
                            std::numeric_limits<PetscInt>::max() / 16));
  std::vector<long long> start(owned.size() + 1, 0);
  std::partial_sum(owned.begin(), owned.end(), start.begin() + 1);
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

}  // namespace antilock::distributed
