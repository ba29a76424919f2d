#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "antilock/form/forms.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/space/detail/vector_space.hpp"

namespace antilock {

/// N x N matrix of 2 mu int eps(u):eps(v), mu = 1 (dimensionless), eps the symmetric gradient, triangle by triangle.
Eigen::SparseMatrix<double> strain_form(const VectorSpace& space);

/// The factored form of int div u div v: a row of B is div at a point of divergence_rule, M its weight. For P1 and CR
/// div is constant on a triangle: one row each, M its area.
FactoredForm divergence(const VectorSpace& space);

/// The rule behind the rows of a triangle: exact for the square of a derivative, 2 (k - 1) for the higher degree k of
/// the two components.
const Quadrature& divergence_rule(const VectorSpace& space);

/// N x N matrix of 2 mu weight sum_e |e|^-1 int_e [u].[v], mu = 1, over the interior and the clamped edges, of the
/// components that are CR. Crouzeix-Raviart needs it with the symmetric gradient: there is no Korn inequality without
/// (Hansbo and Larson 2003). clamped_in_x = false: the clamped edges hold the component y alone.
Eigen::SparseMatrix<double> jump_form(const VectorSpace& space, double weight, bool clamped_in_x = true);

}  // namespace antilock
