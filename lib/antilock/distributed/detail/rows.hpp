#pragma once
#include <Eigen/Dense>
#include <vector>

#include "antilock/distributed/detail/petsc.hpp"
#include "antilock/distributed/detail/piece.hpp"
#include "antilock/space/space.hpp"

namespace antilock::distributed {

/// Which row of the whole problem each unknown of a piece is. Unknowns of this rank come first: those that other ranks
/// hold too, then the others by column (x, then y: what belongs together in the layer stands together); then the
/// ghosts, which another rank owns. Clamped unknowns have no row.
class Rows {
 public:
  /// P1 or CR. Every rank must call it (the ranks tell each other how many rows they own).
  Rows(const MeshPart& piece, const Space& space);

  int owned() const { return owned_; }                            ///< rows of this rank
  int held() const { return static_cast<int>(unknown_.size()); }  ///< owned ones and ghosts
  int shared() const { return shared_; }                          ///< the first owned ones: others hold them
  PetscInt first() const { return first_; }                       ///< the row of place 0
  long long total() const { return total_; }                      ///< rows of all ranks
  int place(int unknown) const { return place_[unknown]; }        ///< -1 where clamped
  int unknown(int place) const { return unknown_[place]; }        ///< of the space
  PetscInt row(int place) const { return place < owned_ ? first_ + place : ghosts_[place - owned_]; }
  bool clamped(int unknown) const { return place_[unknown] < 0; }
  const std::vector<char>& on_contact() const { return on_contact_; }  ///< per unknown; not the clamped ones

  /// A vector of the owned rows with room for the ghosts, zero.
  Vector vector() const;
  /// The values at all unknowns of the piece, 0 where clamped: asks the owners for the ghosts.
  Eigen::VectorXd local(Vec v) const;
  /// v = the sum over the ranks of what each has at its unknowns.
  void summed(const Eigen::VectorXd& local, Vec v) const;
  /// v = what this rank has at the unknowns that it owns.
  void owned_part(const Eigen::VectorXd& local, Vec v) const;
  /// The largest |sum over the ranks| at a clamped unknown.
  double largest_at_clamped(Eigen::VectorXd local) const;

 private:
  std::vector<std::pair<int, int>> clamped_corners_;  ///< unknown, number among the corners of all ranks
  int corners_ = 0;                                   ///< of all ranks
  std::vector<int> place_, unknown_;
  std::vector<PetscInt> ghosts_;
  std::vector<char> on_contact_;
  int owned_ = 0, shared_ = 0;
  PetscInt first_ = 0;
  long long total_ = 0;
};

/// One number per vertex, or per edge, of the whole mesh, clamped or not: those of rank 0 first.
struct Numbers {
  std::vector<long long> number;  ///< per vertex or edge of the piece, from 0
  std::vector<int> own;           ///< those that this rank owns, by their numbers, which follow each other
  long long total = 0;            ///< of all ranks
};
/// Every rank must call it.
Numbers numbers(const MeshPart& piece, bool at_vertices);

}  // namespace antilock::distributed
