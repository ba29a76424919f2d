#include "antilock/solve/stairs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd of_some(const Eigen::VectorXd& values, const std::vector<int>& bounds) {
  return values.size() > 0 ? Eigen::VectorXd(values(bounds)) : values;
}

}  // namespace

double Stairs::above(int i) const { return upper.size() > 0 ? upper(i) : infinity; }

double Stairs::most(int i) const { return bears.size() > 0 ? bears(i) : infinity; }

double Stairs::given(int i, Piece piece) const {
  if (is_held(piece)) return piece == Piece::at_lower ? lower(i) : upper(i);
  return whole_force(i, piece, 0) - so_far(i);
}

double Stairs::whole_force(int i, Piece piece, double found) const {
  if (is_held(piece)) return so_far(i) + found;
  return piece == Piece::below ? most(i) : piece == Piece::above ? -most(i) : 0;
}

Stairs::Interval Stairs::found(int i, Piece piece) const {
  switch (piece) {
    case Piece::below:
      return {-infinity, lower(i)};
    case Piece::at_lower:
      return {(is_equation(i) ? -most(i) : 0) - so_far(i), most(i) - so_far(i)};
    case Piece::at_upper:
      return {-most(i) - so_far(i), -so_far(i)};
    case Piece::above:
      return {above(i), infinity};
    default:
      return {lower(i), above(i)};
  }
}

Piece Stairs::next(int i, Piece piece, bool up) const {
  // v rises and lambda falls: a piece without an end that way is the last one
  const auto [low, high] = found(i, piece);
  if (!std::isfinite(is_held(piece) == up ? low : high))
    throw Error(fmt::format("contact: stair {} ends with piece {}; there is none beyond", i, static_cast<int>(piece)));
  if (is_equation(i)) return piece != Piece::at_lower ? Piece::at_lower : up ? Piece::above : Piece::below;
  return static_cast<Piece>(static_cast<int>(piece) + (up ? 1 : -1));
}

Pieces Stairs::there_are(Pieces asked) const {
  if (static_cast<int>(asked.size()) != count())
    throw Error(fmt::format("contact: the start has {} pieces; accepted one per bound, {}", asked.size(), count()));
  for (int i = 0; i < count(); ++i) {
    Piece& piece = asked[i];
    const bool low = std::isfinite(lower(i)), high = std::isfinite(above(i)), gives_way = std::isfinite(most(i));
    if (gives_way && ((piece == Piece::below && low) || (piece == Piece::above && high))) continue;
    if (is_equation(i) || (is_held(piece) && low && !(piece == Piece::at_upper && high)))
      piece = Piece::at_lower;
    else
      piece = is_held(piece) && high ? Piece::at_upper : Piece::between;
  }
  return asked;
}

Stairs Stairs::from(const Eigen::VectorXd& u) const {
  return {lower - u, upper.size() > 0 ? Eigen::VectorXd(upper - u) : upper, bears, force};
}

Stairs Stairs::of(const std::vector<int>& bounds) const {
  return {of_some(lower, bounds), of_some(upper, bounds), of_some(bears, bounds), of_some(force, bounds)};
}

}  // namespace antilock
