#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock::freefem {

/// A number that a script wrote, and what the library finds for it on the same mesh.
struct Number {
  std::string name;
  double ours, theirs, scale;  ///< scale: what the difference is relative to
  double difference() const;   ///< |ours - theirs| / scale; infinity where that is no number
};

/// The comparison with a script that writes numbers and no solution: all of them, its sizes and
/// counts among them.
struct Numbers {
  std::vector<Number> all;
  std::string road;  ///< how FreeFEM solved the stiff part; more than one: "mixed, penalty"
  int unknowns = 0;  ///< of the largest problem
  double seconds = 0, freefem_seconds = 0;  ///< of the solves alone
  double difference() const;                ///< the largest

  void relative(const std::string& name, double ours, double theirs);  ///< to |ours|
  void count(const std::string& name, double ours,
             double theirs);            ///< a scale of 1: one too many is a difference
  void took(const std::string& roads);  ///< one more line of a table: "mixed", or "penalty; mixed"
  void solved(const Space& space, const Solution& solution);  ///< its unknowns and seconds
};

// Each runs its script in `folder`, reads what it wrote there, and throws Error where a row is
// missing.

/// 00: the string: u at the nodes, contact force, energy.
Numbers string_on_an_obstacle(int cells, const std::filesystem::path& folder);
/// 03_by_hand: u at every vertex, the number in contact, energy; P1 on the structured mesh.
Numbers by_hand(int cells, double epsilon, const std::filesystem::path& folder);
/// 18: the split form on a structured mesh, epsilon from 1 to 1e-16: energy and largest u.
/// `element`: P1 or CR.
Numbers roundoff(const std::string& element, int cells, const std::filesystem::path& folder);
/// 23: the eight scenes: energy, least and largest u (relative to the largest |u|), how many
/// unknowns are in contact.
Numbers effects(int cells, double epsilon, const std::filesystem::path& folder);
/// 07: kernel of P1 by ties, both meshes from 1/h = 4 to `cells`; kernels of P1 and CR by rank at
/// 1/h = 4, both meshes; rank of B for CR.
Numbers kernels(int cells, const std::filesystem::path& folder);
/// 11: |u_h^epsilon - u_h^0| in the broken H1 norm, both elements and meshes, epsilon from 1 to
/// 1e-4. A distance falls like epsilon^2, while each side knows u to a fixed share of |u|: relative
/// to the distance at epsilon = 1.
Numbers limits(int cells, const std::filesystem::path& folder);
/// 09: the largest error at the unknowns on the structured mesh of 1/h = 8, against P1 on one four
/// times finer, five epsilons; P1 and CR. Its rows on FreeFEM's own mesh have no counterpart here.
Numbers errors_at_unknowns(const std::filesystem::path& folder);
/// 13: the worst broken H1 error over epsilon on the structured mesh of 1/h = 8, against P1 on one
/// four times finer. P1, then CR.
std::vector<Numbers> worst_errors(const std::filesystem::path& folder);
/// 20: the energy norm of the error on the structured mesh of 1/h = 8, against P1 on one four times
/// finer, six epsilons; P1 and CR.
Numbers energy_errors(const std::filesystem::path& folder);
/// 15: largest u on Gamma_C, P1 and CR on an unstructured mesh, epsilon from 1 to 1e-6 (relative to
/// the largest).
Numbers estimates(int cells, const std::filesystem::path& folder);
/// 12: distances of a fine mesh's u to K_h and of its u^0 to K_0h, P1 on the structured mesh of
/// 1/h = 8.
Numbers contact_sets(const std::filesystem::path& folder);
/// 17: the worst load of the ball, P1 on the structured mesh against one four times finer, epsilon
/// 1, 1e-2, 1e-6, 0.
Numbers worst_loads(int cells, const std::filesystem::path& folder);
/// 19: the energy bracket, the energy of Crouzeix-Raviart, the certificate of P1 and its share in
/// the layer, one unstructured mesh, five epsilons.
Numbers certificate(int cells, const std::filesystem::path& folder);
/// 16: cost of a ridge, ridge and energy on an unstructured mesh, epsilon = 1e-2. P1, then P2.
std::vector<Numbers> degrees(int cells, const std::filesystem::path& folder);
/// 28: u and contact force of P1 with means over boxes, of MINI and of Taylor-Hood. A component of
/// u relative to its largest value.
Numbers mixed(int cells, double epsilon, const std::filesystem::path& folder);
/// 31: layers toward the end of contact, epsilon = 1 and 1e-2: largest u on Gamma_C, how many
/// unknowns are in contact, energy. P1, then P2.
std::vector<Numbers> graded_layers(int cells, const std::filesystem::path& folder);
/// 33: two glued strings, both glues, epsilon from 1 to 1e-12: energy, largest |u|, contact force.
Numbers glued_strings(int cells, const std::filesystem::path& folder);
/// 34: proximal Galerkin, P1 on columns, epsilon = 1, 1e-2, 1e-6 and 0: largest u on Gamma_C,
/// contact force.
Numbers proximal_steps(int cells, const std::filesystem::path& folder);

/// 35: discontinuous P1 on an unstructured mesh, the whole jump penalised and its mean: u and both
/// derivatives at every centroid, relative to their largest value; largest u on Gamma_C, contact
/// force.
Numbers interior_penalty(int cells, double epsilon, const std::filesystem::path& folder);
/// 38: the hybrid form of BDM1 on an unstructured mesh without an obstacle, the load on the means:
/// the mean of u, the stress at the centroid and its derivatives on every triangle, relative to
/// their largest value.
Numbers mixed_bdm1(int cells, double epsilon, const std::filesystem::path& folder);
/// 39: P1 on tetrahedra in contact, on cut cubes at epsilon = 1e-6 and on gmsh's mesh at 1e-2, the
/// load for which both rules are exact: u at every vertex and the contact forces, relative to their
/// largest value; largest u on Gamma_C, energy.
Numbers three_dimensions(int cells, const std::filesystem::path& folder);

}  // namespace antilock::freefem
