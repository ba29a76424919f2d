// The operator A_delta in the split form on any number of ranks.
#include "antilock/distributed/detail/split_operator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "antilock/distributed/partition.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock::distributed {
namespace {

/// The contact set of every second bound, those of this rank.
std::vector<PetscInt> every_second_bound(const DistributedProblem& problem) {
  std::vector<PetscInt> held;
  for (int place = 0; place < problem.rows().owned(); ++place)
    if (std::isfinite(problem.lower()(place)) && place % 2 == 0)
      held.push_back(problem.rows().first() + place);
  return held;
}

TEST(SplitOperator, IsTheSummedMatrixWithFixedRows) {
  const TriangleMesh coarse = unstructured_mesh(8);
  const TriangleMesh subdomain = subdomain_of(coarse, strip_partition(coarse, ranks()), rank());
  const Scene scene({paper_load}, StiffLayer{1e-1}, UnilateralContact{});
  for (const Element* element : {&crouzeix_raviart(), &p1()}) {
    const DistributedProblem problem(scene, Space(subdomain, *element));
    const std::vector<PetscInt> held = every_second_bound(problem);
    Matrix summed;
    ok(MatDuplicate(problem.k(), MAT_COPY_VALUES, &summed));
    ok(MatZeroRowsColumns(summed, static_cast<PetscInt>(held.size()), held.data(), 3, nullptr,
                          nullptr));
    SplitOperator split(problem);
    split.fix_rows(held, summed);

    const Vector x = problem.rows().vector();
    const Vector by_sum = problem.rows().vector();
    const Vector by_factors = problem.rows().vector();
    {
      Entries value(x);
      for (Eigen::Index i = 0; i < value.size(); ++i)
        value[i] = std::sin(static_cast<double>(problem.rows().first() + i));
    }
    ok(MatMult(summed, x, by_sum));
    ok(MatMult(split.matrix(), x, by_factors));
    PetscReal size = 0;
    PetscReal difference = 0;
    ok(VecNorm(by_sum, NORM_INFINITY, &size));
    ok(VecAXPY(by_factors, -1, by_sum));
    ok(VecNorm(by_factors, NORM_INFINITY, &difference));
    // delta = 1e-2: round-off of some ten terms per row
    EXPECT_LE(difference, 1e-13 * size);
    EXPECT_GT(size, 1);
  }
}

}  // namespace
}  // namespace antilock::distributed
