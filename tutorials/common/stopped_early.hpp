#pragma once
#include <functional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// Uzawa's two errors on its way, for one method: method, quantity, steps, error. `early` is where it was stopped,
/// `full` where it ends by itself; `error` measures the error of a solution.
Table uzawa_on_its_way(const std::string& method, const VariationalInequality& problem, const Solution& early,
                       const Solution& full, const std::function<double(const Solution&)>& error);

}  // namespace antilock::tutorial
