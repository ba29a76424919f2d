#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/distributed/detail/petsc.hpp"
#include "antilock/space/space.hpp"

namespace antilock::distributed {

/// One number per vertex, or per edge, of the whole mesh, clamped or not: those of rank 0 first.
struct Numbers {
  std::vector<long long> number;  ///< per vertex or edge of the piece, from 0
  std::vector<int> own;           ///< those that this rank owns, by their numbers, which follow each other
  std::vector<char> shared;  ///< per vertex or edge of the piece: other ranks hold it too, the lowest of them owns it
  long long total = 0;       ///< of all ranks
};
/// Every rank must call it.
Numbers numbers(const TriangleMesh& piece, bool at_vertices);

/// Between the unknowns of a piece and a vector of all ranks, in which one rank owns what several hold.
class Exchange {
 public:
  Exchange() = default;
  /// `row`: per unknown of the piece, -1 where it has none; `owned`: rows of this rank. Every rank must call it.
  Exchange(const std::vector<PetscInt>& row, int owned);

  int owned() const { return owned_; }  ///< rows of this rank
  /// A vector of the rows, zero.
  Vector vector() const;
  /// The values at all unknowns of the piece, 0 where there is no row.
  Eigen::VectorXd local(Vec v) const;
  /// v = the sum over the ranks of what each has at its unknowns.
  void summed(const Eigen::VectorXd& local, Vec v) const;

 private:
  /// A vector of PETSc that looks at the values of a piece.
  static Vector view(const Eigen::VectorXd& values);
  Eigen::Index unknowns_ = 0;
  int owned_ = 0;
  Handle<VecScatter, VecScatterDestroy> scatter_;
};

/// Which row of the whole problem each unknown of a piece is. The rows of a rank stand by column (x, then y: what belongs
/// together in the layer stands together). Clamped unknowns have no row.
class Rows : public Exchange {
 public:
  /// P1 or CR. Every rank must call it.
  explicit Rows(const Space& space);

  bool shared(int unknown) const { return shared_[unknown] != 0; }  ///< whether other ranks hold it too
  PetscInt first() const { return first_; }                         ///< the row of place 0
  long long total() const { return total_; }                        ///< rows of all ranks
  PetscInt row(int unknown) const { return row_[unknown]; }         ///< -1 where clamped
  bool owns(PetscInt row) const { return row >= first_ && row < first_ + owned(); }
  int unknown(int place) const { return unknown_[place]; }             ///< of the space; place: of an owned row
  const std::vector<char>& on_contact() const { return on_contact_; }  ///< per unknown; not the clamped ones

  /// v = what this rank has at the unknowns that it owns.
  void owned_part(const Eigen::VectorXd& local, Vec v) const { Entries{v} = local(unknown_); }
  /// The largest |sum over the ranks| at a clamped unknown.
  double largest_at_clamped(const Eigen::VectorXd& local) const;

 private:
  Exchange everywhere_;  ///< the clamped unknowns too
  std::vector<PetscInt> row_;
  std::vector<int> unknown_;
  std::vector<char> on_contact_, shared_;
  PetscInt first_ = 0;
  long long total_ = 0;
};

}  // namespace antilock::distributed
