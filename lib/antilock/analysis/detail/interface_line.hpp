#pragma once
#include <utility>
#include <vector>

#include "antilock/space/space.hpp"

namespace antilock {

/// Sigma, the interface of body and layer, with the n unknowns of a conforming element on it. They
/// are numbered from left to right: "place" is this number.
struct InterfaceLine {
  std::vector<int> dof;    ///< n values: the unknown of the space at each place
  std::vector<int> place;  ///< per unknown of the space: its place, or -1 off Sigma
  Eigen::VectorXd x;       ///< n values, ascending
  /// Per edge of Sigma, from left to right: the places of its degree + 1 unknowns, ascending.
  std::vector<std::vector<int>> edges;
  double length = 0;  ///< the sum of the lengths of the edges

  int size() const { return static_cast<int>(dof.size()); }
  /// The degree of u_h on an edge. (That of the element may be higher: a bubble is 0 there.)
  int degree() const { return static_cast<int>(edges.front().size()) - 1; }
  double left_end(const std::vector<int>& edge) const { return x(edge.front()); }
  double edge_length(const std::vector<int>& edge) const {
    return x(edge.back()) - x(edge.front());
  }
};

/// Returns Sigma of a space on a mesh with a layer below y = 0.
InterfaceLine interface_line(const Space& space);

/// Returns the interval of the ascending `points` in which x is: the index of its left end, and the
/// share of the way to its right end, from 0 to 1. x outside of all intervals is moved to the
/// nearest end.
std::pair<int, double> interval_of(const Eigen::VectorXd& points, double x);

/// Returns the piecewise linear function with the values y at the ascending `points`, at x. It is
/// constant beyond the first and the last point.
double piecewise_linear(const Eigen::VectorXd& points, const Eigen::VectorXd& y, double x);

/// The degree + 1 basis functions of a conforming element on an edge of Sigma, which is
/// parametrised by s from 0 (left) to 1 (right). A row per point, a column per unknown.
struct EdgeBasis {
  Eigen::MatrixXd value;
  Eigen::MatrixXd slope;  ///< derivatives with respect to s
};

/// Evaluates the basis at the points s.
EdgeBasis edge_basis(const Element& element, const Eigen::VectorXd& s);

}  // namespace antilock
