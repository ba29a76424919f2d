// Eigenvalues.
#include <fcntl.h>
#include <sys/file.h>
#include <Eigen/Core>

#include "antilock/core/eigenvalues.hpp"

namespace antilock::test::core_test::eigenvalues_test {

// The second difference matrix of n unknowns has the eigenvalues 2 - 2 cos(k pi / (n + 1)).
TEST(Eigenvalues, OfTheSecondDifferenceAreThoseOfTheFormula) {
  constexpr int n = 200;
  SparseMatrix upper(n, n);
  for (int i = 0; i < n; ++i) {
    if (i > 0) upper.insert(i - 1, i) = -1;
    upper.insert(i, i) = 2;
  }
  const auto value = [](int k) { return 2 - 2 * std::cos(k * M_PI / (n + 1)); };
  EXPECT_NEAR(largest_eigenvalue(upper) / value(n), 1, 1e-5);  // the iteration stops at 1e-6
}

}  // namespace antilock::test::core_test::eigenvalues_test
