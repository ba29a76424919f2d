#pragma once
#include <Eigen/Core>
#include <memory>

#include "antilock/exact/exact_solution.hpp"

namespace antilock {

/// The exact solution at one point. Sigma is the interface of body and layer.
struct ExactPoint {
  double value = 0;
  Eigen::Vector2d gradient = {0, 0};  ///< on Sigma: the body's side
  double layer_stress = 0;            ///< epsilon^-2 d/dy u for y <= 0; d/dy u for y > 0
};

/// The exact solution, tabulated row by row with fast sine transforms and interpolated in between.
/// It serves for errors on whole meshes, where sums of the series at every point would take longer
/// than the solve.
///
/// Its errors were measured against ExactSolution: in the interior, next to Sigma, next to Gamma_C
/// (the contact boundary) and around the ends of contact, for epsilon in {1, .3, 1e-1, ..., 1e-4,
/// 1e-6, 1e-20, 0} and loads of waves 1 to 8. The largest errors are:
/// - value: 6e-9;
/// - gradient: 4e-6 of its maximum, and 5e-4 within 1e-4 of an end of contact;
/// - layer_stress: 1e-6, and 1e-4 near an end of contact at small epsilon. The layer stress jumps
///   at an end of contact. Within 2e-4 of this jump the table has the value of neither side.
///
/// The table takes about 0.1 s to build and 30 MB. One point takes 0.1 to 0.5 microseconds.
class ExactTable {
 public:
  /// `finest_cells`, a power of two, is the number of cells along Gamma_C and in the rows next to
  /// it. 2^10 cells take about a hundredth of the time. Throws Error for another number, and if the
  /// load has a wave number above 32.
  explicit ExactTable(const ExactSolution& exact, int finest_cells = 1 << 14);

  double value(double x, double y) const;
  Eigen::Vector2d gradient(double x, double y) const;  ///< on Sigma: the body's side
  double layer_stress(double x, double y) const;       ///< for y <= 0, else Error
  /// Returns value, gradient and layer stress together, in little more time than one of them.
  ExactPoint at(double x, double y) const;

 private:
  struct Grid;
  std::shared_ptr<const Grid> grid_;
};

}  // namespace antilock
