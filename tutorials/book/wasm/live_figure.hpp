#pragma once
#include <string>
#include <vector>

#include "antilock/exact/exact_table.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/scene_sweep.hpp"

namespace antilock::book {

/// The meshes of the live figure.
enum class LiveMesh { structured, unstructured, moved, layered };
/// `amount`: how far the vertices of `moved` go, in units of h; no other mesh reads it.
TriangleMesh live_mesh(LiveMesh kind, int cells, double amount);

/// What the page writes beside the pictures; everything is dimensionless but the
/// milliseconds.
struct LiveNumbers {
  double largest_on_contact = 0;  ///< of u_h on Gamma_C
  double ridge = 0;               ///< of the exact u there
  double error = 0;               ///< max |u_h - u| at the unknowns
  double milliseconds = 0;        ///< of the solve alone
  double unknowns = 0, corrections = 0, factorisations = 0;
  double touching = 0, contact = 0;  ///< unknowns in contact, of all on Gamma_C
  double touches_from = 1;           ///< the least x in contact; 1 where nothing touches
};

/// The exact solution at one epsilon as the page needs it: 2^10 points along Gamma_C.
struct LiveExact {
  explicit LiveExact(double epsilon);
  double epsilon;
  ExactSolution solution;
  ExactTable table;
};

/// One half of the live figure: the paper's problem with one element on one mesh, asked at
/// any epsilon.
class LiveFigure {
 public:
  LiveFigure(LiveMesh kind, int cells, double amount, const Element& element);

  /// Solves (23), or (24) at epsilon = 0, and compares with the exact solution.
  LiveNumbers solve(double epsilon, const LiveExact& exact);
  /// What run_scene would say of the layer of the last solve: empty, or one sentence.
  const std::string& warning() const { return warning_; }
  /// x, y, u of the three corners of every triangle, in the order of the mesh: 9 numbers
  /// per triangle.
  std::vector<float> picture() const;
  /// x, u_h and 1 (in contact) or 0 at every unknown of Gamma_C, by x: 3 numbers per
  /// unknown.
  std::vector<double> trace() const;
  const Solution& solution() const { return solution_; }

 private:
  Space space_;
  SceneSweep sweep_;
  Solution solution_;
  std::string warning_;
};

/// x and the exact u at `points` places along Gamma_C: 2 numbers per place.
std::vector<double> ridge_line(const LiveExact& exact, int points);

/// One epsilon of the round-off exhibit (P1, structured): the largest error at the unknowns
/// by the split form, and by the sum A1 + epsilon^-2 B' M B; 1 where the sum was refused.
struct RoundOff {
  double split = 0, summed = 0;
};
RoundOff round_off(int cells, double epsilon, const LiveExact& exact);

}  // namespace antilock::book
