#pragma once
#include <vector>

#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The constitutive law of a region: the flux A grad u of a gradient, and the norm of a flux q,
/// |q|^2 = x q_x^2 + y q_y^2, which is the norm of A^-1.
struct FluxLaw {
  /// Whether the flux is stiffness * (d_x u, p), p the layer stress, an unknown of its own (the
  /// scaled layer). If not, the flux is stiffness * grad u.
  bool split = false;
  double stiffness = 1;  ///< kappa of the body, s of the scaled layer, 1 / epsilon of the thin one
  double x = 1, y = 1;   ///< 1 / stiffness; y = epsilon^2 / s in the scaled layer

  /// Returns |flux|^2.
  double squared(const Eigen::Vector2d& flux) const {
    return x * flux(0) * flux(0) + y * flux(1) * flux(1);
  }
};

/// The flux sigma = s + tau on one triangle. s is the flux of Crouzeix-Raviart, and tau is the
/// correction by which sigma balances f_1 and the traction. tau = 0 in the layer.
struct FluxCell {
  FluxLaw law;
  /// A grad u_h; stiffness * (d_x u_h, p) in the scaled layer.
  Eigen::Vector2d s = Eigen::Vector2d::Zero();
  /// f_1 at the vertices: f projected on the affine functions.
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  /// For each edge E the coefficient by which tau balances the slope of the traction G along E: c_E
  /// = -6 |E| mean_E(G (t - 1/2)), t from 0 to 1 along E.
  Eigen::Vector3d traction = Eigen::Vector3d::Zero();
  double oscillation2 = 0;  ///< osc_T^2
  double tau2 = 0;          ///< |tau|_T^2, in the norm of A^-1
};

/// A flux sigma in equilibrium with f_1, the projection of the load f on functions that are affine
/// on each triangle. It is built from any u and p on the Crouzeix-Raviart space; certificate.cpp,
/// part 1, has the derivation.
struct EquilibratedFlux {
  FluxLaw law;                 ///< of the layer
  std::vector<FluxCell> cell;  ///< T
  Eigen::VectorXd residual;    ///< N, r = A1 u + B' M p - L, with A1, B and load L of the scene
  /// C, the positive part of r on Gamma_C, the contact boundary: contact forces.
  Eigen::VectorXd lambda;
  Eigen::VectorXd imbalance;      ///< N, r1 = r - lambda on free unknowns; 0 on prescribed ones
  Eigen::VectorXd gap;            ///< C, the mean of the gap over each contact edge
  Eigen::VectorXd traction_load;  ///< V, the work of the traction on the P1 function of each vertex
  double norm2 = 0;               ///< |sigma|^2, in the norm of A^-1
  double tau2 = 0;                ///< |tau|^2, in the norm of A^-1
  double oscillation2 = 0;        ///< osc^2, the sum over the triangles
  double dual_energy = 0;         ///< D, the energy of the dual problem at sigma

  /// Returns tau at q points of triangle t (q x 2); `barycentric` (q x 3) are the coordinates of
  /// the points.
  Eigen::MatrixX2d tau(const TriangleMesh& mesh, int t, const Eigen::MatrixX3d& barycentric) const;
};

/// Builds the flux. u and p need not satisfy any equation. Where f is far from affine on a
/// triangle, it is integrated by a finer rule than that of the solver, and the difference is a part
/// of r. Throws Error for
/// - another element than Crouzeix-Raviart,
/// - a feature that Scene::beyond_the_certificate names,
/// - a stiffness that varies on a triangle (as sampled),
/// - a traction on the layer,
/// - a displacement that is not affine on an edge or jumps between two edges,
/// - a solution of another size or with entries that are not finite,
/// - a problem that is not that of this scene on this space,
/// - the Ventcel layer. The scaled layer with epsilon = 0 is the same problem and is accepted.
EquilibratedFlux equilibrated_flux(const Scene& scene, const Result& result);

}  // namespace antilock
