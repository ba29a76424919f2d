#pragma once
#include <vector>

#include "antilock/distributed/detail/distributed_problem.hpp"

namespace antilock::distributed {

/// An index set of PETSc.
using IndexSet = Handle<IS, ISDestroy>;

/// The subdomains of an overlapping Schwarz method for a layer on any mesh. Not to be confused with
/// the strips of partition.hpp, each of which belongs to a rank.
///
/// The layer is cut into strips of full height, from Sigma to Gamma_C. Functions of x cost no
/// energy in the layer, and a strip of full height contains them. A strip is about 16 units wide,
/// where a unit is the longest extent in x of an edge of the layer there. Each strip is then grown
/// by 6 layers of the graph of A_delta: in the energy, cutting off a function of the kernel over a
/// width w costs about w^-4 times what the function itself has (measured at delta = 1e-6, strips
/// grown 1, 2, 4, 6 times: 382, 41, 15, 11 iterations).
///
/// A rank makes the strips of the range of x in which it owns most of the layer. It takes all
/// unknowns of that range, whichever rank owns them: the border of two ranks has teeth as long as
/// the triangles of the coarse mesh, and strips of a rank's own unknowns alone would lose their
/// full height there (measured with teeth of 16 edges on 8 ranks: 51 iterations in place of 13).
/// The unknowns of the body are one more subdomain of each rank.
class LayerStrips {
 public:
  /// Every rank must call it. Throws NotConverged, on every rank, where a strip has more than
  /// `most_unknowns` unknowns.
  explicit LayerStrips(const DistributedProblem& problem,
                       long long most_unknowns = factored_unknowns);

  /// The strips of this rank, then the unknowns of the body that it owns: global rows, ascending.
  const std::vector<IndexSet>& sets() const { return sets_; }
  /// Number of strips of this rank; sets() has one set more.
  int count() const { return static_cast<int>(sets_.size()) - 1; }
  /// The largest number of sets of all ranks that have an unknown of one triangle. The sum of the
  /// corrections on all sets, each exact or by symmetric SOR, has no eigenvalue above it, because
  /// A_delta is a sum over triangles.
  int most_sets_per_triangle() const { return most_sets_per_triangle_; }
  /// The length of the layer in units, of all ranks.
  double units() const { return units_; }

  /// The width of a strip in units, and the number of times that it grows.
  static constexpr double width = 16;
  static constexpr int growth = 6;
  /// The factor of a strip of this size has some 40 entries per unknown, 250 MB.
  static constexpr long long factored_unknowns = 500000;

 private:
  std::vector<IndexSet> sets_;
  int most_sets_per_triangle_ = 1;
  double units_ = 0;
};

}  // namespace antilock::distributed
