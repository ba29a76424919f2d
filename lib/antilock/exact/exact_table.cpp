#include "antilock/exact/exact_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "antilock/core/error.hpp"
#include "antilock/exact/exact_solution_data.hpp"
#include "antilock/exact/sine_transform.hpp"

// In the coordinates of the true layer (22), Y = y in the body and Y = epsilon y in the layer, the
// solution is as smooth at a distance d = Y + epsilon from Gamma_C as its worst point there allows:
// like r^(3/2) around the ends of contact, r the distance to them. So rows are graded by d, each
// row has the points in x that its d asks for, and cubic Hermite interpolation within a fixed
// fraction of d errs by a fixed fraction of what the field itself does at the scale d.

namespace antilock {
namespace {

constexpr double steps_per_distance = 12;  // rows within a distance d
constexpr double smooth_step = 0.06;  // between rows and points, in units of 1 / (k pi) of the load
constexpr int most_waves = 32;

// What is known at one point: with slopes in x and y, all that Hermite interpolation wants.
struct Node {
  double u, u_x, p, p_y;
};

struct Row {
  double y;
  int cells;                // in x
  std::vector<Node> nodes;  // cells + 3: one more beyond each side, by odd reflection
};

// Cubic Hermite on a cell of width h, at the fraction t.
struct Hermite {
  Hermite(double t, double h)
      : value0((1 + 2 * t) * (1 - t) * (1 - t)),
        slope0(h * t * (1 - t) * (1 - t)),
        value1(1 - value0),
        slope1(-h * t * t * (1 - t)) {}
  double operator()(double v0, double s0, double v1, double s1) const {
    return value0 * v0 + slope0 * s0 + value1 * v1 + slope1 * s1;
  }
  double value0, slope0, value1, slope1;
};

// Cubic Lagrange through four equidistant points, -1, 0, 1, 2, at the fraction t: weights and their
// derivatives.
struct Lagrange {
  explicit Lagrange(double t)
      : value{-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
              -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6},
        slope{-(3 * t * t - 6 * t + 2) / 6, (3 * t * t - 4 * t - 1) / 2,
              -(3 * t * t - 2 * t - 2) / 2, (3 * t * t - 1) / 6} {}
  double value[4], slope[4];
};

// A row at x: u and its x-slope by Hermite; p, which may jump at the ends of contact, from its
// values alone. Of the five only what is asked for is computed: whole meshes are measured point by
// point.
struct Sample {
  Sample(const Row& row, double x) : h(1.0 / row.cells) {
    const int j = std::min(int(x * row.cells), row.cells - 1);
    t = x * row.cells - j;
    node = &row.nodes[j];  // nodes[j] sits at (j - 1) h
  }
  double u() const { return Hermite(t, h)(node[1].u, node[1].u_x, node[2].u, node[2].u_x); }
  double u_x() const {
    const Node &left = node[1], &right = node[2];
    return 6 * t * (1 - t) * (right.u - left.u) / h + (1 - t) * (1 - 3 * t) * left.u_x +
           t * (3 * t - 2) * right.u_x;
  }
  double p() const { return along(Lagrange(t).value, &Node::p); }
  double p_y() const { return along(Lagrange(t).value, &Node::p_y); }
  double p_x() const {
    Lagrange weight(t);
    for (double& slope : weight.slope) slope /= h;
    return along(weight.slope, &Node::p);
  }

 private:
  double along(const double (&weight)[4], double Node::*part) const {
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += weight[i] * (node[i].*part);
    return sum;
  }
  const Node* node;
  double t, h;
};

// A series on the points j / n: a wave k beyond n looks there like one below, k mod 2n folded at n.
Eigen::VectorXd fold(const Eigen::VectorXd& modes, int n, double reflected) {
  Eigen::VectorXd folded = Eigen::VectorXd::Zero(n + 1);
  for (Eigen::Index from = 0; from < modes.size(); from += 2 * n) {
    const Eigen::Index left = modes.size() - from, up = std::min<Eigen::Index>(left, n + 1),
                       down = std::min<Eigen::Index>(left - up, n - 1);
    folded.head(up) += modes.segment(from, up);
    if (down > 0)
      folded.segment(n - down, down) += reflected * modes.segment(from + n + 1, down).reverse();
  }
  return folded;
}

Row sampled(const SineRow& series, double y, int cells) {
  const auto sines = [&](const Eigen::VectorXd& modes) {
    Eigen::VectorXd points = fold(modes, cells, -1);
    points_from_modes(points);
    return points;
  };
  const Eigen::VectorXd u = sines(series.u), p = sines(series.p), p_y = sines(series.p_y);
  Eigen::VectorXd slopes = series.u;
  for (Eigen::Index k = 0; k < slopes.size(); ++k) slopes(k) *= series.a(k);
  Eigen::VectorXd u_x = fold(slopes, cells, 1);
  cosine_points(u_x);
  Row row{y, cells, std::vector<Node>(cells + 3)};
  for (int j = 0; j <= cells; ++j) row.nodes[j + 1] = {u(j), u_x(j), p(j), p_y(j)};
  row.nodes.front() = {-u(1), u_x(1), -p(1), -p_y(1)};
  row.nodes.back() = {-u(cells - 1), u_x(cells - 1), -p(cells - 1), -p_y(cells - 1)};
  return row;
}

// The y of rows from one end to the other, steps growing with the distance from Gamma_C; unit:
// physical length of y
// = 1.
std::vector<double> graded_rows(double from, double to, double gamma_c, double unit, double finest,
                                double longest) {
  std::vector<double> rows{from};
  while (rows.back() < to) {
    const double distance = (rows.back() - gamma_c) * unit;
    const double step = std::min(std::max(distance / steps_per_distance, finest), longest);
    rows.push_back(rows.back() + std::min(step / unit, 1.0));
  }
  rows.back() = to;
  return rows;
}

}  // namespace

struct ExactTable::Grid {
  double epsilon;
  std::vector<Row> layer, body;

