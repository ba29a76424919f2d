#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/study/table.hpp"

namespace antilock::tutorial {

// What the pictures of chapter 00 are drawn from.

/// projection.csv: two nodes at 1/3 and 2/3, where K is a quarter of the plane. The curves
/// of equal energy are ellipses around the free string; the smallest one that reaches K
/// touches it at u.
inline void write_projection(const std::filesystem::path& path) {
  using std::numbers::pi, Eigen::Vector2d;
  const Eigen::Matrix2d a = 3 * (Eigen::Matrix2d() << 2, -1, -1, 2).finished();
  const Vector2d free = 10 / (4 * pi * pi) * std::sin(2 * pi / 3) * Vector2d(1, -1),
                 touching((a * free)(0) / a(0, 0), 0);
  const double distance = std::sqrt((touching - free).dot(a * (touching - free)));
  Table table({"kind", "name", "label", "x", "y"});
  const auto add = [&](const char* kind, const char* name, const Vector2d& at,
                       const std::string& label = "") {
    table.add({kind, name, label, at.x(), at.y()});
  };
  const auto level = [&](const char* name,
                         double size) {  // a point set { v : |v - free|_a = size }
    const double u11 = std::sqrt(6),
                 u22 = std::sqrt(4.5);  // A = U' U; by the inverse of U, |back w|_A = |w|
    const Eigen::Matrix2d back =
        (Eigen::Matrix2d() << 1 / u11, 3 / (6 * u22), 0, 1 / u22).finished();
    for (int i = 0; i <= 120; ++i)
      add("line", name,
          free + size * distance * back *
                     Vector2d(std::cos(i * pi / 60), std::sin(i * pi / 60)));
  };
  const auto dot = [&](const char* name, const Vector2d& at) {
    for (int i = 0; i < 24; ++i)
      add("fill", name,
          at + 0.007 * Vector2d(std::cos(i * pi / 12), std::sin(i * pi / 12)));
  };
  const auto shape = [&](const char* kind, const char* name,
                         const std::vector<Vector2d>& corners) {
    for (const Vector2d& corner : corners) add(kind, name, corner);
  };
  shape("page", "", {{-0.16, -0.53}, {0.64, 0.2}});
  shape("fill", "body", {{0, 0}, {0.6, 0}, {0.6, 0.16}, {0, 0.16}});
  for (const auto& [name, size] :
       {std::pair{"axis half", 0.62}, {"axis more", 1.25}, {"sigma", 1.0}})
    level(name, size);
  shape("arrow", "axis u1", {{-0.14, 0}, {0.6, 0}});
  shape("arrow", "axis u2", {{0, -0.5}, {0, 0.18}});
  shape("arrow", "contact", {touching, touching + Vector2d(0, 0.11)});
  dot("clamped", free);
  dot("contact", touching);
  add("label", "", {0.13, 0.09}, "$K$");
  add("label", "axis", {0.6, -0.03}, "$u_1$");
  add("label", "axis", {-0.03, 0.17}, "$u_2$");
  add("label", "axis", free + Vector2d(0, -0.035), "without the floor");
  add("label", "contact", touching + Vector2d(0.025, -0.03), "$u$");
  add("label", "contact", touching + Vector2d(0.025, 0.09), "$λ$");
  table.write(path);
}

/// projection.csv, shapes.csv (the string, with and without the floor, and the pressure of
/// the floor) and active_sets.csv (the first eight guesses and the last), at the nodes
/// x_i = i h.
inline void write_string(const std::filesystem::path& out,
                         const std::vector<Eigen::VectorXd>& guesses,
                         const Eigen::VectorXd& lambda, const Eigen::VectorXd& exact) {
  const Eigen::Index n = lambda.size();
  const double h = 1.0 / static_cast<double>(n + 1);
  Table shapes({"x", "free", "u", "exact", "pressure"});
  Table steps({"x", "first", "second", "third", "fourth", "fifth", "sixth", "seventh",
               "eighth", "last"});
  for (Eigen::Index i = -1; i <= n; ++i) {
    const auto at = [&](const Eigen::VectorXd& v) { return i < 0 || i == n ? 0.0 : v(i); };
    const double x = static_cast<double>(i + 1) * h;
    shapes.add({x, at(guesses.front()), at(guesses.back()), at(exact), at(lambda) / h});
    std::vector<TableEntry> row{x};
    for (std::size_t k = 0; k < 8; ++k)
      row.emplace_back(at(guesses[std::min(k, guesses.size() - 1)]));
    row.emplace_back(at(guesses.back()));
    steps.add(row);
  }
  write_projection(out / "projection.csv");
  shapes.write(out / "shapes.csv");
  steps.write(out / "active_sets.csv");
}

// The exact string of chapter 00, load 10 sin(2 pi x), and where a discrete one touches.

/// Where the exact string comes to lie on a floor at -depth (0 to 0.2): the zero of sin z -
/// z cos z + depth / alpha.
inline double touches_from(double depth) {
  using std::numbers::pi;
  const auto f = [=](double z) {
    return std::sin(z) - z * std::cos(z) + depth * 4 * pi * pi / 10;
  };
  double low = 4, high = 6;
  for (int i = 0; i < 60; ++i)
    (f(low) * f((low + high) / 2) <= 0 ? high : low) = (low + high) / 2;
  return low / (2 * pi);
}

/// The first x_i = i / (n + 1) with a force; 1 without one.
inline double contact_starts(const Eigen::VectorXd& lambda) {
  const auto pushed =
      std::find_if(lambda.begin(), lambda.end(), [](double force) { return force > 0; });
  return static_cast<double>(pushed - lambda.begin() + 1) /
         static_cast<double>(lambda.size() + 1);
}

/// Its free part on a floor at 0: alpha sin(2 pi x) + s x, U of the page.
inline double free_part(double x) {
  using std::numbers::pi;
  return 10 / (4 * pi * pi) *
         (std::sin(2 * pi * x) - 2 * pi * x * std::cos(2 * pi * touches_from(0)));
}

/// The discrete string of so many cells that touches from the node `from` on, at its inner
/// nodes: what the page derives.
inline Eigen::VectorXd discrete_string(int cells, double from) {
  Eigen::VectorXd u(cells - 1);
  for (int i = 1; i < cells; ++i) {
    const double x = i / static_cast<double>(cells);
    u(i - 1) = x < from ? free_part(x) - free_part(from) * x / from : 0;
  }
  return u;
}
/// The exact string at the same nodes: there nothing is to be taken off, since U is 0 where
/// contact starts.
inline Eigen::VectorXd exact_string(int cells) {
  return discrete_string(cells, touches_from(0));
}

}  // namespace antilock::tutorial
