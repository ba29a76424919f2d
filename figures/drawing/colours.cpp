#include "drawing/colours.hpp"

#include <algorithm>

namespace antilock::figures {

Colour viridis(double t) {
  // matplotlib's table, every 17th of 256 entries
  static constexpr std::array<Colour, 16> samples{{{0.267004, 0.004874, 0.329415},
                                                   {0.282656, 0.100196, 0.422160},
                                                   {0.277134, 0.185228, 0.489898},
                                                   {0.253935, 0.265254, 0.529983},
                                                   {0.221989, 0.339161, 0.548752},
                                                   {0.190631, 0.407061, 0.556089},
                                                   {0.163625, 0.471133, 0.558148},
                                                   {0.139147, 0.533812, 0.555298},
                                                   {0.120565, 0.596422, 0.543611},
                                                   {0.134692, 0.658636, 0.517649},
                                                   {0.208030, 0.718701, 0.472873},
                                                   {0.327796, 0.773980, 0.406640},
                                                   {0.477504, 0.821444, 0.318195},
                                                   {0.647257, 0.858400, 0.209861},
                                                   {0.824940, 0.884720, 0.106217},
                                                   {0.993248, 0.906157, 0.143936}}};
  const double place = std::clamp(t, 0.0, 1.0) * (samples.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(place), samples.size() - 2);
  const double rest = place - static_cast<double>(first);
  Colour mixed;
  for (int i = 0; i < 3; ++i)
    mixed[i] = (1 - rest) * samples[first][i] + rest * samples[first + 1][i];
  return mixed;
}

}  // namespace antilock::figures
