#pragma once
#include <string>

namespace antilock {

/// The library of dense linear algebra under the sparse factors. Its kernels are most of a factor's seconds, and their
/// order of summation decides the last digits of an answer.
struct Blas {
  std::string name = "unknown";  ///< with its version, "OpenBLAS 0.3.21"; "unknown" where it is not OpenBLAS
  std::string kernel;            ///< the kernels in use, "Haswell" (OPENBLAS_CORETYPE chooses others); empty if unknown
  int threads = 0;               ///< at most so many; 0 if unknown
  /// Kernels for wider vectors, which this CPU executes: OpenBLAS knows CPUs by model number, and gives one that is
  /// younger than itself older kernels. Empty where nothing wider is known.
  std::string wider;
};
Blas blas();

/// As many threads from now on; nothing happens where the BLAS is not OpenBLAS.
void set_blas_threads(int threads);

}  // namespace antilock
