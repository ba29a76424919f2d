// Runs Google Test on every rank; rank 0 alone reports, and a failure on any rank fails the run.
#include <gtest/gtest.h>

#include <memory>

#include "antilock/distributed/ranks.hpp"

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const antilock::distributed::Session session;
  if (antilock::distributed::rank() > 0) {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    const std::unique_ptr<::testing::TestEventListener> silenced(
        listeners.Release(listeners.default_result_printer()));
  }
  const long long failed = RUN_ALL_TESTS();
  return antilock::distributed::sum(failed) == 0 ? 0 : 1;
}
