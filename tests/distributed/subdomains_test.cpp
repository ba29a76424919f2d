// Strips, subdomains, refusals and the report of the distributed module.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "antilock/core/error.hpp"
#include "antilock/distributed/kkt_report.hpp"
#include "antilock/distributed/nested.hpp"
#include "antilock/distributed/partition.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/distributed/snesvi.hpp"
#include "antilock/distributed/tao.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/refine.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/residual.hpp"

namespace antilock::distributed {
namespace {

Scene scene(double epsilon = 1e-6) {
  return Scene({paper_load}, StiffLayer{epsilon}, UnilateralContact{});
}

TEST(Strips, EndAtColumnsAndShareTheTrianglesOut) {
  for (const TriangleMesh& mesh : {structured_mesh(24), layered_mesh(24), layered_mesh(24, 1e-6)})
    for (int count = 1; count <= 8; ++count) {
      const std::vector<int> rank_of = strip_partition(mesh, count);
      std::vector<int> size(count, 0);
      std::vector<double> left(count, 2), right(count, -1);
      for (int t = 0; t < mesh.triangle_count(); ++t) {
        ++size[rank_of[t]];
        if (mesh.region[t] != Region::layer) continue;
        for (int i = 0; i < 3; ++i) {
          const double x = mesh.vertices(mesh.triangles(t, i), 0);
          left[rank_of[t]] = std::min(left[rank_of[t]], x),
          right[rank_of[t]] = std::max(right[rank_of[t]], x);
        }
      }
      for (int r = 0; r < count; ++r) {
        // a share is exceeded by less than the fullest columns, of which 24 make the mesh
        EXPECT_NEAR(size[r], mesh.triangle_count() / (1.0 * count), mesh.triangle_count() / 12.0);
        // no layer triangle reaches over the end of its strip
        if (r > 0) {
          EXPECT_NEAR(left[r], right[r - 1], 1e-12);
        }
      }
    }
}

TEST(Strips, RefuseMoreRanksThanColumns) {
  EXPECT_THROW(strip_partition(structured_mesh(3), 4), Error);
  EXPECT_NO_THROW(strip_partition(structured_mesh(4), 4));
  EXPECT_NO_THROW(strip_partition(unstructured_mesh(8), 2));
}

TEST(Columns, AreBrokenByATriangleOfTheLayerAlone) {
  for (const TriangleMesh& mesh :
       {structured_mesh(8), layered_mesh(8), antilock::refined(layered_mesh(8))})
    EXPECT_EQ(find_triangle_across_columns(mesh), -1);
  for (const TriangleMesh& mesh : {unstructured_mesh(8), jittered_mesh(8, 0.1)}) {
    const int t = find_triangle_across_columns(mesh);
    ASSERT_GE(t, 0);
    EXPECT_EQ(mesh.region[t], Region::layer);
  }
}

TEST(Pieces, RefinedAreThePiecesOfTheRefinedMesh) {
  const TriangleMesh coarse = layered_mesh(6);
  const TriangleMesh fine = antilock::refined(antilock::refined(coarse));
  const std::vector<int> rank_of = strip_partition(coarse, 3);
  int triangles = 0;
  std::set<std::array<double, 2>> places;
  for (int r = 0; r < 3; ++r) {
    const TriangleMesh mesh =
        refined_subdomain(refined_subdomain(subdomain_of(coarse, rank_of, r)));
    triangles += mesh.triangle_count();
    for (int v = 0; v < mesh.vertex_count(); ++v)
      places.insert({mesh.vertices(v, 0), mesh.vertices(v, 1)});
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      ASSERT_GT(mesh.twice_area(t), 0);
      for (int i = 0; i < 3; ++i) {  // edge i lies opposite vertex i, its smaller end first
        const int e = mesh.triangle_edges(t, i), a = mesh.triangles(t, (i + 1) % 3),
                  b = mesh.triangles(t, (i + 2) % 3);
        ASSERT_EQ(mesh.edges(e, 0), std::min(a, b));
        ASSERT_EQ(mesh.edges(e, 1), std::max(a, b));
      }
    }
  }
  EXPECT_EQ(triangles, fine.triangle_count());
  std::set<std::array<double, 2>> wanted;
  for (int v = 0; v < fine.vertex_count(); ++v)
    wanted.insert({fine.vertices(v, 0), fine.vertices(v, 1)});
  EXPECT_EQ(places, wanted);  // to the last bit: both sides of a cut see the same vertex
}

// Two triangles with one point in common: the ranks share an unknown there, though no edge.
TEST(Pieces, ThatMeetAtAPointAloneShareIt) {
  const TriangleMesh bow = make_mesh(Points{{0, 0}, {0.5, 0}, {0, 1}, {1, 0}, {1, 1}},
                                     Triples{{0, 1, 2}, {1, 3, 4}}, {Region::body, Region::body},
                                     {{0, 1, EdgeTag::contact},
                                      {1, 3, EdgeTag::contact},
                                      {1, 2, EdgeTag::clamped},
                                      {0, 2, EdgeTag::clamped},
                                      {3, 4, EdgeTag::clamped},
                                      {1, 4, EdgeTag::clamped}},
                                     "bow");
  EXPECT_EQ(subdomain_of(bow, {1, 1}, 1).triangle_count(), 2);
  const TriangleMesh subdomain = subdomain_of(bow, {0, ranks() - 1}, rank());
  EXPECT_EQ(sum(static_cast<long long>(DofMap(Space(subdomain, p1())).owned())), 5);
  EXPECT_EQ(sum(static_cast<long long>(DofMap(Space(subdomain, crouzeix_raviart())).owned())), 6);
}

TEST(DofMap, OneForEveryVertexAndEdgeOfTheWholeMesh) {
  const TriangleMesh coarse = layered_mesh(8), whole = antilock::refined(coarse);
  const TriangleMesh subdomain =
      refined_subdomain(subdomain_of(coarse, strip_partition(coarse, ranks()), rank()));
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(subdomain, *element), of_whole(whole, *element);
    const DofMap rows(space);
    EXPECT_EQ(sum(static_cast<long long>(rows.owned())), of_whole.size());
    EXPECT_EQ(rows.total(), of_whole.free_count());
    std::vector<double> mine;  // row, x, y: a row means the same unknown on every rank
    for (int i = 0; i < space.size(); ++i)
      mine.insert(mine.end(), {static_cast<double>(rows.row()[i]), space.dof_coordinates()(i, 0),
                               space.dof_coordinates()(i, 1)});
    const std::vector<double> all = all_gather(mine);
    std::vector<std::array<double, 2>> place(of_whole.size(), {-9, -9});
    for (std::size_t i = 0; i < all.size(); i += 3) {
      auto& known = place[static_cast<std::size_t>(all[i])];
      if (known[0] == -9) known = {all[i + 1], all[i + 2]};
      EXPECT_EQ(known[0], all[i + 1]);
      EXPECT_EQ(known[1], all[i + 2]);
    }
  }
}

