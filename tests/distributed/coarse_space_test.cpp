// The coarse functions of a layer on any mesh.
#include "antilock/distributed/detail/coarse_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/distributed/detail/distributed_problem.hpp"
#include "antilock/distributed/partition.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock::distributed {
namespace {

TriangleMesh own_subdomain(const TriangleMesh& mesh) {
  return subdomain_of(mesh, strip_partition(mesh, ranks()), rank());
}

Scene paper_problem() { return Scene({paper_load}, StiffLayer{1e-2}, UnilateralContact{}); }

/// The unknowns of the subdomain for a combination of the coarse functions, whose coefficient is
/// `coefficient` of the number of the function.
template <class Coefficient>
Eigen::VectorXd combination(const CoarseSpace& coarse, const DofMap& rows,
                            const Coefficient& coefficient) {
  Vector weights;
  PetscInt first = 0;
  ok(MatCreateVecs(coarse.interpolation(), &weights, nullptr));
  ok(VecGetOwnershipRange(weights, &first, nullptr));
  {
    Entries weight(weights);
    for (Eigen::Index i = 0; i < weight.size(); ++i)
      weight[i] = coefficient(static_cast<double>(first + i));
  }
  const Vector fine = rows.vector();
  ok(MatMult(coarse.interpolation(), weights, fine));
  return rows.local(fine);
}

TEST(CoarseSpace, LiesInTheKernelOfB) {
  struct Case {
    TriangleMesh mesh;
    const Element* element;
  };
  const Case cases[] = {{unstructured_mesh(16), &crouzeix_raviart()},
                        {jittered_mesh(16, 0.2), &crouzeix_raviart()},
                        {structured_mesh(16), &p1()}};
  for (const auto& [mesh, element] : cases) {
    const DistributedProblem problem(paper_problem(), Space(own_subdomain(mesh), *element));
    const CoarseSpace coarse(problem.space(), problem.rows(), 0);
    const Eigen::VectorXd u =
        combination(coarse, problem.rows(), [](double number) { return std::sin(number); });
    const Eigen::VectorXd strain = problem.part().b * u;
    // entries of B are up to 100 in size, values of u up to 1: round-off of three terms
    EXPECT_LE(largest(strain.size() > 0 ? strain.lpNorm<Eigen::Infinity>() : 0), 1e-11);
    EXPECT_GT(largest(u.lpNorm<Eigen::Infinity>()), 0.5);
  }
}

TEST(CoarseSpace, IsAPartitionOfUnityAwayFromTheClamp) {
  const TriangleMesh mesh = unstructured_mesh(16);
  for (const Element* element : {&crouzeix_raviart(), &p1()})
    for (const int rows : {0, 3}) {
      const DistributedProblem problem(paper_problem(), Space(own_subdomain(mesh), *element));
      const CoarseSpace coarse(problem.space(), problem.rows(), rows);
      const Eigen::VectorXd u = combination(coarse, problem.rows(), [](double) { return 1; });
      double worst = 0;
      for (int i = 0; i < problem.space().size(); ++i) {
        const double x = problem.space().dof_coordinates()(i, 0);
        const double y = problem.space().dof_coordinates()(i, 1);
        // the hat functions of clamped vertices reach two edges far, of length 1/16 or so
        if (x > 0.2 && x < 0.8 && y < 0.8) worst = std::max(worst, std::abs(u(i) - 1));
      }
      EXPECT_LE(largest(worst), 1e-12);
    }
}

TEST(CoarseSpace, RefusesALayerBesideSigma) {
  TriangleMesh mesh = structured_mesh(8);
  std::vector<int> is_cut_off;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const double x = mesh.vertices.col(0)(mesh.triangles.row(t)).mean();
    is_cut_off.push_back(mesh.region[t] == Region::body && x > 0.75 ? 1 : 0);
  }
  mesh = subdomain_of(mesh, is_cut_off, 0);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool on_boundary = mesh.edge_triangles(e, 1) < 0;
    const bool is_cut = mesh.edge_tag[e] == EdgeTag::sigma || mesh.edge_tag[e] == EdgeTag::interior;
    if (on_boundary && is_cut) mesh.edge_tag[e] = EdgeTag::clamped;
  }
  const DistributedProblem problem(paper_problem(), Space(own_subdomain(mesh), crouzeix_raviart()));
  bool is_refused = false;
  try {
    const CoarseSpace coarse(problem.space(), problem.rows(), 0);
  } catch (const NotConverged& error) {
    is_refused = std::string(error.what()).find("no Sigma above it") != std::string::npos;
  }
  EXPECT_EQ(sum(static_cast<long long>(is_refused)), ranks());
}

}  // namespace
}  // namespace antilock::distributed
