#pragma once
#include <functional>

#include "antilock/exact/truth.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"

namespace antilock::tutorial {

/// The load sum_k c_k 2 sin(k pi x) cos(pi y / 2), of L2 norm |c|: the modes m = 1 of LoadModes, as a SineLoad (the
/// cosine by its Taylor polynomial of degree 12, to 1e-8).
SineLoad load_of_modes(const Eigen::VectorXd& c);

/// One method with contact: the error |u - u_h| in the energy seminorm under load_of_modes(c), against the truth.
class ErrorUnderContact {
 public:
  ErrorUnderContact(const Method& method, int cells, double epsilon);
  double operator()(const Eigen::VectorXd& c);

 private:
  Discretisation on_;
  double epsilon_;
  SceneSweep sweep_;
};

/// A maximum of `error` on the unit sphere by ascent: gradient by differences, the step doubled after a success and
/// halved after a failure, from each start. The largest found: a lower bound of the supremum, no more.
double ascend(const std::function<double(const Eigen::VectorXd&)>& error, const std::vector<Eigen::VectorXd>& starts,
              int steps = 6);

/// What the ascent finds for one method, over load_of_modes of four waves, from one arch and from the sum of one and two.
double worst_found_in_contact(const Method& method, int cells, double epsilon);

}  // namespace antilock::tutorial
