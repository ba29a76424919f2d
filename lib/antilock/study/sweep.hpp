#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// One scene on one mesh, asked again and again with another epsilon, load or gap. What does not change is done once:
/// - the forms a1 and a0 of (23) do not hold epsilon: they are assembled once for all of them;
/// - every epsilon with epsilon^2 <= choose_penalty (about h^2/256) shares one factorisation, and so do all loads and
///   all gaps;
/// - the contact set of one answer starts the search for the next.
/// The space, and its mesh, must outlive the sweep.
class Sweep {
 public:
  /// Assembles; throws Error as `assemble` does.
  Sweep(const Scene& scene, const Space& space);

  /// Another thickness of a scaled layer, 0 to 1. Throws Error for another layer, which holds no epsilon or holds it in
  /// its mesh.
  void set_epsilon(double epsilon);
  void set_load(const Field& f);
  /// Another obstacle; throws Error where the scene has none.
  void set_gap(const Profile& gap);

  /// The answer, its counters saying what this question cost beyond the ones before.
  Solution solve(ActiveSetOptions options = {});

  const VariationalInequality& problem() const { return problem_; }
  const Counters& total() const { return total_; }  ///< of all answers so far
  int assembled() const { return assembled_; }      ///< triangles walked over by assembly so far

 private:
  const Space* space_;
  Scene scene_;
  VariationalInequality problem_;
  std::optional<PenaltyFactor> factor_;
  std::optional<std::vector<bool>> contact_set_;
  Counters total_;
  int assembled_ = 0;
};

}  // namespace antilock
