#include "antilock/distributed/detail/strip_multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>

#include "antilock/core/error.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

/// The length of a smoothing step times N. Below 2 the V-cycle is positive definite; a shorter step
/// smooths less.
constexpr double step_length = 1.5;

/// The fill that PETSc expects of a product. It allocates more where this is too little.
constexpr PetscReal expected_fill = 2;

/// The depth and the length of the layer of all ranks.
struct LayerBox {
  double depth = 0, length = 0;
  bool has_flat_bottom = true;
};

LayerBox box_of_layer(const TriangleMesh& mesh) {
  double lowest = 0;
  double left = 1e300;
  double right = -1e300;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    for (const int v : mesh.triangles.row(t)) {
      lowest = std::min(lowest, mesh.vertices(v, 1));
      left = std::min(left, mesh.vertices(v, 0));
      right = std::max(right, mesh.vertices(v, 0));
    }
  }
  LayerBox box;
  box.depth = largest(-lowest);
  box.length = largest(right) + largest(-left);
  long long above = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    for (const int v : mesh.edges.row(e))
      above += mesh.vertices(v, 1) > -(1 - 1e-6) * box.depth ? 1 : 0;
  }
  box.has_flat_bottom = sum(above) == 0;
  return box;
}

/// The rows of coarse functions in the layer. A row is half as high as a strip is wide, in lengths
/// that A1 and delta^-1 B' M B charge alike: sqrt(delta) times the depth. So there are none for
/// small delta, where a function that varies along y is local. More rows do harm there (measured:
/// 18 to 25 iterations). A bottom that is not flat may leave a function without an unknown, so that
/// the coarse matrix would be singular: then there are none.
int rows_of_coarse_functions(const DistributedProblem& problem, double units) {
  const LayerBox box = box_of_layer(problem.space().mesh());
  if (!box.has_flat_bottom || box.length <= 0) return 0;
  const double depth = std::sqrt(problem.delta()) * box.depth / box.length * units;
  return static_cast<int>(std::lround(2 * depth / LayerStrips::width));
}

/// The rows of all ranks that are in one of two contact sets, ascending on each rank, alone.
std::vector<PetscInt> changed_rows(const std::vector<PetscInt>& before,
                                   const std::vector<PetscInt>& after) {
  std::vector<PetscInt> here;
  std::set_symmetric_difference(before.begin(), before.end(), after.begin(), after.end(),
                                std::back_inserter(here));
  std::vector<PetscInt> all;
  for (const double row : all_gather(std::vector<double>(here.begin(), here.end())))
    all.push_back(static_cast<PetscInt>(row));
  return all;
}

/// Whether a set has one of the rows.
bool has_any(IS set, const std::vector<PetscInt>& rows) {
  PetscInt size = 0;
  const PetscInt* members = nullptr;
  ok(ISGetLocalSize(set, &size));
  ok(ISGetIndices(set, &members));
  const bool found = std::any_of(rows.begin(), rows.end(), [&](PetscInt row) {
    return std::binary_search(members, members + size, row);
  });
  ok(ISRestoreIndices(set, &members));
  return found;
}

/// The solvers of the sets of this rank.
std::vector<PC> preconditioners_of_sets(PC schwarz) {
  PetscInt count = 0;
  KSP* solvers = nullptr;
  ok(PCASMGetSubKSP(schwarz, &count, nullptr, &solvers));
  std::vector<PC> all(count);
  for (PetscInt k = 0; k < count; ++k) ok(KSPGetPC(solvers[k], &all[k]));
  return all;
}

}  // namespace

StripMultigrid::StripMultigrid(const DistributedProblem& problem)
    : strips_(problem),
      coarse_(problem.space(), problem.rows(), rows_of_coarse_functions(problem, strips_.units())),
      split_(problem) {}

void StripMultigrid::set_up(KSP solver, Mat summed, const std::vector<PetscInt>& held) {
  ok(MatSetOption(summed, MAT_SPD, PETSC_TRUE));
  split_.fix_rows(held, summed);
  set_coarse_matrix(summed);
  if (!last_held_) {
    configure(solver, summed);
    ok(PCSetUp(schwarz_));
    configure_strips();
  } else {
    renew_operators(solver, summed);
    keep_untouched_factors(held);
    ok(PCSetUp(schwarz_));
  }
  factor_strips();
  ok(KSPSetUp(solver));
  last_held_ = held;
}

/// P' A_delta P with the contact set taken out of P. A hat function above a point in contact
/// becomes stiff, and drops out of the coarse correction by itself.
void StripMultigrid::set_coarse_matrix(Mat summed) {
  const bool first = !last_held_;
  if (first)
    ok(MatDuplicate(coarse_.interpolation(), MAT_COPY_VALUES, &interpolation_));
  else
    ok(MatCopy(coarse_.interpolation(), interpolation_, SAME_NONZERO_PATTERN));
  ok(MatDiagonalScale(interpolation_, split_.free_rows(), nullptr));
  if (first) prepare_coarse_product(summed);
  ok(MatProductNumeric(coarse_matrix_));
}

