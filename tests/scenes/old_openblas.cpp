// For LD_PRELOAD: an OpenBLAS that is older than this CPU. It says that it fell back, unless it was
// told which kernels to take.
#include <cstdlib>

extern "C" const char* openblas_get_corename() {
  const char* told = std::getenv("OPENBLAS_CORETYPE");
  return told ? told : "Prescott";
}
