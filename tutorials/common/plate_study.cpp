#include "common/plate_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/io/writers.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock::tutorial {

double largest_error(const Space& w, const Solution& solution, const PlateTruth& truth) {
  double largest = 0;
  for (int i = 0; i < w.size(); ++i)
    largest = std::max(largest, std::abs(solution.u(i) - truth.deflection(w.points().row(i).norm())));
  return largest;
}

// A constant curvature, $w = x^2 + x y - y^2 / 2$ and $θ = ∇w$ on the rim, no load.
// Each triangle's bending is exact then.
double patch_error(const PlateMethod& method, const TriangleMesh& mesh, double thickness) {
  const Discrete on(method, mesh);
  Plate bent{.thickness = thickness, .load = [](double, double) { return 0.0; }};
  bent.gap = [](double, double) { return std::numeric_limits<double>::infinity(); };
  bent.rim = [](double x, double y) { return x * x + x * y - y * y / 2; };
  bent.rim_slope_x = [](double x, double y) { return 2 * x + y; };
  bent.rim_slope_y = [](double x, double y) { return x - y; };
  const Eigen::VectorXd u = active_set(assemble(bent, on.space)).u;
  double worst = 0;
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const double x = mesh.vertices(i, 0), y = mesh.vertices(i, 1);
    worst =
        std::max({worst, std::abs(u(on.space.theta_x() + i) - 2 * x - y), std::abs(u(on.space.theta_y() + i) - x + y)});
  }
  return worst;
}

// The deflection along the diameter $y = 0$, at the midpoints of the edges there.
static void add_diameter(Table& profile, const PlateMethod& method, const Space& w, const Solution& solution,
                         double thickness) {
  const TriangleMesh& mesh = w.mesh();
  const PlateTruth truth(thickness);
  std::vector<std::pair<double, int>> edges;  // x of the midpoint, edge
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edges(e, 0), b = mesh.edges(e, 1);
    if (std::abs(mesh.vertices(a, 1)) + std::abs(mesh.vertices(b, 1)) < 1e-9)
      edges.emplace_back((mesh.vertices(a, 0) + mesh.vertices(b, 0)) / 2, e);
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& [x, e] : edges) {
    const double mean = (solution.u(mesh.edges(e, 0)) + solution.u(mesh.edges(e, 1))) / 2;
    profile.add({x, method.file, method.deflection.conforming() ? mean : solution.u(e)});
    if (method.file == "p1") profile.add({x, "exact", truth.deflection(std::abs(x))});
  }
}

void draw(const Options& options, const PlateMethod& method, const Space& w, const Solution& solution, Table& profile) {
  add_diameter(profile, method, w, solution, std::sqrt(options.epsilon));
  write_freefem_mesh(options.out / "mesh.freefem.msh", w.mesh());
  write_vtu(options.out / (method.file + ".vtu"), w, solution.u.head(w.size()));
}

void print_plate(const std::filesystem::path& out, const Table& checks, const Table& errors, const Table& profile) {
  checks.print("", 3);
  const double finest = errors.most("rings");
  errors.where("rings", finest).pivot("element", "t", "error").print("largest error of w, by t", 3);
  errors.where_number("t", [](double t) { return t >= 1e-6 && t <= 0.3; }).write(out / "errors.csv");
  profile.pivot("x", "element", "w").write(out / "profile.csv");
}

void judge_plate(const Table& checks, const Table& errors, double h, Report& report) {
  const Table good = checks.where("locks", 0), bad = checks.where("locks", 1);
  report.claim(good.most("patch") < 1e-10 && bad.least("patch") > 0.01,
               "patch test, t = 1 and 1e-3: the cures bend exactly ({:.0e}), P1 does not ({:.2f})", good.most("patch"),
               bad.least("patch"));
  // A locked plate keeps about (t/h)^2 of its deflection, which is near 1.
  const double thin = 0.01 * h;
  const Table locked = errors.where("locks", 1).where_number("t", [&](double t) { return t <= thin; });
  report.claim(locked.least("error") > 0.99, "P1, both shears, t <= h/100: {:.1f} % of the deflection is lost",
               100 * locked.least("error"));
  // Of Kirchhoff's plate an affine function leaves $h^2 |w''| / 8$ over, most at the rim, where $w' = 0$.
  const double bent = -PlateTruth(0).slope(1 - 1e-4) / 1e-4;
  for (const Entry& element : good.entries("element")) {
    const Table own = errors.where("element", element).where_number("t", [](double t) { return t <= 0.1; });
    const Table limit = own.where("t", 0);
    double worst = 0;
    for (const Table& row : own.rows())
      worst = std::max(worst, row.number("error") / (row.number("h") * row.number("h") * std::abs(bent) / 8));
    report.claim(worst < 1, "{}: error of w at most {:.2f} h^2 max|w''| / 8, whatever t <= 0.1 and h", element.text(),
                 worst);
    report.claim(limit.order("error", "h") > 1.5, "{}: at t = 0 it falls like h^{:.2f} (h^2 is expected)",
                 element.text(), limit.order("error", "h"));
    report.claim(own.most("corrections") <= 5, "{}: at most {} corrections", element.text(), own.most("corrections"));
    report.claim(std::abs(own.where("h", h).where("t", 1e-20).number("error") - limit.last("error")) < 1e-9,
                 "{}: t = 1e-20 is t = 0", element.text());
  }
  report.not_judged("t = 0.3 and 1: off the obstacle a rim of a ring or two is left, in which w falls by 1");
}

}  // namespace antilock::tutorial