/// On several ranks "allatonce" adds up P' A_delta P row by row. PETSc's default keeps A_delta P, a
/// transpose of P and the rows of the neighbours (measured at 460,288 unknowns: 380 MB on each of
/// two ranks, and 344 MB with "allatonce", in no more seconds). One rank does not know the name.
void StripMultigrid::prepare_coarse_product(Mat summed) {
  ok(MatProductCreate(summed, interpolation_, nullptr, &coarse_matrix_));
  ok(MatProductSetType(coarse_matrix_, MATPRODUCT_PtAP));
  ok(MatProductSetAlgorithm(
      coarse_matrix_, ranks() > 1 ? MATPRODUCTALGORITHMALLATONCE : MATPRODUCTALGORITHMDEFAULT));
  ok(MatProductSetFill(coarse_matrix_, expected_fill));
  ok(MatProductSetFromOptions(coarse_matrix_));
  ok(MatProductSymbolic(coarse_matrix_));
}

void StripMultigrid::configure(KSP solver, Mat summed) {
  PC cycle = nullptr;
  ok(KSPSetOptionsPrefix(solver, prefix));
  ok(KSPSetType(solver, KSPCG));
  ok(KSPSetNormType(solver, KSP_NORM_NATURAL));
  ok(KSPGetPC(solver, &cycle));
  ok(PCSetType(cycle, PCMG));
  ok(PCMGSetLevels(cycle, 2, nullptr));
  // without this the residual of the cycle would be that of the summed matrix
  ok(PCSetUseAmat(cycle, PETSC_TRUE));
  ok(PCMGSetInterpolation(cycle, 1, interpolation_));

  KSP coarse = nullptr;
  PC multigrid = nullptr;
  ok(PCMGGetCoarseSolve(cycle, &coarse));
  ok(KSPSetType(coarse, KSPPREONLY));
  renew_operators(solver, summed);
  ok(KSPGetPC(coarse, &multigrid));
  ok(PCSetType(multigrid, PCHYPRE));
  ok(PCHYPRESetType(multigrid, "boomeramg"));
  ok(KSPSetFromOptions(coarse));
  ok(KSPSetFromOptions(solver));

  KSP smoother = nullptr;
  ok(PCMGGetSmoother(cycle, 1, &smoother));
  ok(KSPSetType(smoother, KSPRICHARDSON));
  ok(KSPRichardsonSetScale(smoother, step_length / strips_.most_sets_per_triangle()));
  ok(KSPSetTolerances(smoother, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, 1));
  ok(KSPGetPC(smoother, &schwarz_));
  ok(PCSetType(schwarz_, PCASM));
  ok(PCASMSetType(schwarz_, PC_ASM_BASIC));
  ok(PCASMSetOverlap(schwarz_, 0));  // the strips overlap already, and the body must not grow
  std::vector<IS> sets(strips_.sets().begin(), strips_.sets().end());
  ok(PCASMSetLocalSubdomains(schwarz_, static_cast<PetscInt>(sets.size()), sets.data(), nullptr));
}

/// KSPSetOperators marks a solver that has solved before for a new setup.
void StripMultigrid::renew_operators(KSP solver, Mat summed) {
  PC cycle = nullptr;
  KSP coarse = nullptr;
  KSP smoother = nullptr;
  ok(KSPSetOperators(solver, split_.matrix(), summed));
  ok(KSPGetPC(solver, &cycle));
  ok(PCMGGetCoarseSolve(cycle, &coarse));
  ok(KSPSetOperators(coarse, coarse_matrix_, coarse_matrix_));
  ok(PCMGGetSmoother(cycle, 1, &smoother));
  ok(KSPSetOperators(smoother, split_.matrix(), summed));
}

void StripMultigrid::configure_strips() {
  const std::vector<PC> of_sets = preconditioners_of_sets(schwarz_);
  for (int k = 0; k < strips_.count(); ++k) {
    ok(PCSetType(of_sets[k], PCCHOLESKY));
    ok(PCFactorSetMatSolverType(of_sets[k], MATSOLVERCHOLMOD));
  }
  ok(PCSetType(of_sets.back(), PCSOR));
  ok(PCSORSetSymmetric(of_sets.back(), SOR_LOCAL_SYMMETRIC_SWEEP));
}

/// Each rank factors its own strips, and learns of the failure of another one.
void StripMultigrid::factor_strips() {
  const PetscErrorCode code = PCSetUpOnBlocks(schwarz_);
  PCFailedReason reason = PC_NOERROR;
  ok(PCGetFailedReason(schwarz_, &reason));
  collectively([&] {
    if (code == PETSC_ERR_MEM) throw std::bad_alloc();
    if (code != 0 || reason != PC_NOERROR)
      throw NotConverged(
          "petsc: the matrix of a strip of the layer has no Cholesky factor, because in double "
          "precision it is singular; accepted: stiffnesses of layer and body that differ by less, "
          "or --direct (MUMPS)",
          1, 0);
  });
}

/// A strip without a row that entered or left the contact set has the same matrix as before.
void StripMultigrid::keep_untouched_factors(const std::vector<PetscInt>& held) {
  const std::vector<PetscInt> changed = changed_rows(*last_held_, held);
  const std::vector<PC> of_sets = preconditioners_of_sets(schwarz_);
  for (int k = 0; k < strips_.count(); ++k) {
    const bool is_kept = !has_any(strips_.sets()[k], changed);
    ok(PCSetReusePreconditioner(of_sets[k], is_kept ? PETSC_TRUE : PETSC_FALSE));
  }
}

}  // namespace antilock::distributed
