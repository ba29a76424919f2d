#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/distributed/detail/petsc.hpp"
#include "antilock/space/space.hpp"

namespace antilock::distributed {

/// The row of the whole problem for each unknown of a subdomain, and the exchange between these
/// unknowns and a vector of all ranks, in which one rank owns each row that several ranks have. The
/// rows of rank 0 come first. The rows of a rank are ordered by x, then by y, so that the unknowns
/// of a column of the layer are neighbours. Clamped unknowns have a row, too, where u stays 0.
class DofMap {
 public:
  /// The element is P1 or Crouzeix-Raviart. Every rank must call it.
  explicit DofMap(const Space& space);

  int owned() const { return static_cast<int>(unknown_.size()); }  ///< number of rows of this rank
  PetscInt first() const { return first_; }                        ///< the first row of this rank
  /// Number of rows of all ranks that are not clamped.
  long long total() const { return total_; }
  /// One per unknown of the subdomain.
  const std::vector<PetscInt>& row() const { return row_; }
  /// The unknown of the space for an owned row; `place` is the number of the row on this rank.
  int unknown(int place) const { return unknown_[place]; }
  bool clamped(int unknown) const { return clamped_[unknown] != 0; }  ///< according to any rank
  /// Whether it is on Gamma_C, the contact boundary, on any rank, and not clamped.
  bool contact(int unknown) const { return on_contact_[unknown] != 0; }

  /// Returns a vector of all rows, zero.
  Vector vector() const;
  /// Returns the values at all unknowns of the subdomain.
  Eigen::VectorXd local(Vec v) const;
  /// Sets v to the sum over the ranks of the values at their unknowns.
  void summed(const Eigen::VectorXd& local, Vec v) const;
  /// Returns the same values, but 0 at the clamped unknowns.
  Eigen::VectorXd unclamped(Eigen::VectorXd local) const;
  /// Sets v to the values of this rank at the unknowns that it owns, and to 0 at the clamped ones.
  void owned_part(const Eigen::VectorXd& local, Vec v) const {
    Entries{v} = unclamped(local)(unknown_);
  }

 private:
  std::vector<PetscInt> row_;
  std::vector<int> unknown_;
  std::vector<char> clamped_, on_contact_;
  PetscInt first_ = 0;
  long long total_ = 0;
  Handle<VecScatter, VecScatterDestroy> scatter_;
};

}  // namespace antilock::distributed
