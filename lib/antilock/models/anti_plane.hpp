#pragma once
#include "antilock/form/interior_penalty.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Assembles the discrete problem of a scene on its space. For a stiff layer it is (23) or, for
/// epsilon = 0, (24) of [SR04] (cited in problem/variational_inequality.hpp). It is (22) for a thin
/// layer and (25) for Ventcel's condition. Without a layer it is the problem of the body alone.
/// With contact it has the bounds u >= -gap(x) on Gamma_C, the contact boundary. Throws Error where
/// mesh and scene do not fit, and where the gap is not finite.
VariationalInequality assemble(const Scene& scene, const Space& space);

/// Assembles (23), or the body alone, on a space of discontinuous P1 by the symmetric interior
/// penalty method. A1 and the rows of B are interior_penalty_form: A1 has both derivatives on the
/// body and d/dx on the layer, B has d/dy on the layer. u = 0 on Gamma_D is imposed weakly. The
/// bounds of contact are those of Crouzeix-Raviart, at the midpoints of the edges on Gamma_C. The
/// first rows of B belong to the triangles of the layer, so that the first entries of Solution::p
/// are the layer stress. Throws Error for a scene with another layer, stiffness or boundary
/// condition, and as interior_penalty_form does.
VariationalInequality assemble(const Scene& scene, const Space& space,
                               const InteriorPenalty& method);

/// Returns the load of such a problem (N): the forces on the body, on a scaled layer and on the
/// named edges.
Eigen::VectorXd load_of(const Scene& scene, const Space& space);

/// Returns the class parameter of (1), which in (23) is the square of the epsilon of [SR04].
/// `assemble` puts it into VariationalInequality::compliance.
double class_parameter(const StiffLayer& layer);
/// Returns the value of a gap or a ceiling at a point of Gamma_C: a function of x, in space of x
/// and y.
double profile_value(const Profile& profile, const Position& x);
/// Returns the displacement that is prescribed at the point x of the Dirichlet facet e. It is 0 on
/// a clamped facet. On the side of a layer it is the displacement on Sigma above x.
double prescribed_on(const Scene& scene, const TriangleMesh& mesh, int e, const Position& x);
/// Returns V values: the prescribed displacement at the ends of Dirichlet edges, and 0 elsewhere. A
/// vertex at which groups with displacements meet has the mean of their values, whatever their
/// order. A vertex at which such a group meets a clamped edge has the value of the group.
/// `assemble` uses the same values.
Eigen::VectorXd dirichlet_vertex_values(const Scene& scene, const TriangleMesh& mesh);

}  // namespace antilock