TEST(Together, WhatOneRankThrowsAllThrow) {
  const int last = ranks() - 1;
  const auto thrown = [&](const auto& failure) {
    try {
      collectively([&] {
        if (rank() == last) throw failure;
      });
    } catch (const NotConverged& error) {
      return "not converged: " + std::string(error.what()) + std::to_string(error.steps);
    } catch (const Error& error) {
      return "error: " + std::string(error.what());
    } catch (const std::bad_alloc&) {
      return std::string("memory");
    }
    return std::string("nothing");
  };
  EXPECT_EQ(thrown(Error("here")), "error: here");
  EXPECT_EQ(thrown(NotConverged("there", 0.5, 7)), "not converged: there7");
  EXPECT_EQ(thrown(std::bad_alloc()), "memory");
  EXPECT_NO_THROW(collectively([] {}));
}

/// solve_nested on `coarse`, its failure as text, the same on every rank or the test fails.
template <class Failure>
void expect_refused(const Scene& scene, const TriangleMesh& coarse, const Element& element,
                    const NestedOptions& options) {
  NestedReport report;
  bool refused = false;
  try {
    solve_nested(scene, coarse, element, options, report);
  } catch (const Failure&) {
    refused = true;
  }
  EXPECT_TRUE(refused);
  EXPECT_EQ(sum(static_cast<long long>(refused)), ranks());
}

