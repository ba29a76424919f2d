// The formulas of a scene, asked before there is a mesh: on grids that share few places, so that a pole is met.
#include "antilock/io/detail/scene_checks.hpp"

namespace antilock {

void sample_load(const Field& f) {
  for (const int n : {100, 120, 128})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) f(static_cast<double>(i) / n, static_cast<double>(j) / n);
}

void sample_gap(const Profile& gap, double from, double to) {
  for (const int n : {1000, 3840, 4096})
    for (int i = 0; i <= n; ++i) gap(from + (to - from) * i / n);
}

}  // namespace antilock
