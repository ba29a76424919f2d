#include "antilock/solve/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// A bound that is off its piece: a force by more than round-off, a value by anything. (A value off by round-off costs
/// a step of the descent, which stays finite. Forces that are 0 but for round-off would be let go of in ever other
/// sets.)
struct Move {
  int bound;
  Piece to;          ///< the piece beyond that end
  double end;        ///< of the piece, where its value has left it
  double reached{};  ///< the part of the way at which its value comes there
};

Equilibrium equilibrium(ContactSystem& system, const Stairs& stairs, const Pieces& pieces) {
  std::vector<char> held(pieces.size());
  Eigen::VectorXd given(stairs.count());
  for (int i = 0; i < stairs.count(); ++i) {
    held[i] = is_active(pieces[i]) ? 1 : 0;
    given(i) = stairs.given(i, pieces[i]);
  }
  return system.solve(held, given);
}

/// The bounds whose forces have left their pieces, or (`held` = false) those whose values have.
std::vector<Move> moves(const Stairs& stairs, const Pieces& pieces, const Equilibrium& now,
                        const std::vector<int>& place, bool held) {
  std::vector<Move> moves;
  for (int i = 0; i < stairs.count(); ++i) {
    if (is_active(pieces[i]) != held) continue;
    const double value = held ? now.lambda(i) : now.v(place[i]);
    const auto [low, high] = stairs.found(i, pieces[i]);
    const double noise = held ? now.round_off(i) : 0;
    const bool under = value<low - noise, over = value> high + noise;
    if (under || over)  // too little force: v must rise
      moves.push_back({i, stairs.next(i, pieces[i], held == under), under ? low : high});
  }
  return moves;
}

/// v goes towards w, as far as contact.hpp says; `beyond` leave their pieces there.
void descend(const ContactSystem& system, std::vector<Move>& beyond, const Eigen::VectorXd& w, Eigen::VectorXd& v,
             Pieces& pieces) {
  const Eigen::VectorXd way = w - v;
  const std::vector<int>& place = system.bounded();
  for (Move& m : beyond) {
    const double all = way(place[m.bound]), share = (m.end - v(place[m.bound])) / all;
    m.reached = all != 0 && share > 0 ? std::min(share, 1.0) : 0;  // 0 where it is no number, so that the loop ends
  }
  std::sort(beyond.begin(), beyond.end(), [](const Move& a, const Move& b) { return a.reached < b.reached; });
  const double first = beyond.front().reached, lowest = (1 - first) * (1 - first) * system.square(way);
  Eigen::VectorXd next;
  double part = 1;
  for (std::size_t stopped = beyond.size();; part = beyond[stopped - 1].reached) {
    next = v + part * way;
    for (const Move& m : beyond)
      if (m.reached <= part) next(place[m.bound]) = m.end;
    if (part == first || system.square(w - next) < lowest) break;
    stopped = std::max<std::size_t>(stopped / 2, 1);
  }
  for (const Move& m : beyond)
    if (m.reached <= part) pieces[m.bound] = m.to;
  v = std::move(next);
}

}  // namespace

ContactAnswer solve_contact(ContactSystem& system, const Stairs& stairs, const std::optional<Pieces>& start,
                            int max_steps) {
  Pieces pieces = stairs.there_are(start ? *start : system.nested_start(stairs, max_steps));
  std::set<Pieces> lowest;  // of all pieces whose lowest point is on them
  Eigen::VectorXd v;
  for (int steps = 1;; ++steps) {
    Equilibrium now = equilibrium(system, stairs, pieces);
    std::vector<Move> wrong = moves(stairs, pieces, now, system.bounded(), false);
    const bool on_them = wrong.empty();
    if (on_them) wrong = moves(stairs, pieces, now, system.bounded(), true);
    if (wrong.empty() || (on_them && !lowest.insert(pieces).second)) {
      for (int i = 0; i < stairs.count(); ++i) now.lambda(i) = stairs.whole_force(i, pieces[i], now.lambda(i));
      return {std::move(now.v), std::move(now.lambda), std::move(pieces), steps};
    }
    if (steps >= max_steps)
      throw NotConverged(fmt::format("contact: {} of {} contact conditions still violated after {} steps", wrong.size(),
                                     stairs.count(), steps),
                         static_cast<double>(wrong.size()) / stairs.count(), steps);
    if (on_them) {
      for (const Move& m : wrong) pieces[m.bound] = m.to;
      v = std::move(now.v);
      continue;
    }
    if (v.size() == 0) v = now.v;  // the descent starts with no way to go: all that are beyond go to their ends
    descend(system, wrong, now.v, v, pieces);
  }
}

Pieces start_by_halves(const Stairs& stairs, ContactSystem& coarse, int max_steps) {
  const int count = stairs.count();
  const auto second = [](const Eigen::VectorXd& of_all) {
    return Eigen::VectorXd(of_all(Eigen::seqN(1, of_all.size() / 2, 2)));
  };
  Stairs fewer{second(stairs.lower), second(stairs.upper), second(stairs.bears), second(stairs.force)};
  // where the others bear nothing, one bears its own force and half of what each neighbour gives up
  for (int i = 0; i < count && stairs.bears.size() > 0; i += 2)
    for (const int beside : {i / 2 - 1, i / 2})
      if (beside >= 0 && beside < fewer.count() && std::isfinite(stairs.bears(i)))
        fewer.bears(beside) += 0.5 * stairs.bears(i);
  const Pieces pieces = solve_contact(coarse, fewer, std::nullopt, max_steps).pieces;
  Pieces start;
  for (int i = 0; i < count; ++i)
    start.push_back(
        agreed(pieces[std::min(i / 2, fewer.count() - 1)], pieces[std::clamp((i - 1) / 2, 0, fewer.count() - 1)]));
  return stairs.there_are(std::move(start));
}

}  // namespace antilock
