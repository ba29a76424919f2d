#pragma once

// Of the OpenMP library that CHOLMOD is linked to; the <omp.h> that a compiler finds may be that of another.
extern "C" int omp_get_max_active_levels();
extern "C" void omp_set_max_active_levels(int levels);

namespace antilock {

/// CHOLMOD's own loops run on one thread while this lives; a BLAS with threads of its own keeps them.
///
/// CHOLMOD 3 shares the assembly of every supernode among four OpenMP threads, on any number of cores, and the four wait
/// for each other at every loop, which is over in microseconds. Measured on two cores, the least wall seconds of a
/// factor (P1, the membrane with its layer): 5.5 against 6.7 ms at 1/h = 64, 31 against 39 at 128; where other programs
/// want the cores as well, the four cost up to ten times the factor.
class LoopsOnOneThread {
 public:
  LoopsOnOneThread() : levels_(omp_get_max_active_levels()) { omp_set_max_active_levels(0); }
  ~LoopsOnOneThread() { omp_set_max_active_levels(levels_); }
  LoopsOnOneThread(const LoopsOnOneThread&) = delete;
  LoopsOnOneThread& operator=(const LoopsOnOneThread&) = delete;

 private:
  int levels_;
};

}  // namespace antilock
