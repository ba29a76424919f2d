#pragma once
#include <limits>
#include <optional>

#include "antilock/solve/stairs.hpp"

namespace antilock {

/// v and lambda = S v - q of C bounded values, one of the two given per bound.
struct Equilibrium {
  Eigen::VectorXd v, lambda;  ///< C each
  /// C: what round-off makes of the one that was found. A matrix row of n entries in a system (S + E) v = q + e loses
  /// about sqrt(n) eps of the sum of its terms: 64 eps serves rows of 4096 entries. e moves v by S^-1 e.
  Eigen::VectorXd round_off;
  static constexpr double unit = 64 * std::numeric_limits<double>::epsilon();
};

/// The linear system of a contact problem, S symmetric positive definite (C x C): all unknowns that are not bounded are
/// eliminated from it, once (dense_contact.hpp) or with every set (sparse_contact.hpp).
class ContactSystem {
 public:
  virtual ~ContactSystem() = default;
  /// v_i = given_i where bound i is held, lambda_i = given_i elsewhere; lambda counts from Stairs::force. Throws Error where S is not positive definite.
  virtual Equilibrium solve(const std::vector<char>& held, const Eigen::VectorXd& given) = 0;
  /// A start near the answer: that of a smaller problem of the same kind.
  virtual Pieces nested_start(const Stairs& stairs, int max_steps) = 0;
};

struct ContactAnswer {
  Eigen::VectorXd v, lambda;  ///< C each, lambda the whole force
  Pieces pieces;              ///< C
  int steps = 0;              ///< linear systems solved
};

/// Finds the v that minimises v' S v / 2 - q' v on its stairs: lambda = S v - q, and (v_i, lambda_i) on stair i.
///
///     solve with the pieces as they are
///     a bound that leaves its piece at an end by more than round-off should be on the next piece beyond that end
///     none does: that is the answer
///     the number of such bounds has fallen within the last `patience` steps: move all of them
///     else: move the first of them alone
///
/// (J. J. Judice and F. M. Pires, Computers & Operations Research 21 (1994); K. G. Murty, Opsearch 11 (1974).)
///
/// It ends. Of single moves the last bound, C, moves only while bounds 1, ..., C - 1 are content. Let these be solved for
/// whatever v_C is: then lambda_C is a strictly rising function of v_C, since its slope is at least the Schur complement
/// of S there, which is positive; and the stair falls. So the two meet in one point, and a move of bound C from its piece
/// to the next goes towards that point and never past it: four moves at most. Between two of them bounds 1, ..., C - 1
/// are a smaller problem of the same kind, which ends by induction. Moves of all bounds come between, `patience` at most
/// each time that the number of wrong ones reaches a new minimum, and so fewer than (C + 1) patience in all.
/// In exact arithmetic no set returns among single moves. One that does is a tie by round-off, and is taken as the answer.
///
/// Without a start it begins at the nested one. Where moves of all bounds from a given start come to nothing, it begins
/// again at the nested one: single moves end, but from far away they may take long. Throws NotConverged after max_steps
/// linear systems.
ContactAnswer solve_contact(ContactSystem& system, const Stairs& stairs, const std::optional<Pieces>& start,
                            int max_steps);

/// A start from the answer of `coarse`, the same problem bounded at every second bound only (1, 3, 5, ...): each of the
/// others is on the piece of its two neighbours in the order of the bounds, where they agree.
Pieces start_by_halves(const Stairs& stairs, ContactSystem& coarse, int max_steps);

}  // namespace antilock
