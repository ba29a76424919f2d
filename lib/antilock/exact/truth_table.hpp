#pragma once
#include <Eigen/Dense>
#include <memory>

#include "antilock/exact/truth.hpp"

namespace antilock {

/// The truth tabulated row by row with fast sine transforms and interpolated in between: for the error of whole meshes,
/// where summing the series at every point would take longer than the solve. Accuracy 1e-7 or better in value.
class TruthTable {
 public:
  explicit TruthTable(const Truth& truth);
  ~TruthTable();
  TruthTable(TruthTable&&) noexcept;

  double value(double x, double y) const;
  Eigen::Vector2d gradient(double x, double y) const;
  double layer_stress(double x, double y) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace antilock
