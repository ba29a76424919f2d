#include "common/stopped_early.hpp"

namespace antilock::tutorial {

Table uzawa_on_its_way(const std::string& method, const VariationalInequality& problem, const Solution& early,
                       const Solution& full, const std::function<double(const Solution&)>& error) {
  Table table({"method", "quantity", "steps", "error"});
  table.add({method, "accurate enough: stop", early.counters.contact, error(early)});
  PenaltyFactor factor = PenaltyFactor::moderate(problem, {}, ContactRoad::dense);  // one for every stop
  Solution u;
  double error_of_u = 0;
  for (double energy = 1e-3; energy > 1e-17; energy /= 4) {
    UzawaOptions options;
    options.enough = {energy, 1e-3};
    const int before = u.counters.contact;
    // a run that took as many steps as the full one has come to its end, as it will for every smaller energy
    if (before < full.counters.contact) u = uzawa(problem, factor, options);
    if (u.counters.contact != before) error_of_u = error(u);  // else it is the same u
    table.add({method, "error of the iterate", u.counters.contact, error_of_u});
    if (u.counters.contact < full.counters.contact)
      table.add({method, "its algebraic part", u.counters.contact, (u.u - full.u).cwiseAbs().maxCoeff()});
  }
  return table;
}

}  // namespace antilock::tutorial
