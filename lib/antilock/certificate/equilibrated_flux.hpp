#pragma once
#include <vector>

#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// How a gradient becomes a flux, and how a flux counts in the energy: |q|^2 = x q_x^2 + y q_y^2.
struct FluxLaw {
  bool split = false;  ///< the scaled layer: the flux is s (d_x u, p), p its own unknown; else it is stiffness * grad u
  double stiffness = 1;  ///< kappa of the body, s of the scaled layer, 1 / epsilon of the thin one
  double x = 1, y = 1;   ///< 1 / stiffness; y = epsilon^2 / s in the scaled layer

  double squared(const Eigen::Vector2d& flux) const { return x * flux(0) * flux(0) + y * flux(1) * flux(1); }
};

/// The flux of Crouzeix-Raviart on one triangle, sigma = s + tau; tau = 0 in the layer.
struct FluxCell {
  FluxLaw law;
  Eigen::Vector2d s = Eigen::Vector2d::Zero();         ///< A grad u_h; s (d_x u_h, p) in the scaled layer
  Eigen::Vector3d f = Eigen::Vector3d::Zero();         ///< f_1 at the vertices: f projected on the affine functions
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();  ///< c_E of its edges
  double oscillation2 = 0;                             ///< osc_T^2
  double tau2 = 0;                                     ///< |tau|_T^2, counted by A^-1
};

/// A flux in equilibrium with f_1, built from any u and p on the Crouzeix-Raviart space (derivation in
/// certificate.cpp, part 1).
struct EquilibratedFlux {
  FluxLaw law;                    ///< of the layer
  std::vector<FluxCell> cell;     ///< T
  Eigen::VectorXd residual;       ///< N, r = A1 u + B' M p - b, with the scene's own A1, B and load
  Eigen::VectorXd lambda;         ///< C, the positive part of r on Gamma_C: contact forces
  Eigen::VectorXd imbalance;      ///< N, r1: what is left of r on free unknowns; 0 on the fixed ones
  Eigen::VectorXd gap;            ///< C, the mean of the gap over each contact edge
  Eigen::VectorXd traction_load;  ///< V, the work of the traction on the P1 function of each vertex
  double norm2 = 0;               ///< |sigma|^2, counted by A^-1
  double tau2 = 0;                ///< |tau|^2, counted by A^-1
  double oscillation2 = 0;        ///< osc^2, the sum over the triangles
  double dual_energy = 0;         ///< D, the energy of the dual problem at sigma

  /// tau at the points of a rule on triangle t, q x 2.
  Eigen::MatrixX2d tau(const TriangleMesh& mesh, int t, const Eigen::MatrixX3d& barycentric) const;
};

/// Builds it; u and p need satisfy no equation. Where f is far from affine on a triangle, a finer rule integrates it
/// than the solver used, and the difference is a part of r. Throws Error for another element than Crouzeix-Raviart, for
/// what Scene::beyond_the_certificate names, for a stiffness that varies on a triangle (as sampled), a traction on the
/// layer, a displacement that is not affine on an edge or jumps between two, for the Ventcel layer (accepted in its place:
/// the scaled layer with epsilon = 0, the same problem), for a solution of another size or with entries that are not
/// finite, and for a problem that is not this scene's on this space (its load above all).
EquilibratedFlux equilibrated_flux(const Scene& scene, const Result& result);

}  // namespace antilock