TEST(Refusals, AreTheSameOnEveryRank) {
  expect_refused<Error>(scene(), structured_mesh(8), p2(), {});
  expect_refused<Error>(scene(), structured_mesh(8, {0}), p1(), {});  // no layer to be found
  expect_refused<Error>(Scene({paper_load}, VentcelLayer{}), structured_mesh(8, {0}), p1(), {});
  const auto infinite_at_the_right = [](double x, double) { return x > 0.9 ? INFINITY : 1; };
  expect_refused<Error>(Scene({infinite_at_the_right}, StiffLayer{1e-2}), structured_mesh(8), p1(),
                        {});
  const UnilateralContact bad_gap{[](double x) { return x > 0.7 && x < 0.9 ? NAN : 1; }};
  expect_refused<Error>(Scene({paper_load}, StiffLayer{1e-2}, bad_gap), structured_mesh(16), p1(),
                        {});
  expect_refused<Error>(Scene({infinite_at_the_right}, StiffLayer{1e-2}), unstructured_mesh(8),
                        crouzeix_raviart(), {});
  NestedOptions hasty;
  hasty.loop.max_corrections = 1;
  expect_refused<NotConverged>(scene(), structured_mesh(16), p1(), hasty);
  NestedOptions few;
  few.loop.max_iterations = 1;
  expect_refused<NotConverged>(scene(), structured_mesh(16), p1(), few);
  expect_refused<NotConverged>(scene(), unstructured_mesh(16), crouzeix_raviart(), few);
  NestedOptions stopped;
  stopped.loop.progress = [](const Progress& progress) {
    const bool is_last_rank = rank() == ranks() - 1;
    return !is_last_rank || progress.step < 2;
  };
  expect_refused<Interrupted>(scene(), unstructured_mesh(16), crouzeix_raviart(), stopped);
}

TEST(Report, IsTheSerialOneOfTheSameNumbers) {
  const TriangleMesh mesh = structured_mesh(16);
  const Space space(mesh, p1());
  const VariationalInequality problem = assemble(scene(1e-2), space);
  Solution serial = active_set(problem);
  NestedReport report;
  auto level = solve_nested(scene(1e-2), mesh, p1(), {}, report);
  // the same error on both sides: u is pushed by a smooth function of size 1e-4
  const auto push = [](double x, double y) { return 1e-4 * std::sin(7 * x + 3 * y); };
  for (int i = 0; i < space.size(); ++i)
    if (serial.u(i) != 0)
      serial.u(i) += push(space.dof_coordinates()(i, 0), space.dof_coordinates()(i, 1));
  for (int i = 0; i < level->space.size(); ++i)
    if (level->state.u(i) != 0)
      level->state.u(i) +=
          push(level->space.dof_coordinates()(i, 0), level->space.dof_coordinates()(i, 1));
  const Eigen::VectorXd forces =
      -exact_residual(problem, serial.u, serial.p, Eigen::VectorXd(0)).r1;
  for (std::size_t i = 0; i < problem.bounds.unknowns.size();
       ++i)  // the forces that the distributed side takes
    serial.lambda(static_cast<Eigen::Index>(i)) =
        serial.active[i] ? forces(problem.bounds.unknowns[i]) : 0;
  serial.penalised_max_u = 0;
  const Kkt theirs = antilock::kkt_report(problem, serial),
            ours = kkt_report(level->problem, level->state);
  EXPECT_GT(ours.residual, 1e-4);
  EXPECT_NEAR(ours.residual, theirs.residual, 0.01 * theirs.residual);
  EXPECT_NEAR(ours.min_gap, theirs.min_gap, 0.01 * std::abs(theirs.min_gap) + 1e-12);
  EXPECT_NEAR(ours.min_pressure, theirs.min_pressure, 0.01 * std::abs(theirs.min_pressure) + 1e-9);
  EXPECT_NEAR(ours.complementarity, theirs.complementarity, 0.01 * theirs.complementarity + 1e-12);
  std::string warning;
  EXPECT_THROW(certified(level->problem, level->state, 1e-10, warning), NotConverged);
}

