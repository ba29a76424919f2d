#pragma once
#include <Eigen/Core>
#include <memory>

#include "antilock/exact/exact_solution.hpp"

namespace antilock {

/// What ExactTable knows of one point.
struct ExactPoint {
  double value = 0;
  Eigen::Vector2d gradient = {0, 0};  ///< on Sigma: the body's side
  double layer_stress = 0;            ///< where y <= 0; above, d/dy u
};

/// The exact solution, tabulated row by row with fast sine transforms and interpolated in between: for the error of
/// whole meshes, where summing the series at every point would take longer than the solve.
///
/// Measured against the sums of ExactSolution, at points of the bulk, next to Sigma, next to Gamma_C and around the
/// ends of contact, epsilon in {1, .3, 1e-1, ..., 1e-4, 1e-6, 1e-20, 0}, loads of waves 1 to 8, absolute:
/// value 6e-9 everywhere; gradient 4e-6 of its largest, 5e-4 within 1e-4 of an end of contact; layer_stress 1e-6,
/// 1e-4 near an end of contact at small epsilon, where it jumps (and lies on neither side within 2e-4 of the jump).
/// About 0.1 s to build, 0.1 to 0.5 microseconds a point, 30 MB.
class ExactTable {
 public:
  /// `finest_cells`, a power of two, along Gamma_C and in rows next to it; fewer for a quick look, about a hundredth of
  /// the time with 2^10. Throws Error for another number, and if the load has a wave number beyond 32.
  explicit ExactTable(const ExactSolution& exact, int finest_cells = 1 << 14);

  double value(double x, double y) const;
  Eigen::Vector2d gradient(double x, double y) const;  ///< on Sigma: the body's side
  double layer_stress(double x, double y) const;       ///< for y <= 0, else Error
  ExactPoint at(double x, double y) const;             ///< all three, for little more than one of them

 private:
  struct Grid;
  std::shared_ptr<const Grid> grid_;
};

}  // namespace antilock
