#pragma once
#include <string>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

enum class SummedFactor { cholesky, lu };  ///< CHOLMOD; UMFPACK

/// How the naive solver ended. None of them says that the answer is right.
enum class NaiveEnd {
  settled,   ///< the contact set reproduced itself
  cycled,    ///< a contact set came back: it would go round for ever
  refused,   ///< the factorisation gave up, or returned something that is not finite
  step_cap,  ///< max_steps reached
};
std::string to_string(NaiveEnd end);

/// An answer that nobody has vouched for: solution.kkt is the report in split form, as it is, and no level of trust was
/// applied. p is compliance^-1 B u, where u has lost the digits that p is made of.
struct NaiveAnswer {
  Solution solution;
  NaiveEnd end = NaiveEnd::settled;
};

/// An exhibit, to be compared against: what most codes do. A1 + compliance^-1 B' M B summed in double precision,
/// factored in every step of a primal-dual active set that starts from no contact. The sum forgets A1 digit by digit as
/// compliance falls; use active_set instead. Throws Error at compliance = 0, where the sum does not exist.
NaiveAnswer naive_summed_solve(const VariationalInequality& problem, SummedFactor kind, int max_steps = 100);

}  // namespace antilock
