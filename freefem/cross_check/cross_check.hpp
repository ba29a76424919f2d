#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/form/elasticity_forms.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock::freefem {

/// For each point of `ours` the row of `theirs` at the same place (to 1e-8: meshes carry 17
/// digits). Numberings are never compared. Throws Error unless this is one to one.
std::vector<int> match(const Points& ours, const Points& theirs);

/// What matrices.edp assembles on a mesh, renumbered as `space` numbers its unknowns.
struct Discretisation {
  SparseMatrix a1, a0;
  Eigen::VectorXd load;
  std::vector<int> clamped, contact;  ///< ascending; by x
};
/// Writes the mesh of `space` into `folder`, runs matrices.edp on it and reads its files.
Discretisation assemble(const Space& space, const std::filesystem::path& folder);

/// The solution that a script computed, renumbered as `space` numbers its unknowns.
struct Result {
  std::string road;          ///< how the stiff part was solved: mixed, penalty or sum
  Eigen::VectorXd u;         ///< N
  Eigen::VectorXd gap;       ///< C, by x
  Eigen::VectorXd pressure;  ///< C, a density
  double energy = 0;         ///< J(u)
  double residual = 0;       ///< |A1 u + D' p - b - lambda| / |b|, maximum norms
  double seconds = 0;        ///< of the solve alone
  int steps = 0;             ///< of the contact loop
};
/// Writes the mesh of `space` into `folder`, runs `script` (04, 05, 06 or 08) on it and reads its
/// files.
Result solve(const std::string& script, const Space& space, double epsilon,
             const std::filesystem::path& folder, const std::vector<std::string>& options = {});

/// The paper's Uzawa in FreeFEM, LinearCG in each step: what 04_reference_solution.edp writes
/// with -solver uzawa.
struct History {
  std::string road;
  Eigen::VectorXd change;  ///< per step, |lambda^{k+1} - lambda^k| / rho / |u^k|, maximum norms
  double seconds = 0;
};
/// Runs it from lambda = 0 with the step `rho` for at most `steps` steps, P1 on the mesh of
/// `space`.
History uzawa_history(const Space& space, double epsilon, double rho, int steps,
                      const std::filesystem::path& folder);

/// What 26_elasticity.edp or 32_coating.edp found with one of its elements.
struct ElasticAnswer {
  std::string road;
  Eigen::VectorXd u;      ///< u_x, then u_y, as the space numbers them
  Eigen::VectorXd force;  ///< C, by x
  double energy = 0, residual = 0, seconds = 0;
};
/// Runs 26_elasticity.edp, 30_friction.edp (`parameter` is epsilon) or 32_coating.edp (the
/// thickness) on a mesh with free sides; its files are in `folder` then.
void run_elastic(const std::string& script, const TriangleMesh& mesh, double parameter,
                 const std::filesystem::path& folder);
/// Reads what it left there for the element `name`: P1, P1nc (with jumps) or KS.
ElasticAnswer elastic_answer(const std::filesystem::path& folder, const std::string& name,
                             const VectorSpace& space);
/// Reads the same files as elastic_answer. The tangential forces, ordered by x, follow the normal
/// ones, and the energy contains the work of the friction.
ElasticAnswer friction_answer(const std::filesystem::path& folder, const std::string& name,
                              const VectorSpace& space);

/// The contact force of Taylor-Hood there.
double taylor_hood_force(const std::filesystem::path& folder);

/// What 27_plate.edp found with one of its elements.
struct PlateAnswer {
  std::string road;
  Eigen::VectorXd w, force;  ///< as the space of the deflection numbers them
  double energy = 0, seconds = 0;
};
/// Runs 27_plate.edp on a mesh; epsilon is the square of the thickness.
void run_plate(const TriangleMesh& mesh, double epsilon, const std::filesystem::path& folder);
/// Reads what it left there for the element `name`: P1, P1_one or Arnold_Falk.
PlateAnswer plate_answer(const std::filesystem::path& folder, const std::string& name,
                         const Space& deflection);

/// Our solution against theirs.
struct Comparison {
  double difference = 0;     ///< largest |u - their u| / largest |u|
  double energy = 0;         ///< |J - their J| / |J|
  int contact_disagree = 0;  ///< contact unknowns in contact on one side only, but for those whose
                             ///< gap and pressure are both below 1e-10 on both sides
};
Comparison compare(const Space& space, const VariationalInequality& problem, const Solution& ours,
                   const Result& theirs);

}  // namespace antilock::freefem
