#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "antilock/form/factored_form.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// N values of int g phi_i over the edges with this tag (between two triangles the mean of both sides), by Gauss
/// points exact for g of degree k + 3. Throws Error where g is not finite.
Eigen::VectorXd edge_load(const Space& space, EdgeTag tag, const Field& g);
/// N x N matrix of int k u v over them. Throws Error where k is negative or not finite.
Eigen::SparseMatrix<double> edge_mass(const Space& space, EdgeTag tag, const Field& k);
/// The same as rows: u at each Gauss point, where k is above 0. Throws as edge_mass does.
WeightedFactoredForm edge_rows(const Space& space, EdgeTag tag, const Field& k);
/// N x N matrix of such a form.
Eigen::SparseMatrix<double> gram_matrix(const WeightedFactoredForm& rows);

/// N x N matrix of the Ventcel term int_Sigma d/dx u d/dx v of (25), on the contact edges of a mesh of the body alone.
/// The trace is the continuous piecewise affine function through the unknowns on Sigma and the clamped ends: for P1 the
/// trace itself, for CR the one through the edge midpoints (the broken trace has no derivative across vertices). Throws
/// Error for another element than P1 or CR, and where Sigma is bent, in pieces or not held at both ends by u = 0.
/// given: the V values that are prescribed at the ends of held edges.
Eigen::SparseMatrix<double> ventcel_form(const Space& space, const Eigen::VectorXd& given);

}  // namespace antilock
