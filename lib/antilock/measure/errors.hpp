#pragma once
#include <Eigen/Core>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "antilock/exact/exact_table.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// A vector field: a function of x and y with two components, or one of x, y and z with three.
class VectorField {
 public:
  VectorField() = default;
  template <class Function>
  requires(!std::is_same_v<Function, VectorField> &&
           (std::is_invocable_v<Function&, double, double> ||
            std::is_invocable_v<Function&, double, double, double>)) VectorField(Function f) {
    if constexpr (MayBeEmpty<Function>)
      if (!f) return;  // an empty function is an empty field
    if constexpr (std::is_invocable_v<Function&, double, double, double>)
      value_ = std::move(f);
    else
      value_ = [f = std::move(f)](double x, double y, double) mutable {
        const Eigen::Vector2d in_plane = f(x, y);
        return Eigen::Vector3d(in_plane(0), in_plane(1), 0);
      };
  }
  /// Returns the three components; the third is 0 in the plane.
  Eigen::Vector3d operator()(double x, double y, double z = 0) const { return value_(x, y, z); }
  explicit operator bool() const { return static_cast<bool>(value_); }

 private:
  std::function<Eigen::Vector3d(double, double, double)> value_;
};

/// A reference solution u, against which errors are measured: its values at a point
/// (dimensionless).
struct Reference {
  Field value;
  VectorField gradient;
  /// epsilon^-2 d/dy u in the layer, in space epsilon^-2 d/dz u; its limit at epsilon = 0.
  Field layer_stress;
  /// Returns value, gradient and layer stress at once, which may be faster. Above the layer the
  /// stress that it returns has no meaning. This function may be empty; then the three functions
  /// above are called. In space it is not called.
  std::function<ExactPoint(double x, double y)> at = {};
  /// Returns value, gradient and layer stress at a point x of the plane. The stress is valid only
  /// if `in_layer` is true or the function `at` is given.
  ExactPoint known(const Eigen::Vector2d& x, bool in_layer) const;
};

/// Returns the tabulated exact solution as a reference. The table must outlive it.
Reference reference(const ExactTable& table);

/// Absolute errors u_h - u; the names say the norm.
struct Errors {
  double max_at_unknowns = 0;  ///< at the unknowns: vertices (P1) or edge midpoints (CR)
  /// L-infinity, sampled at the points of the lattice of order 4 of every cell, corners included:
  /// 15 on a triangle, 25 on a quadrilateral, 35 on a tetrahedron.
  double max = 0;
  double l2 = 0;
  double h1 = 0;  ///< broken H1: sqrt(sum over triangles of |grad|^2 + L2^2)
  /// The energy norm |.|_a^epsilon of Remark 4 of [SR04] (cited in
  /// problem/variational_inequality.hpp) for (23) and (24) with s = 1; a stiffness s of the scene's
  /// layer is not taken into account. The stiff part is computed from p, which is finite at epsilon
  /// = 0. For (22), (25) and without a layer it is the norm of the gradient. On quadrilaterals p is
  /// taken as bilinear between the two by two points of its rows, or as constant for one point.
  double energy = 0;
  /// T: the error of each triangle in the energy norm. Their squares add up to the square of
  /// `energy`.
  Eigen::VectorXd by_triangle;
};

/// Returns the errors of a solution. epsilon is that of the scene. Throws Error for sizes that do
/// not fit.
Errors measure_errors(const Space& space, const Solution& solution, double epsilon,
                      const Reference& reference);

/// Returns the least-squares slope of log(error) against log(h), and NaN where an error or an h is
/// not positive. Throws Error for fewer than two pairs and for lists of different lengths.
double slope(const std::vector<double>& h, const std::vector<double>& errors);

/// Returns the energy J(u) = a(u, u) / 2 - L(u) + j(u). The stiff part of a(u, u) is computed as
/// sum_j c_j m_j p_j^2, c_j the compliance of row j of B; j(u) is friction_energy
/// (problem/bounds.hpp). Throws Error for sizes that do not fit.
double energy(const VariationalInequality& problem, const Solution& solution);

}  // namespace antilock
