#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "antilock/form/factored_form.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Returns the N values of int g phi_i over the facets with this tag, phi_i the basis functions. On
/// a facet between two cells phi_i is the mean of both sides. The rule is exact for g of degree k +
/// 3, k the degree of the element. Throws Error where g is not finite.
Eigen::VectorXd edge_load(const Space& space, EdgeTag tag, const Field& g);
/// Returns the N x N matrix of int k u v over these edges. Throws Error where k is negative or not
/// finite.
Eigen::SparseMatrix<double> edge_mass(const Space& space, EdgeTag tag, const Field& k);
/// Returns the same form in factors: a row of B is u at a Gauss point where k is positive. Throws
/// as edge_mass does.
WeightedFactoredForm edge_rows(const Space& space, EdgeTag tag, const Field& k);
/// Returns the N x N matrix B' diag(stiffness m) B of a form in factors.
Eigen::SparseMatrix<double> gram_matrix(const WeightedFactoredForm& rows);

/// Returns the N x N matrix of the Ventcel term int_Sigma d/dx u d/dx v of (25) of [SR04] (cited in
/// problem/variational_inequality.hpp). The mesh is that of the body alone, and Sigma, the
/// interface of body and layer, consists of its contact edges. The trace of u is the continuous
/// piecewise affine function through the unknowns on Sigma and the clamped ends. For P1 that is the
/// trace itself. For CR it goes through the edge midpoints, because the broken trace has no
/// derivative across vertices. `given` are the V values that are prescribed at the ends of
/// Dirichlet edges. Throws Error for another element than P1 or CR, and where Sigma is bent, in
/// pieces or not clamped at both ends.
Eigen::SparseMatrix<double> ventcel_form(const Space& space, const Eigen::VectorXd& given);

}  // namespace antilock
