#pragma once
#include "antilock/form/elasticity_forms.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

class StiffnessRange;

/// How a block in plane strain is held and what it is pressed on: the clamped edges are moved down by
/// `prescribed_displacement`, the bottom is in unilateral contact, u_y >= -gap(x) on the contact edges, without
/// friction or with a given friction bound g (Tresca): + int g |u_x|. Bounds: those of u_y by x, then, with friction,
/// those of u_x by x.
struct BlockLoading {
  double prescribed_displacement = 0.1;  ///< displacement of the clamped edges, downwards
  bool sliding = false;  ///< clamped edges slide in x; u_x = 0 on the whole line x = 0 instead (patch test)
  Profile gap = [](double) { return 0.0; };
  Profile friction = {};   ///< g(x) >= 0, a force per length; empty: none
  double jump_weight = 1;  ///< of jump_form; 0: none (CR then has zero modes)
};

/// Adds jump_form, the prescribed values and the bounds to a problem with A1, whose load becomes 0. `range`: of the
/// problem's stiffnesses, where they may lie far apart. Throws Error for values out of range and for components on two
/// meshes.
void add_block_loading(VariationalInequality& problem, const BlockLoading& press, const VectorSpace& space,
                       const StiffnessRange* range = nullptr);

/// Nearly incompressible elasticity, mu = 1 (the paper's introduction): a1 = 2 int eps(u):eps(v), a0 = int div u div v,
/// the class parameter epsilon = 1/lambda.
struct PlaneStrain : BlockLoading {
  double epsilon = 1e-8;  ///< 1/lambda, in [0, 1]; 0: incompressible
  /// The pressure is continuous and affine, one value per vertex: the row of B of vertex i is (int phi_i div u) / (int
  /// phi_i). With P2 that is Taylor and Hood's method, with P1 and a bubble MINI (Arnold, Brezzi and Fortin 1984):
  /// exactly so at epsilon = 0. Above, the pressures' mass matrix is lumped (form/strain_projection.hpp).
  bool continuous_pressure = false;
};

/// The problem (6) of plane strain on a vector space. Throws Error for values out of range.
VariationalInequality assemble(const PlaneStrain& scene, const VectorSpace& space);

/// The unit square with its sides x = 0 and x = 1 free: the clamped edges of a mesh of the body that lie on them lose
/// their tag.
TriangleMesh with_free_sides(TriangleMesh mesh);

}  // namespace antilock
