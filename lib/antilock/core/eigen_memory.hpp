#pragma once
#include <Eigen/Core>

// Vectors and matrices go from this library to its user and back: one side allocates them, the other frees them, and
// fast code relies on where they lie. Eigen chooses both by the instruction set that a file is compiled for, so that
// -march=native on one side alone ends in a crash. Here they are the same for all: memory of the system's malloc,
// aligned to 16 bytes. CMake's target antilock::antilock carries the two definitions; whoever compiles by hand gives
// them.
static_assert(
    EIGEN_MAX_ALIGN_BYTES == 16 && EIGEN_MAX_STATIC_ALIGN_BYTES == 16 && EIGEN_MALLOC_ALREADY_ALIGNED == 1,
    "antilock: this file is compiled with another memory layout of Eigen than the library, which would crash; "
    "add -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1, as the CMake target "
    "antilock::antilock does");
