#pragma once
#ifdef ANTILOCK_WITHOUT_CHOLMOD  // the build for the browser says so
#include "antilock/solve/detail/eigen_cholesky.hpp"
#else
#include "antilock/solve/detail/cholmod_cholesky.hpp"
#endif

namespace antilock {

/// The factor of whoever asks for none in particular.
#ifdef ANTILOCK_WITHOUT_CHOLMOD
using DefaultCholesky = EigenCholesky;
#else
using DefaultCholesky = CholmodCholesky;
#endif

}  // namespace antilock
