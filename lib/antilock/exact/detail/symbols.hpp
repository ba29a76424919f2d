#pragma once

namespace antilock {

/// Body and layer as seen from Gamma_C in the mode sin(k pi x), a = k pi: the transmission-line formulas.
/// Every member is finite for every 0 <= epsilon <= 1, 0 included. Derivation in symbols.cpp.
struct Symbols {
  Symbols(int k, double epsilon);
  double a;          ///< k pi
  double body;       ///< T = a coth a: the pull of the body on Sigma is G'(0) - T w
  double stiffness;  ///< D_k: lambda_k = D_k c_k - q_k
  double load;       ///< q_k / G'(0)
  double trace;      ///< w_k = trace c_k + lift G'(0): u on Sigma from u on Gamma_C and the load
  double lift;       ///< (see trace)
};

}  // namespace antilock
