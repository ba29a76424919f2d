#include "antilock/distributed/detail/distributed_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/distributed/ranks.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/defaults.hpp"

namespace antilock::distributed {
namespace {

/// The same on every rank.
double penalty_over_all(StiffnessRatio s) {
  s.trace_a0 = sum(s.trace_a0);
  s.trace_a1 = sum(s.trace_a1);
  s.max_a0 = largest(s.max_a0);
  s.max_a1 = largest(s.max_a1);
  return choose_penalty(s);
}

/// The square of the shortest edge of a triangle.
double shortest_edge_squared(const TriangleMesh& mesh, int triangle) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const int e : mesh.triangle_edges.row(triangle)) {
    const Eigen::RowVector2d a = mesh.vertices.row(mesh.edges(e, 0));
    const Eigen::RowVector2d b = mesh.vertices.row(mesh.edges(e, 1));
    shortest = std::min(shortest, (b - a).squaredNorm());
  }
  return shortest;
}

/// PenaltyChoice::mesh_width without its lower bound. The same on every rank.
double penalty_of_mesh_width(const TriangleMesh& mesh) {
  double squares = 0;
  double depth = 0;
  long long triangles = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    ++triangles;
    squares += shortest_edge_squared(mesh, t);
    for (const int v : mesh.triangles.row(t)) depth = std::max(depth, -mesh.vertices(v, 1));
  }
  squares = sum(squares);
  triangles = sum(triangles);
  depth = largest(depth);
  if (triangles == 0 || depth <= 0) return 0;
  return squares / static_cast<double>(triangles) / (256 * depth * depth);
}

}  // namespace

DistributedProblem::DistributedProblem(const Scene& scene, const Space& space,
                                       PenaltyChoice penalty)
    : space_(space), rows_(space) {
  const auto& region = space.mesh().region;
  const long long here = std::count(region.begin(), region.end(), Region::layer), all = sum(here);
  collectively([&] {  // a strip without a part of the layer (between the two feet of a body) has
                      // the body's part of the forms
    part_ = assemble(here > 0 || all == 0
                         ? scene
                         : Scene(scene.body(), NoLayer{}, scene.contact(), scene.edges()),
                     space);
    lower_ = Eigen::VectorXd::Constant(rows_.owned(), -std::numeric_limits<double>::infinity());
    if (!scene.contact()) return;
    for (int place = 0; place < rows_.owned(); ++place) {
      if (!rows_.contact(rows_.unknown(place))) continue;
      const double x = space.dof_coordinates()(rows_.unknown(place), 0);
      const double gap = scene.contact()->gap(x);
      if (!std::isfinite(gap)) throw Error(fmt::format("contact: gap({:.6g}) is not finite", x));
      lower_(place) = -gap;
    }
  });
  const bool stiff =
      sum(static_cast<long long>(part_.m.size())) > 0;  // whether any rank has a row of B
  if (stiff) part_.compliance = largest(part_.m.size() > 0 ? part_.compliance : 0);
  double rule = penalty_over_all(stiffness_ratio(part_));
  if (penalty != PenaltyChoice::serial_default) rule /= defaults::penalty_reduction;
  if (penalty == PenaltyChoice::mesh_width)
    rule = std::max(rule, penalty_of_mesh_width(space.mesh()));
  if (stiff)
    delta_ = penalty == PenaltyChoice::none ? part_.compliance : std::max(part_.compliance, rule);
  // B' M B is the layer's y-derivatives: the same form with weight delta^-1 on the layer is A1 +
  // delta^-1 B' M B
  sum_k(stiff ? gradient_form(space, {1, 1}, {1, 1 / delta_}) : part_.a1);
}

/// The matrix of all ranks from the parts, in which the clamped unknowns keep their diagonal alone.
/// Each part is symmetric up to round-off: its columns serve as PETSc's rows.
void DistributedProblem::sum_k(SparseMatrix part) {
  part.prune([&](auto row, auto column,
                 double value) {  // 0: across the long edge of a right angle; 7 entries become 5
    return row == column || (value != 0 && !rows_.clamped(row) && !rows_.clamped(column));
  });
  Handle<ISLocalToGlobalMapping, ISLocalToGlobalMappingDestroy> to_rows;
  Matrix own, sum;
  const auto size = static_cast<PetscInt>(part.rows());
  ok(ISLocalToGlobalMappingCreate(PETSC_COMM_WORLD, 1, size, rows_.row().data(), PETSC_COPY_VALUES,
                                  &to_rows));
  ok(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, size, size, part.outerIndexPtr(),
                               part.innerIndexPtr(), part.valuePtr(), &own));
  ok(MatCreateIS(PETSC_COMM_WORLD, 1, rows_.owned(), rows_.owned(), PETSC_DETERMINE,
                 PETSC_DETERMINE, to_rows, to_rows, &sum));
  ok(MatISSetLocalMat(sum, own));
  ok(MatAssemblyBegin(sum, MAT_FINAL_ASSEMBLY));
  ok(MatAssemblyEnd(sum, MAT_FINAL_ASSEMBLY));
  ok(MatConvert(sum, MATAIJ, MAT_INITIAL_MATRIX, &k_));
}

}  // namespace antilock::distributed
