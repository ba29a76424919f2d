#include "antilock/solve/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// Moves of whole sets without progress before single ones: as Judice and Pires have it. One to ten serve alike.
constexpr int patience = 5;

struct Move {
  int bound;
  Piece to;
};

std::vector<Move> moves(const Stairs& stairs, const Pieces& pieces, const Equilibrium& now) {
  std::vector<Move> moves;
  for (int i = 0; i < stairs.count(); ++i) {
    const bool held = is_held(pieces[i]);
    const double value = held ? now.lambda(i) : now.v(i);
    const auto [low, high] = stairs.found(i, pieces[i]);
    const bool under = value<low - now.round_off(i), over = value> high + now.round_off(i);
    if (under || over) moves.push_back({i, stairs.next(i, pieces[i], held == under)});  // too little force: v must rise
  }
  return moves;
}

}  // namespace

ContactAnswer solve_contact(ContactSystem& system, const Stairs& stairs, const std::optional<Pieces>& start,
                            int max_steps) {
  bool nested = !start;
  Pieces pieces = stairs.there_are(nested ? system.nested_start(stairs, max_steps) : *start);
  std::vector<char> held(pieces.size());
  Eigen::VectorXd given(stairs.count());
  std::set<Pieces> tried;  // by single moves, since the count has fallen last
  std::size_t fewest = pieces.size() + 1;
  for (int steps = 1, left = patience;; ++steps) {
    for (int i = 0; i < stairs.count(); ++i) {
      held[i] = is_held(pieces[i]) ? 1 : 0;
      given(i) = stairs.given(i, pieces[i]);
    }
    Equilibrium now = system.solve(held, given);
    const std::vector<Move> wrong = moves(stairs, pieces, now);
    const bool fewer = wrong.size() < fewest;
    left = fewer ? patience : left - 1;
    if (fewer) fewest = wrong.size(), tried.clear();
    if (wrong.empty() || (left <= 0 && nested && !tried.insert(pieces).second)) {
      for (int i = 0; i < stairs.count(); ++i) now.lambda(i) = stairs.whole_force(i, pieces[i], now.lambda(i));
      return {std::move(now.v), std::move(now.lambda), std::move(pieces), steps};
    }
    if (steps >= max_steps)
      throw NotConverged(fmt::format("contact: {} of {} contact conditions still violated after {} steps", wrong.size(),
                                     stairs.count(), steps),
                         static_cast<double>(wrong.size()) / stairs.count(), steps);
    if (left <= 0 && !nested) {
      nested = true, left = patience, fewest = pieces.size() + 1;
      pieces = stairs.there_are(system.nested_start(stairs, max_steps));
      continue;
    }
    for (std::size_t k = 0; k < (left > 0 ? wrong.size() : 1); ++k) pieces[wrong[k].bound] = wrong[k].to;
  }
}

Pieces start_by_halves(const Stairs& stairs, ContactSystem& coarse, int max_steps) {
  const int count = stairs.count();
  std::vector<int> second;
  for (int i = 1; i < count; i += 2) second.push_back(i);
  Stairs fewer = stairs.of(second);
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
