#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "antilock/distributed/contact_loop.hpp"

namespace antilock::distributed {

/// The contact set on the points of Gamma_C, the contact boundary, of all ranks, ordered by x. The
/// next level starts from it, and a checkpoint contains it. It does not depend on the number of
/// ranks.
struct ContactSet {
  std::vector<double> x;     ///< ascending, one per point
  std::vector<char> active;  ///< one per point: whether it is in contact

  /// Returns whether both neighbours of x are in contact, which is the guess for a new point at x.
  bool at(double x) const;
};

/// One mesh of the hierarchy with the data of this rank on it.
struct NestedLevel {
  NestedLevel(const Scene& scene, TriangleMesh subdomain, const Element& element,
              PenaltyChoice penalty);
  Space space;  ///< on the subdomain of this rank
  DistributedProblem problem;
  State state;
  ContactSet contact_set() const;  ///< of all ranks; every rank must call it
  /// Sets the contact set of `state` to the guess of `set`.
  void start_from(const ContactSet& set);
  /// Sets u and p to those of the level that this one refines, each rank on its own triangles.
  void start_from(const NestedLevel& coarse);
};

struct NestedOptions {
  int refinements = 0;  ///< number of refinements of the coarse mesh
  /// Returns the rank of every triangle of the coarse mesh; empty: strip_partition. It serves to
  /// measure other partitions.
  std::function<std::vector<int>(const TriangleMesh&, int ranks)> partition;
  /// Those of the last level. Where they name no preconditioner, it is multigrid for a layer in
  /// columns or one that is not stiff, and strips for every other layer.
  LoopOptions loop;
  /// The level on which the first solve is made. A run that continues from the checkpoint of level
  /// k begins at level k + 1.
  int first_level = 0;
  /// The contact set from which the first level starts; empty: no contact.
  std::optional<ContactSet> start;
  /// Called on every rank after each level except the last, with the contact set from which a later
  /// run can start.
  std::function<void(int level, const ContactSet&)> checkpoint = [](int, const ContactSet&) {};
  /// Called with the name of the stage that begins.
  std::function<void(const std::string&)> stage = [](const std::string&) {};
};

/// Counts and times of a solve. Seconds are those of this rank.
struct NestedReport {
  LoopReport last;                                      ///< of the last level
  std::vector<LoopReport> loops;                        ///< per level solved
  std::vector<long long> unknowns;                      ///< per level solved
  int linear_iterations = 0;                            ///< of all levels
  double mesh = 0, assemble = 0, setup = 0, solve = 0;  ///< seconds, all levels
  Kkt kkt;
  std::string warning;
};

/// Refines `coarse` and solves a scene on every level. The mesh is cut into strips. The contact
/// loop of a level starts from the solution of the level before. No rank ever holds more of the
/// fine mesh than its own strip. Every rank must call it, with the same coarse mesh. Throws Error
/// where the coarse mesh cannot be distributed or does not fit the scene, where a load or a gap is
/// not finite, and where the element is neither P1 nor Crouzeix-Raviart. Throws as contact_loop
/// does. Every rank throws the same exception.
std::unique_ptr<NestedLevel> solve_nested(const Scene& scene, const TriangleMesh& coarse,
                                          const Element& element, const NestedOptions& options,
                                          NestedReport& report);

}  // namespace antilock::distributed
