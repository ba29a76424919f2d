#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "antilock/distributed/contact_loop.hpp"

namespace antilock::distributed {

/// Which points of Gamma_C are in contact, all ranks' points by x: what one level tells the next, and what a checkpoint
/// holds. It does not depend on the number of ranks.
struct ContactSet {
  std::vector<double> x;     ///< ascending
  std::vector<char> active;  ///< as many

  /// Whether a point between these is taken to be in contact: where its two neighbours are.
  bool at(double x) const;
};

/// One mesh of the hierarchy with everything that this rank has on it.
struct NestedLevel {
  NestedLevel(const Scene& scene, TriangleMesh subdomain, const Element& element);
  Space space;  ///< on this rank's subdomain
  DistributedProblem problem;
  State state;
  ContactSet contact_set() const;  ///< of all ranks; every rank must call it
  void start_from(const ContactSet& set);
  /// Takes over u and p of the level that this one refines, each on its own triangles.
  void start_from(const NestedLevel& coarse);
};

struct NestedOptions {
  int refinements = 0;  ///< of the coarse mesh
  /// The rank of every triangle of the coarse mesh; empty: strips. For exhibits of what another share costs.
  std::function<std::vector<int>(const TriangleMesh&, int ranks)> partition;
  LoopOptions loop;                 ///< of the last level
  int first_level = 0;              ///< where to begin to solve: a checkpoint holds the set of the level before
  std::optional<ContactSet> start;  ///< of the first level; empty: no contact
  /// After each level but the last, on every rank: what a later run can start from.
  std::function<void(int level, const ContactSet&)> checkpoint = [](int, const ContactSet&) {};
  std::function<void(const std::string&)> stage = [](const std::string&) {};  ///< told what is being done
};

/// What a solve did. Seconds are those of this rank.
struct NestedReport {
  LoopReport last;                                      ///< of the last level
  std::vector<LoopReport> loops;                        ///< per level solved
  std::vector<long long> unknowns;                      ///< per level solved
  int linear_iterations = 0;                            ///< of all levels
  double mesh = 0, assemble = 0, setup = 0, solve = 0;  ///< seconds, all levels
  Kkt kkt;
  std::string warning;
};

/// Solves a scene on `coarse`, refined: strips, assembly, and on every level the contact loop started from the level
/// before. No rank ever holds more of the fine mesh than its own strip. Every rank must call it, with the same coarse
/// mesh. Throws, on every rank alike, Error where the coarse mesh cannot be dealt out or does not fit the scene, where
/// a load or a gap is not finite or the element is neither P1 nor CR; NotConverged.
std::unique_ptr<NestedLevel> solve_nested(const Scene& scene, const TriangleMesh& coarse, const Element& element,
                                          const NestedOptions& options, NestedReport& report);

}  // namespace antilock::distributed
