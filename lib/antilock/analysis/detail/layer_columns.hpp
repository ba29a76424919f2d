#pragma once
#include <vector>

#include "antilock/analysis/detail/interface_line.hpp"
#include "antilock/core/matrix.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The discretisation of the layer by columns, one below each edge of Sigma, in R rows of equal
/// height. In x a function is a polynomial of the degree of u_h on each edge, in y it is affine on
/// each row. Its unknowns are n values on each of the R + 1 lines between the rows, from Sigma
/// down. The forms of the scaled layer are Kronecker products of matrices in y and in x:
///
///     A1 = diag(depth) x a_x,   B = difference x value,   M = weight / R on each row.
///
/// `depth` is the trapezoidal rule. d_y v is the difference of two lines over the height; its
/// square is summed at the ends of the edges for P1, and at Gauss's points for a higher degree.
/// Both sums are not less than the integrals (section 3 of tutorials/guides/locking_loss.md).
struct LayerColumns {
  int rows = 1;            ///< R
  SparseMatrix a_x;        ///< n x n: s int v' w' on Sigma
  RowMatrix value;         ///< values at the points where d_y v is summed, degree + 1 per edge
  Eigen::VectorXd weight;  ///< of these points: s times the quadrature weight
  RowMatrix difference;    ///< R x (R + 1): (v(upper line) - v(lower line)) / height
  Eigen::VectorXd depth;   ///< R + 1 weights of the trapezoidal rule on [-1, 0]
};

/// Returns the columns for the layer (stiffness s) that `space` has below Sigma.
LayerColumns layer_columns(const Space& space, const InterfaceLine& sigma, double epsilon,
                           double s);

/// The load of the layer at a quadrature point of u_h, as a load on the columns.
struct ColumnLoad {
  const std::vector<int>* edge;  ///< of InterfaceLine::edges: the one above the point
  int row;                       ///< of the columns
  double lower_share;            ///< of the line below the row, by which v is interpolated in y
  Eigen::VectorXd force;         ///< per unknown of the edge
};

/// Returns the load f of the layer at all quadrature points of its triangles.
std::vector<ColumnLoad> column_loads(const Space& space, const InterfaceLine& sigma, int rows,
                                     const Field& f);

/// Returns the part of A1 (N x N) that the layer has in the rows of Sigma. It is summed over the
/// triangles of the layer with a corner on Sigma: all of these rows' entries. The coefficients of
/// (d_x v)^2 and (d_y v)^2 are `stiffness`.
SparseMatrix layer_form_at(const InterfaceLine& sigma, const Space& space,
                           const Eigen::Vector2d& stiffness);

}  // namespace antilock
