#pragma once
#include <Eigen/Dense>
#include <Eigen/Sparse>

#include "antilock/form/forms.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// A displacement (u_x, u_y) with a space a component on the same mesh: P1 and P1, CR and CR, or P1 and CR (Kouhia and
/// Stenberg 1995). Unknowns: those of x first, those of y behind them. Both spaces must outlive it and be of degree 1.
struct VectorSpace {
  const Space& x;
  const Space& y;
  int size() const { return x.size() + y.size(); }
};

/// N x N matrix of 2 mu int eps(u):eps(v), mu = 1 (dimensionless), eps the symmetric gradient, triangle by triangle.
Eigen::SparseMatrix<double> strain_form(const VectorSpace& space);

/// The factored form of int div u div v: a row of B is div on a triangle, M its area.
LayerStrain divergence(const VectorSpace& space);

/// N x N matrix of 2 mu weight sum_e |e|^-1 int_e [u].[v], mu = 1, over the interior and the clamped edges, of the
/// components that are CR. Crouzeix-Raviart needs it with the symmetric gradient: there is no Korn inequality without
/// (Hansbo and Larson 2003). clamped_in_x = false: the clamped edges hold the component y alone.
Eigen::SparseMatrix<double> jump_form(const VectorSpace& space, double weight, bool clamped_in_x = true);

}  // namespace antilock
