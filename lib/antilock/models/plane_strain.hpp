#pragma once
#include "antilock/form/elasticity_forms.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

class StiffnessRange;

/// The boundary conditions of a block in plane strain. The clamped edges are moved down by
/// `prescribed_displacement`. The contact edges are in unilateral contact, u_y >= -gap(x), without
/// friction or with Tresca's friction of a given limit g, which adds int g |u_x| to the energy. The
/// bounds are those of u_y, ordered by x, and then, with friction, those of u_x, ordered by x.
struct BlockLoading {
  double prescribed_displacement = 0.1;  ///< displacement of the clamped edges, downwards
  /// Whether clamped edges may slide in x. Then u_x = 0 is prescribed on the whole line x = 0
  /// instead of on these edges. The patch test uses this.
  bool sliding = false;
  Profile gap = [](double) { return 0.0; };
  Profile friction = {};  ///< g(x) >= 0, a force per length; empty: none
  /// The weight of jump_form; 0: none (CR has zero modes then). Only CR has jumps to be penalised.
  double jump_weight = 1;
};

/// Adds jump_form, the prescribed values and the bounds to a problem that has its A1, and sets its
/// load to 0. `range` lists the stiffnesses of the problem if they may be far apart. With it, a
/// jump form that is too stiff for A1 becomes rows of B with fixed compliances. Without it,
/// jump_form is assembled into A1. Throws Error for values out of range and for components on two
/// meshes.
void add_block_loading(VariationalInequality& problem, const BlockLoading& press,
                       const VectorSpace& space, const StiffnessRange* range = nullptr);

/// Nearly incompressible elasticity with mu = 1 (the introduction of [SR04], which is cited in
/// problem/variational_inequality.hpp). lambda and mu are Lame's moduli. a1 = 2 int eps(u):eps(v),
/// a0 = int div u div v, and the class parameter is epsilon = 1 / lambda.
struct PlaneStrain : BlockLoading {
  double epsilon = 1e-8;  ///< 1/lambda, in [0, 1]; 0: incompressible
  /// Whether the pressure is continuous and affine, one value per vertex: the row of B of vertex i
  /// is (int phi_i div u) / (int phi_i). At epsilon = 0 this is Taylor and Hood's method for P2,
  /// and the MINI element (D. N. Arnold, F. Brezzi, M. Fortin, Calcolo 21, 1984) for P1 with a
  /// bubble. For epsilon > 0 it differs from them, because the mass matrix of the pressures is
  /// lumped (form/strain_projection.hpp).
  bool continuous_pressure = false;
};

/// Assembles the problem (6) of plane strain on a vector space of triangles or quadrilaterals. The
/// equations of fortin_soulie are rows of B with the compliance 0, behind those of div u: first
/// those of u_x, one per triangle, then those of u_y. Throws Error for values out of range, for
/// hybrid_bdm1 and the rotated elements, which have no Korn inequality, and for friction on
/// quadrilaterals.
VariationalInequality assemble(const PlaneStrain& scene, const VectorSpace& space);

/// Returns the mesh with the sides x = 0 and x = 1 of the unit square free: the clamped edges of
/// the body on them lose their tag.
TriangleMesh with_free_sides(TriangleMesh mesh);

}  // namespace antilock