  // The rows below and above, and where between them.
  struct Between {
    Sample below, above;
    double t, h;
    double scale;  // u_y = scale p
    Hermite in_y() const { return {t, h}; }
    double value() const {
      return in_y()(below.u(), scale * below.p(), above.u(), scale * above.p());
    }
    double p() const { return in_y()(below.p(), below.p_y(), above.p(), above.p_y()); }
    double u_x() const {
      return in_y()(below.u_x(), scale * below.p_x(), above.u_x(), scale * above.p_x());
    }
  };
  Between between(double x, double y) const {
    const Eigen::Vector2d at = inside_domain(x, y);
    const std::vector<Row>& rows = at.y() >= 0 ? body : layer;
    const auto after = std::upper_bound(rows.begin() + 1, rows.end() - 1, at.y(),
                                        [](double y, const Row& row) { return y < row.y; });
    const Row &below = after[-1], &above = *after;
    const double h = above.y - below.y;
    return {Sample(below, at.x()), Sample(above, at.x()), (at.y() - below.y) / h, h,
            at.y() >= 0 ? 1 : epsilon * epsilon};
  }
};

ExactTable::ExactTable(const ExactSolution& exact, int finest_cells) {
  if (finest_cells < 1 || !std::has_single_bit(static_cast<unsigned>(finest_cells)))
    throw Error(fmt::format("exact table: {} cells; accepted: a power of two", finest_cells));
  const ExactSolution::Data& data = exact.data();
  const int waves = data.load.empty() ? 1 : data.load.back().k();  // the largest
  if (waves > most_waves)
    throw Error(
        fmt::format("exact table: load with wave number k = {}; accepted: up to {} (sum the series "
                    "of ExactSolution instead)",
                    waves, most_waves));
  const double epsilon = data.epsilon;
  const double longest = smooth_step / (waves * std::numbers::pi);
  const double finest = 1.0 / finest_cells;  // between rows, next to Gamma_C
  const auto cells = [&](double distance) {
    const double wanted = std::max(64.0 * waves, std::min(16 / distance, double(finest_cells)));
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(wanted))));
  };
  Grid grid{epsilon, {}, {}};
  const double unit = std::max(epsilon, finest);  // a thinner layer is one step
  for (const double y : graded_rows(-1, 0, -1, unit, finest, longest))
    grid.layer.push_back(sampled(layer_row(data, y), y, cells((1 + y) * epsilon)));
  for (const double y : graded_rows(0, 1, -epsilon, 1, finest, longest))
    grid.body.push_back(sampled(body_row(data, y), y, cells(y + epsilon)));
  grid_ = std::make_shared<const Grid>(std::move(grid));
}

double ExactTable::value(double x, double y) const { return grid_->between(x, y).value(); }

Eigen::Vector2d ExactTable::gradient(double x, double y) const { return at(x, y).gradient; }

double ExactTable::layer_stress(double x, double y) const {
  if (inside_domain(x, y).y() > 0)
    throw Error(fmt::format(
        "exact table: layer stress at ({}, {}), in the body; accepted: -1 <= y <= 0", x, y));
  // Sigma belongs to the body's rows, where p is the same.
  return grid_->between(x, y).p();
}

ExactPoint ExactTable::at(double x, double y) const {
  const Grid::Between rows = grid_->between(x, y);
  const double p = rows.p();
  return {rows.value(), {rows.u_x(), rows.scale * p}, p};
}

}  // namespace antilock
