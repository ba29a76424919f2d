#pragma once
// Scenes of random numbers that are many decades apart, and the parts of a second assembly with 60
// digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock::hard {

using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>,
                                           boost::multiprecision::et_off>;
using RealVector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Basis and derivatives by barycentric coordinates, from the formulas of P1, CR and P2.
inline RealVector basis(const std::string& name, const Eigen::Matrix<Real, 3, 1>& l) {
  RealVector v(name == "P2" ? 6 : 3);
  for (int i = 0; i < 3; ++i) {
    const Real a = l((i + 1) % 3), b = l((i + 2) % 3);
    v(i) = name == "P1" ? l(i) : name == "CR" ? Real(1 - 2 * l(i)) : Real(l(i) * (2 * l(i) - 1));
    if (name == "P2") v(3 + i) = 4 * a * b;
  }
  return v;
}
inline RealMatrix derivatives(const std::string& name, const Eigen::Matrix<Real, 3, 1>& l) {
  RealMatrix d = RealMatrix::Zero(name == "P2" ? 6 : 3, 3);
  for (int i = 0; i < 3; ++i) {
    d(i, i) = name == "P1" ? Real(1) : name == "CR" ? Real(-2) : Real(4 * l(i) - 1);
    if (name != "P2") continue;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    d(3 + i, j) = 4 * l(k);
    d(3 + i, k) = 4 * l(j);
  }
  return d;
}

/// The gradients of the barycentric coordinates of triangle t, and twice its area.
struct RealTriangle {
  Eigen::Matrix<Real, 3, 2> gradient;
  Real twice_area;
};
inline RealTriangle real_triangle(const TriangleMesh& mesh, int t) {
  Eigen::Matrix<Real, 3, 2> x;
  for (int i = 0; i < 3; ++i) x.row(i) = mesh.vertices.row(mesh.triangles(t, i)).cast<Real>();
  RealTriangle triangle;
  triangle.twice_area =
      (x(1, 0) - x(0, 0)) * (x(2, 1) - x(0, 1)) - (x(2, 0) - x(0, 0)) * (x(1, 1) - x(0, 1));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    triangle.gradient(i, 0) = (x(j, 1) - x(l, 1)) / triangle.twice_area;
    triangle.gradient(i, 1) = (x(l, 0) - x(j, 0)) / triangle.twice_area;
  }
  return triangle;
}

enum class SceneOutcome { right, warned, refused, quietly_wrong, unknown };

struct Assessment {
  SceneOutcome outcome = SceneOutcome::right;
  double error = 0;  ///< of u, relative to its largest entry
  std::string text;
};

/// u of `s` against the exact one, empty where that is not known. A warning is right where its
/// number is not below the error.
inline Assessment compare_with_exact(const Solution& s, const RealVector& exact) {
  if (exact.size() == 0) return {SceneOutcome::unknown, 0, "no set of contact settles"};
  Real off = 0, size = 0;
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    off = std::max<Real>(off, abs(exact(i) - Real(s.u(i))));
    size = std::max<Real>(size, abs(exact(i)));
  }
  const auto error = static_cast<double>(size > 0 ? Real(off / size) : off);
  const std::string text =
      fmt::format("{}, claimed {:.1e}, warning \"{}\"", s.solver, s.error, s.warning);
  if (error <= 1e-6)
    return {s.warning.empty() ? SceneOutcome::right : SceneOutcome::warned, error, text};
  const bool said = !s.warning.empty() && std::max(s.error, worst_violation(s.kkt)) >= error;
  return {said ? SceneOutcome::warned : SceneOutcome::quietly_wrong, error, text};
}

/// How often each outcome comes among `count` random cases, none of which may be wrong without a
/// word. `assess_case(seed)` solves one of them.
template <class AssessCase>
std::map<SceneOutcome, int> count_outcomes(unsigned count, const AssessCase& assess_case) {
  std::map<SceneOutcome, int> outcomes;
  for (unsigned seed = 0; seed < count; ++seed) {
    const Assessment assessment = assess_case(seed);
    ++outcomes[assessment.outcome];
    EXPECT_NE(assessment.outcome, SceneOutcome::quietly_wrong)
        << "seed " << seed << ": " << assessment.error << " " << assessment.text;
  }
  return outcomes;
}

/// Random numbers that are the same with every library.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  double uniform(double from, double to) { return from + (to - from) * (engine_() / 4294967296.0); }
  double decades(double from, double to) { return std::pow(10, uniform(from, to)); }
  int one_of(int n) { return static_cast<int>(engine_() % n); }

 private:
  std::mt19937 engine_;
};

/// The square of the mesh stretched, its inner vertices moved: no row of an element matrix sums to
/// 0 by luck.
inline void deform(TriangleMesh& mesh, int cells, bool layer, Dice& dice) {
  const double stretch = dice.uniform(0.3, 3);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const double y = mesh.vertices(v, 1);
    const bool inside = mesh.vertices(v, 0) > 0 && mesh.vertices(v, 0) < 1 && y < 1 && y > -1;
    if (inside) mesh.vertices(v, 0) += dice.uniform(-0.2, 0.2) / cells;
    if (inside && y != 0) mesh.vertices(v, 1) += dice.uniform(-0.2, 0.2) / cells;
    if (!layer) mesh.vertices(v, 1) *= stretch;
    mesh.vertices(v, 0) *= stretch;
  }
}

}  // namespace antilock::hard
