#pragma once
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Fills the class's problem for a scene on its space: (23)/(24) for a stiff layer, (22) for a thin one, (25) for
/// Ventcel, the Laplacian alone without a layer; bounds u >= -gap(x) on Gamma_C with contact. Throws Error where mesh
/// and scene do not fit, and where the gap is not finite.
VariationalInequality assemble(const Scene& scene, const Space& space);

/// N values of L(v) of such a problem: what pulls at the body, at a scaled layer and at the named edges.
Eigen::VectorXd load_of(const Scene& scene, const Space& space);

/// The class parameter of (1), which in (23) is the square of the paper's epsilon. `assemble` puts it into
/// VariationalInequality::compliance.
double class_parameter(const StiffLayer& layer);
/// The displacement prescribed at a point x of the Dirichlet edge e: 0 on a clamped one, on the side of a layer that above, on
/// y = 0.
double prescribed_on(const Scene& scene, const TriangleMesh& mesh, int e, const Eigen::RowVector2d& x);
/// V values: the same at the ends of Dirichlet edges, 0 elsewhere. Where groups with displacements meet, a vertex has the mean of
/// their values, whatever their order; where one meets a clamped edge, it has the group's value. So it is in `assemble`.
Eigen::VectorXd dirichlet_vertex_values(const Scene& scene, const TriangleMesh& mesh);

}  // namespace antilock
