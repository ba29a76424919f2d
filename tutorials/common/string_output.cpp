#include "common/string_output.hpp"

#include <cmath>
#include <numbers>

#include "antilock/study/table.hpp"

namespace antilock::tutorial {
namespace {

using std::numbers::pi;
constexpr double amplitude = 10 / (4 * pi * pi);  // of the string without a floor

/// Where an increasing or decreasing function changes its sign between low and high.
template <class Function>
double zero(const Function& f, double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (f(low) * f(middle) <= 0 ? high : low) = middle;
  }
  return low;
}

/// Two nodes at 1/3 and 2/3: K is a quarter of the plane. The curves of equal energy are ellipses around the free string;
/// the smallest one that reaches K touches it at u.
void write_projection(const std::filesystem::path& path) {
  const Eigen::Matrix2d a = 3 * (Eigen::Matrix2d() << 2, -1, -1, 2).finished();
  const double height = amplitude * std::sin(2 * pi / 3);
  const Eigen::Vector2d free(height, -height), touching((a * free)(0) / a(0, 0), 0);
  const double distance = std::sqrt((touching - free).dot(a * (touching - free)));
  Table table({"kind", "name", "label", "x", "y"});
  const auto add = [&](const char* kind, const char* name, const Eigen::Vector2d& at, const std::string& label = "") {
    table.add({kind, name, label, at.x(), at.y()});
  };
  const auto level = [&](const char* name, double size) {  // a point set { v : |v - free|_a = size }
    // the inverse of the factor U of A = U' U, so that |back w|_A = |w|
    const double u11 = std::sqrt(a(0, 0)), u12 = a(0, 1) / u11, u22 = std::sqrt(a(1, 1) - u12 * u12);
    const Eigen::Matrix2d back = (Eigen::Matrix2d() << 1 / u11, -u12 / (u11 * u22), 0, 1 / u22).finished();
    for (int i = 0; i <= 120; ++i)
      add("line", name, free + size * distance * back * Eigen::Vector2d(std::cos(i * pi / 60), std::sin(i * pi / 60)));
  };
  const auto dot = [&](const char* name, const Eigen::Vector2d& at) {
    for (int i = 0; i < 24; ++i)
      add("fill", name, at + 0.007 * Eigen::Vector2d(std::cos(i * pi / 12), std::sin(i * pi / 12)));
  };
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-0.16, -0.53), {0.64, 0.2}}) add("page", "", corner);
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(0, 0), {0.6, 0}, {0.6, 0.16}, {0, 0.16}})
    add("fill", "body", corner);
  level("axis half", 0.62);
  level("axis more", 1.25);
  level("sigma", 1);
  for (const Eigen::Vector2d& end : {Eigen::Vector2d(-0.14, 0), {0.6, 0}}) add("arrow", "axis u1", end);
  for (const Eigen::Vector2d& end : {Eigen::Vector2d(0, -0.5), {0, 0.18}}) add("arrow", "axis u2", end);
  for (const Eigen::Vector2d& end : {touching, Eigen::Vector2d(touching + Eigen::Vector2d(0, 0.11))})
    add("arrow", "contact", end);
  dot("clamped", free);
  dot("contact", touching);
  add("label", "", {0.13, 0.09}, "$K$");
  add("label", "axis", {0.6, -0.03}, "$u_1$");
  add("label", "axis", {-0.03, 0.17}, "$u_2$");
  add("label", "axis", free + Eigen::Vector2d(0, -0.035), "without the floor");
  add("label", "contact", touching + Eigen::Vector2d(0.025, -0.03), "$u$");
  add("label", "contact", touching + Eigen::Vector2d(0.025, 0.09), "$λ$");
  table.write(path);
}

}  // namespace

double string_touches_from(double depth) {
  return zero([&](double z) { return std::sin(z) - z * std::cos(z) + depth / amplitude; }, 4, 6) / (2 * pi);
}

double string_shape(double x) {
  const double z = 2 * pi * string_touches_from(0);
  return 2 * pi * x >= z ? 0 : amplitude * (std::sin(2 * pi * x) - 2 * pi * x * std::cos(z));
}

double contact_starts(const Eigen::VectorXd& lambda) {
  for (Eigen::Index i = 0; i < lambda.size(); ++i)
    if (lambda(i) > 0) return static_cast<double>(i + 1) / static_cast<double>(lambda.size() + 1);
  return 1;
}

double string_error(const Eigen::VectorXd& u) {
  double error = 0;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    error =
        std::max(error, std::abs(u(i) - string_shape(static_cast<double>(i + 1) / static_cast<double>(u.size() + 1))));
  return error;
}

void write_string(const std::filesystem::path& out, const std::vector<Eigen::VectorXd>& guesses,
                  const Eigen::VectorXd& lambda) {
  const int n = static_cast<int>(lambda.size());
  const double h = 1.0 / (n + 1);
  Table shapes({"x", "free", "u", "exact", "pressure"}), steps({"x", "first", "second", "third", "last"});
  for (int i = -1; i <= n; ++i) {
    const auto at = [&](const Eigen::VectorXd& v) { return i < 0 || i == n ? 0.0 : v(i); };
    const auto guess = [&](std::size_t k) { return at(guesses[std::min(k, guesses.size() - 1)]); };
    const double x = (i + 1) * h;
    shapes.add({x, guess(0), at(guesses.back()), string_shape(x), at(lambda) / h});
    steps.add({x, guess(0), guess(1), guess(2), at(guesses.back())});
  }
  shapes.write(out / "shapes.csv");
  steps.write(out / "active_sets.csv");
  write_projection(out / "projection.csv");
}

}  // namespace antilock::tutorial