TEST(Snesvi, LosesTheSummedMatrixAndSolvesTheSplitForm) {
  const TriangleMesh mesh = structured_mesh(32);
  const Space whole(mesh, p1());
  for (const double epsilon : {1e-2, 1e-6, 0.0}) {
    const Scene question({paper_load}, StiffLayer{epsilon}, UnilateralContact{});
    const Solution serial = active_set(assemble(question, whole));
    const TriangleMesh subdomain = subdomain_of(mesh, strip_partition(mesh, ranks()), rank());
    const Space space(subdomain, p1());
    if (epsilon > 0) {
      const DistributedProblem summed(question, space, PenaltyChoice::none);
      State state = zero_state(summed);
      const distributed::PetscEnd end = distributed::snesvi(summed, state, false);
      EXPECT_EQ(end.converged, epsilon == 1e-2) << end.reason;
    }
    const DistributedProblem problem(question, space, PenaltyChoice::serial_default);
    State state = zero_state(problem);
    const distributed::PetscEnd end = distributed::snesvi(problem, state, true);
    EXPECT_TRUE(end.converged) << end.reason;
    EXPECT_LE(end.corrections, 6);
    EXPECT_NEAR(largest(state.u.maxCoeff()), serial.u.maxCoeff(), 1e-9 * serial.u.maxCoeff());
    EXPECT_NEAR(-largest(-state.u.minCoeff()), serial.u.minCoeff(), 1e-9 * serial.u.maxCoeff());
    EXPECT_LE(kkt_report(problem, state).residual, 1e-9);
  }
}

// Where TAO reports convergence, its u is that of the serial solver. Its tolerances for the summed
// matrix are PETSc's own: 1e-8 for the gradient, and for the gradient over the energy.
TEST(Tao, HasTheSerialSolutionWhereItReportsConvergence) {
  const TriangleMesh mesh = structured_mesh(16);
  const Scene question({paper_load}, StiffLayer{1e-2}, UnilateralContact{});
  const Solution serial = active_set(assemble(question, Space(mesh, p1())));
  const TriangleMesh subdomain = subdomain_of(mesh, strip_partition(mesh, ranks()), rank());
  const Space space(subdomain, p1());
  int converged = 0;
  for (const TaoMethod method : {TaoMethod::bnls, TaoMethod::bntr}) {
    const DistributedProblem summed(question, space, PenaltyChoice::none);
    State state = zero_state(summed);
    const PetscEnd end = tao(summed, state, method, false);
    if (!end.converged) continue;
    ++converged;
    EXPECT_NEAR(largest(state.u.maxCoeff()), serial.u.maxCoeff(), 1e-3 * serial.u.maxCoeff())
        << end.reason;
  }
  EXPECT_GE(converged, 1);
}

TEST(ContactSets, BetweenTwoPointsInContactIsContact) {
  const ContactSet set{{0.1, 0.2, 0.3, 0.4}, {0, 1, 1, 0}};
  EXPECT_TRUE(set.at(0.25));
  EXPECT_TRUE(set.at(0.2));
  EXPECT_FALSE(set.at(0.15));
  EXPECT_FALSE(set.at(0.35));
  EXPECT_FALSE(set.at(0.05));
  EXPECT_FALSE(ContactSet{}.at(0.5));
}

}  // namespace
}  // namespace antilock::distributed
