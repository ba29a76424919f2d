#include "antilock/exact/exact_solution.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "antilock/core/error.hpp"
#include "antilock/exact/contact_line.hpp"
#include "antilock/exact/exact_solution_data.hpp"
#include "antilock/exact/sine_transform.hpp"

// Both rectangles hold u = 0 on x = 0 and x = 1, so sines in x diagonalise everything but the
// contact condition: mode by mode, body and layer are ordinary differential equations in y, solved
// in closed form (wave.cpp, sine_row.cpp). What is left is one complementarity problem on Gamma_C
// for c(x) = u(x, -1) and the contact pressure lambda,
//     c >= 0,   lambda = D c - q >= 0,   lambda c = 0,
// collocated at x_j = j / N (contact_line.cpp). From c, everything else follows.

namespace antilock {
namespace {

using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

std::vector<LoadResponse> checked_load(const SineLoad& load, int points) {
  std::map<int, std::vector<double>> profiles;
  for (const SineMode& mode : load.modes) {
    if (mode.k < 1 || mode.k > points / 16)
      throw Error(fmt::format(
          "exact solution: load with wave number k = {}; accepted: 1 <= k <= {} on {} points",
          mode.k, points / 16, points));
    if (mode.profile.size() > LoadResponse::max_degree + 1)
      throw Error(
          fmt::format("exact solution: load profile of degree {} at k = {}; accepted: at most {}",
                      mode.profile.size() - 1, mode.k, LoadResponse::max_degree));
    std::vector<double>& sum = profiles[mode.k];
    sum.resize(std::max(sum.size(), mode.profile.size()));
    for (std::size_t m = 0; m < mode.profile.size(); ++m) {
      if (!std::isfinite(mode.profile[m]))
        throw Error(
            fmt::format("exact solution: load coefficient {} at k = {}; accepted: finite numbers",
                        mode.profile[m], mode.k));
      sum[m] += mode.profile[m];
    }
  }
  std::vector<LoadResponse> responses;
  responses.reserve(profiles.size());
  for (auto& [k, profile] : profiles) responses.emplace_back(k, std::move(profile));
  return responses;
}

// c and lambda by modes, without contact or where the obstacle is not reached: c_k = q_k / D_k, as
// many as the load has.
VectorXd free_displacement(const std::vector<LoadResponse>& load, double epsilon) {
  VectorXd c = VectorXd::Zero(load.empty() ? 2 : load.back().k() + 1);
  for (const LoadResponse& f : load) {
    const Symbols symbols(f.k(), epsilon);
    c(f.k()) = symbols.trace * f.pull() / symbols.stiffness;
  }
  return c;
}

// exp(-36 (k/n)^12): 1 to 1e-13 up to k = n / 16, 2e-16 at n. A series whose sum jumps then
// converges fast away from the jump.
VectorXd jump_filter(Eigen::Index size, int n) {
  VectorXd filter(size);
  for (Eigen::Index k = 0; k < size; ++k) filter(k) = std::exp(-36 * std::pow(double(k) / n, 12));
  return filter;
}

void solve_contact(ExactSolution::Data& data) {
  const int n = data.points();
  VectorXd stiffness = VectorXd::Ones(n + 1), load = VectorXd::Zero(n + 1);
  for (int k = 1; k < n; ++k) stiffness(k) = Symbols(k, data.epsilon).stiffness;
  for (const LoadResponse& f : data.load)
    load(f.k()) = Symbols(f.k(), data.epsilon).trace * f.pull();
  ContactLine line = solve_contact_line(stiffness, load);
  data.on_gamma_c = data.displacement = std::move(line.displacement);
  data.stress_gamma_c = data.pressure = std::move(line.pressure);
  modes_from_points(data.on_gamma_c);
  modes_from_points(data.stress_gamma_c);
  data.filter = jump_filter(n + 1, n);
  data.stress_gamma_c.array() *= -data.filter.array();
}

// From Gamma_C to Sigma: w = trace c + lift G'(0), stress = G'(0) - T w.
void lift_to_sigma(ExactSolution::Data& data) {
  const auto size = static_cast<int>(data.on_gamma_c.size());
  data.on_sigma = data.stress_sigma = VectorXd::Zero(size);
  for (const LoadResponse& f : data.load) data.stress_sigma(f.k()) = f.pull();
  for (int k = 1; k < size; ++k) {
    const Symbols symbol(k, data.epsilon);
    data.on_sigma(k) = symbol.trace * data.on_gamma_c(k) + symbol.lift * data.stress_sigma(k);
    data.stress_sigma(k) -= data.filter(k) * symbol.body * data.on_sigma(k);
  }
}

// sum_k v_k sin(k pi x) and sum_k a v_k cos(k pi x), by rotation; started anew every 256 steps to
// keep round-off down.
struct Sums {
  double sine = 0, derivative = 0;
};
Sums sum_series(const VectorXd& v, double x) {
  const double rotate_cos = std::cos(pi * x), rotate_sin = std::sin(pi * x);
  Sums sums;
  double c = 1, s = 0;
  for (Eigen::Index k = 1; k < v.size(); ++k) {
    if (k % 256 == 0) {
      const double half_turns = std::fmod(double(k) * x, 2.0);
      c = std::cos(pi * half_turns);
      s = std::sin(pi * half_turns);
    } else {
      const double turned = c * rotate_cos - s * rotate_sin;
      s = s * rotate_cos + c * rotate_sin;
      c = turned;
    }
    sums.sine += v(k) * s;
    sums.derivative += double(k) * pi * v(k) * c;
  }
  return sums;
}

double between_points(const VectorXd& points, double x) {
  const int n = int(points.size()) - 1;
  const int j = std::min(int(x * n), n - 1);
  const double t = x * n - j;
  return (1 - t) * points(j) + t * points(j + 1);
}

SineRow row_at(const ExactSolution::Data& data, double y) {
  return y >= 0 ? body_row(data, y) : layer_row(data, y);
}

}  // namespace

double SineLoad::operator()(double x, double y) const {
  double sum = 0;
  for (const SineMode& mode : modes) sum += evaluate(mode.profile, y) * std::sin(mode.k * pi * x);
  return sum;
}

SineLoad paper_sine_load() { return {{{2, {10.0}}}}; }

ExactSolution::ExactSolution(const SineLoad& load, double epsilon, bool contact, int log2_points) {
  if (!(epsilon >= 0 && epsilon <= 1))
    throw Error(fmt::format(
        "exact solution: epsilon = {} is out of range; accepted 0 <= epsilon <= 1", epsilon));
  if (log2_points < 6 || log2_points > 20)
    throw Error(fmt::format("exact solution: log2_points = {} is out of range; accepted 6 to 20",
                            log2_points));
  const int n = 1 << log2_points;
  Data data;
  data.epsilon = epsilon;
  data.contact = contact;
  data.load = checked_load(load, n);
  data.on_gamma_c = free_displacement(data.load, epsilon);
  data.stress_gamma_c = VectorXd::Zero(data.on_gamma_c.size());
  data.filter = VectorXd::Ones(data.on_gamma_c.size());
  data.pressure = VectorXd::Zero(n + 1);
  data.displacement = data.on_gamma_c;
  data.displacement.conservativeResizeLike(VectorXd::Zero(n + 1));
  points_from_modes(data.displacement);
  const double round_off = 1e-14 * data.displacement.lpNorm<Eigen::Infinity>();
  if (contact && data.displacement.minCoeff() < -round_off) solve_contact(data);
  lift_to_sigma(data);
  data_ = std::make_shared<const Data>(std::move(data));
}

double ExactSolution::epsilon() const { return data_->epsilon; }

// On Gamma_C itself the points are the solution, and linear in between they keep u >= 0 and the
// zone of contact.
double ExactSolution::value(double x, double y) const {
  const Eigen::Vector2d at = inside_domain(x, y);
  const bool touches = data_->modes() == data_->points();
  if (at.y() == -1 && touches) return between_points(data_->displacement, at.x());
  return sum_series(row_at(*data_, at.y()).u, at.x()).sine;
}

Eigen::Vector2d ExactSolution::gradient(double x, double y) const {
  const Eigen::Vector2d at = inside_domain(x, y);
  const SineRow row = row_at(*data_, at.y());
  const double scale = at.y() >= 0 ? 1 : data_->epsilon * data_->epsilon;
  return {sum_series(row.u, at.x()).derivative, scale * sum_series(row.p, at.x()).sine};
}

double ExactSolution::layer_stress(double x, double y) const {
  const Eigen::Vector2d at = inside_domain(x, y);
  if (at.y() > 0)
    throw Error(fmt::format(
        "exact solution: layer stress at ({}, {}), in the body; accepted: -1 <= y <= 0", x, y));
  if (at.y() == -1) return -pressure(x);
  return sum_series(layer_row(*data_, at.y()).p, at.x()).sine;
}

double ExactSolution::d_xx(double x, double y) const {
  const Eigen::Vector2d at = inside_domain(x, y);
  SineRow row = row_at(*data_, at.y());
  for (Eigen::Index k = 0; k < row.u.size(); ++k)
    row.u(k) *= -row.a(k) * row.a(k) * data_->filter(k);
  return sum_series(row.u, at.x()).sine;
}

double ExactSolution::pressure(double x) const {
  return between_points(data_->pressure, inside_domain(x, -1).x());
}

std::vector<std::pair<double, double>> ExactSolution::contact_zones() const {
  std::vector<std::pair<double, double>> zones;
  if (!data_->contact) return zones;
  const VectorXd& c = data_->displacement;
  const int n = data_->points();
  for (int j = 1; j < n; ++j) {
    if (c(j) > 0) continue;
    if (j > 1 && c(j - 1) <= 0)
      zones.back().second = double(j) / n;
    else
      zones.emplace_back(double(j) / n, double(j) / n);
  }
  // The sides x = 0 and x = 1 are held at u = 0: a zone that reaches their neighbour reaches them.
  if (!zones.empty() && c(1) <= 0) zones.front().first = 0;
  if (!zones.empty() && c(n - 1) <= 0) zones.back().second = 1;
  return zones;
}

double ExactSolution::max_on_contact() const { return data_->displacement.maxCoeff(); }

// With v = 0 and v = 2u in the inequality, a(u, u) = L(u), so J(u) = -L(u) / 2; and
// int f_k u_k dy = int f_k G_k + w_k int f_k sinh(a(1-y)) / sinh(a) = work + w_k G_k'(0); int
// sin^2 = 1/2.
double ExactSolution::energy() const {
  double work = 0;
  for (const LoadResponse& f : data_->load)
    work += (f.work() + data_->on_sigma(f.k()) * f.pull()) / 2;
  return -work / 2;
}

}  // namespace antilock
