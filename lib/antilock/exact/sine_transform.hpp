#pragma once
#include <Eigen/Core>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// The functions compute sums of sines and cosines on the points x_j = j / n by fast transforms
/// (FFTW's DST-I and DCT-I), n a power of two. Vectors have n + 1 entries, indexed by the wave
/// number k or by the point j; a sine series has zeros at both ends.
void points_from_modes(Eigen::VectorXd& v);  ///< v_k -> sum_k v_k sin(k pi x_j), in place
void modes_from_points(Eigen::VectorXd& v);  ///< the inverse, in place
void cosine_points(Eigen::VectorXd& v);      ///< v_k -> sum_k v_k cos(k pi x_j), k = 0..n, in place

}  // namespace antilock
