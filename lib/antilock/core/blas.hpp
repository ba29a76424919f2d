#pragma once
#include <string>

namespace antilock {

/// The library of dense linear algebra that the sparse factorisations use. They spend most of their
/// time in its kernels. The order of summation of the kernels determines the last digits of a
/// solution.
struct Blas {
  /// The name with the version, such as "OpenBLAS 0.3.21"; "unknown" where it is not OpenBLAS.
  std::string name = "unknown";
  /// The kernels in use, such as "Haswell" (OPENBLAS_CORETYPE chooses others); empty if unknown.
  std::string kernel;
  int threads = 0;  ///< the largest number of threads; 0 if unknown
  /// Kernels for wider vectors that this CPU can execute, although OpenBLAS does not use them.
  /// OpenBLAS recognises CPUs by model number, and uses older kernels on a CPU that is newer than
  /// itself. Empty where no wider ones are known.
  std::string wider;
};
Blas blas();

/// Sets the number of threads. Does nothing if the BLAS is not OpenBLAS.
void set_blas_threads(int threads);

}  // namespace antilock
