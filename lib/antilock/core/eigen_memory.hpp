#pragma once
#include <Eigen/Core>

// Vectors and matrices pass between this library and its user. One side allocates them, the other
// one frees them, and vectorised code relies on their alignment. Eigen chooses allocation and
// alignment by the instruction set for which a file is compiled, so that -march=native on only one
// side ends in a crash. This header makes both the same in every file: memory comes from the
// system's malloc, aligned to 16 bytes. CMake's target antilock::antilock defines
// EIGEN_MAX_ALIGN_BYTES and EIGEN_MALLOC_ALREADY_ALIGNED for this. A user who compiles without
// CMake must define them. Debian's Eigen 5 defines EIGEN_HEAP_ALIGN_BYTES. Its allocator is the
// same for every instruction set and ignores EIGEN_MALLOC_ALREADY_ALIGNED.
static_assert(EIGEN_MAX_ALIGN_BYTES == 16 && EIGEN_MAX_STATIC_ALIGN_BYTES == 16
#ifndef EIGEN_HEAP_ALIGN_BYTES
                  && EIGEN_MALLOC_ALREADY_ALIGNED == 1
#endif
              ,
              "antilock: this file is compiled with another memory layout of Eigen than the "
              "library, which would crash; add -DEIGEN_MAX_ALIGN_BYTES=16 "
              "-DEIGEN_MALLOC_ALREADY_ALIGNED=1, as the CMake target antilock::antilock does");
