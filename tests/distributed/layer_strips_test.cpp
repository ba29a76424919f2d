// The overlapping strips of a layer on any mesh.
#include "antilock/distributed/detail/layer_strips.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "antilock/core/error.hpp"
#include "antilock/distributed/partition.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock::distributed {
namespace {

TriangleMesh own_subdomain(const TriangleMesh& coarse, int refinements) {
  TriangleMesh mesh = subdomain_of(coarse, strip_partition(coarse, ranks()), rank());
  for (int i = 0; i < refinements; ++i) mesh = refined_subdomain(mesh);
  return mesh;
}

DistributedProblem problem_on(const TriangleMesh& coarse, int refinements) {
  return DistributedProblem(Scene({paper_load}, StiffLayer{1e-3}, UnilateralContact{}),
                            Space(own_subdomain(coarse, refinements), crouzeix_raviart()));
}

std::vector<PetscInt> members_of(const IndexSet& set) {
  PetscInt size = 0;
  const PetscInt* members = nullptr;
  ok(ISGetLocalSize(set, &size));
  ok(ISGetIndices(set, &members));
  std::vector<PetscInt> rows(members, members + size);
  ok(ISRestoreIndices(set, &members));
  return rows;
}

TEST(LayerStrips, ContainEveryFreeUnknown) {
  const DistributedProblem problem = problem_on(unstructured_mesh(8), 2);
  const LayerStrips strips(problem);
  const Vector times = problem.rows().vector();  // per row: the number of sets that have it
  for (const IndexSet& set : strips.sets())
    for (const PetscInt row : members_of(set)) ok(VecSetValue(times, row, 1, ADD_VALUES));
  ok(VecAssemblyBegin(times));
  ok(VecAssemblyEnd(times));
  PetscReal least = 0;
  ok(VecMin(times, nullptr, &least));
  EXPECT_GE(least, 1);
}

TEST(LayerStrips, AreAboutSixteenEdgesWide) {
  const DistributedProblem problem = problem_on(unstructured_mesh(8), 3);  // 1/h = 64
  const LayerStrips strips(problem);
  // the longest edges of Frontal-Delaunay are a little longer than h
  EXPECT_GT(strips.units(), 40);
  EXPECT_LT(strips.units(), 70);
  const long long all = sum(static_cast<long long>(strips.count()));
  EXPECT_GE(all, std::max(2, ranks() - 1));
  EXPECT_LE(all, 4 + ranks());
}

TEST(LayerStrips, MeetInATriangleAtMostWithTheirNeighbours) {
  const DistributedProblem problem = problem_on(unstructured_mesh(16), 2);
  // two strips and the body on one rank; on more, two strips and the bodies of two ranks, or what
  // the teeth of a border make of it
  const int most = LayerStrips(problem).most_sets_per_triangle();
  EXPECT_GE(most, 2);
  EXPECT_LE(most, ranks() == 1 ? 3 : 5);
}

/// Returns the message with which the strips are refused, or nothing where they are accepted.
std::string refusal_of(const DistributedProblem& problem, long long most_unknowns) {
  try {
    const LayerStrips strips(problem, most_unknowns);
  } catch (const NotConverged& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

TEST(LayerStrips, AreRefusedWhereOneIsTooLarge) {
  const DistributedProblem problem = problem_on(unstructured_mesh(16), 0);
  EXPECT_EQ(refusal_of(problem, LayerStrips::factored_unknowns), "");
  const std::string message = refusal_of(problem, 100);
  EXPECT_TRUE(says(message, "a strip of the layer has")) << message;
  EXPECT_TRUE(says(message, "its cells are small")) << message;
  EXPECT_TRUE(says(message, "accepted: ")) << message;
}

TEST(LayerStrips, AreRefusedWhereTheLayerIsOneStripWide) {
  // three edges long, a layer is not cut on one rank, and cut on each border of two ranks
  const DistributedProblem problem = problem_on(unstructured_mesh(std::max(3, ranks())), 0);
  EXPECT_EQ(refusal_of(problem, LayerStrips::factored_unknowns), "");
  const std::string message = refusal_of(problem, 1);
  EXPECT_EQ(says(message, "the layer is one strip wide"), ranks() == 1) << message;
  EXPECT_EQ(says(message, "its cells are small"), ranks() > 1) << message;
}

}  // namespace
}  // namespace antilock::distributed
