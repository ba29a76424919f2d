#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/distributed/detail/petsc.hpp"
#include "antilock/space/space.hpp"

namespace antilock::distributed {

/// Which row of the whole problem each unknown of a subdomain is, and the way between these unknowns and a vector of
/// all ranks, in which one rank owns what several hold. The rows of rank 0 come first; those of a rank stand by column
/// (x, then y: what belongs together in the layer stands together). Clamped unknowns have a row, too: u stays 0 there.
class DofMap {
 public:
  /// P1 or CR. Every rank must call it.
  explicit DofMap(const Space& space);

  int owned() const { return static_cast<int>(unknown_.size()); }        ///< rows of this rank
  PetscInt first() const { return first_; }                              ///< the row of place 0
  long long total() const { return total_; }                             ///< rows of all ranks that are not clamped
  const std::vector<PetscInt>& row() const { return row_; }              ///< per unknown of the subdomain
  int unknown(int place) const { return unknown_[place]; }               ///< of the space; place: of an owned row
  bool clamped(int unknown) const { return clamped_[unknown] != 0; }     ///< as any rank knows it
  bool contact(int unknown) const { return on_contact_[unknown] != 0; }  ///< as any rank knows it; not where clamped

  /// A vector of the rows, zero.
  Vector vector() const;
  /// The values at all unknowns of the subdomain.
  Eigen::VectorXd local(Vec v) const;
  /// v = the sum over the ranks of what each has at its unknowns.
  void summed(const Eigen::VectorXd& local, Vec v) const;
  /// The same values, but 0 at the clamped unknowns.
  Eigen::VectorXd unclamped(Eigen::VectorXd local) const;
  /// v = what this rank has at the unknowns that it owns, 0 at the clamped ones.
  void owned_part(const Eigen::VectorXd& local, Vec v) const { Entries{v} = unclamped(local)(unknown_); }

 private:
  std::vector<PetscInt> row_;
  std::vector<int> unknown_;
  std::vector<char> clamped_, on_contact_;
  PetscInt first_ = 0;
  long long total_ = 0;
  Handle<VecScatter, VecScatterDestroy> scatter_;
};

}  // namespace antilock::distributed
