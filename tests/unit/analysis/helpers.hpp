#pragma once
#include "antilock/certificate/balanced_tolerance.hpp"
#include "antilock/certificate/certificate.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/models/timoshenko_beam.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock::test::analysis_test {

using Problem = std::function<VariationalInequality(int cells)>;

/// A scene with its result by Crouzeix-Raviart, and room for what a test does to it.
struct Answered : Result {
  Scene scene;

  Answered(TriangleMesh mesh, Scene asked)
      : Result{.space = Space(std::move(mesh), crouzeix_raviart())}, scene(std::move(asked)) {
    problem = assemble(scene, space);
    solution = active_set(problem);
  }

  EquilibratedFlux flux() const { return equilibrated_flux(scene, *this); }
  ConformingCompanion strip() const { return local_companion(scene, *this); }
  Certificate certified() const { return certify(scene, *this); }
};

/// u and p pushed away from the answer: no equation holds any more.
inline void disturb(Answered& run, double amount, unsigned seed) {
  std::mt19937 random(seed);
  const auto noise = [&] { return amount * (2.0 * random() / std::mt19937::max() - 1); };
  std::vector<char> fixed(run.space.size(), 0);
  for (const int i : run.problem.dirichlet_dofs) fixed[i] = 1;
  const double u = run.solution.u.lpNorm<Eigen::Infinity>(),
               p = run.solution.p.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < run.space.size(); ++i) run.solution.u(i) += fixed[i] ? 0 : noise() * u;
  for (double& value : run.solution.p) value += noise() * p;
}

/// Broken H1 seminorm.
inline SparseMatrix h1_seminorm(const Space& space) { return gradient_form(space, {1, 1}, {1, 1}); }
constexpr std::pair<double, double> all{0.9, 1.15}, nearly_none{-1e-12, 0.1};

}  // namespace antilock::test::analysis_test
