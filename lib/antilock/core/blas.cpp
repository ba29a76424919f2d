#include "antilock/core/blas.hpp"

#include <string_view>

// Declared here, and absent with another BLAS: the addresses are null then.
extern "C" {
[[gnu::weak]] char* openblas_get_config();
[[gnu::weak]] char* openblas_get_corename();
[[gnu::weak]] int openblas_get_num_threads();
[[gnu::weak]] void openblas_set_num_threads(int);
}

namespace antilock {
namespace {

/// Bits of a vector for which these kernels of OpenBLAS are written; others than those named here
/// use 128.
int vector_bits(std::string_view kernel) {
  for (const char* wide : {"SkylakeX", "Cooperlake", "SapphireRapids"})
    if (kernel == wide) return 512;
  for (const char* wide :
       {"Sandybridge", "Bulldozer", "Piledriver", "Steamroller", "Excavator", "Haswell", "Zen"})
    if (kernel == wide) return 256;
  return 128;
}

/// The kernels for the widest vectors that this CPU executes; empty on another architecture than
/// x86.
std::string_view widest_here() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
  if (__builtin_cpu_supports("avx")) return "Sandybridge";
#endif
  return "";
}

}  // namespace

Blas blas() {
  if (!openblas_get_config || !openblas_get_corename || !openblas_get_num_threads) return {};
  const std::string_view config =
      openblas_get_config();  // "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH ..."
  Blas found{std::string(config.substr(0, config.find(' ', config.find(' ') + 1))),
             openblas_get_corename(), openblas_get_num_threads(), ""};
  if (const std::string_view widest = widest_here();
      vector_bits(widest) > vector_bits(found.kernel))
    found.wider = widest;
  return found;
}

void set_blas_threads(int threads) {
  if (openblas_set_num_threads) openblas_set_num_threads(threads);
}

}  // namespace antilock
