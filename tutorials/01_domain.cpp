// Figures 1 and 2. The domain, and the change of variable that makes a thin layer thick.
//
// Run: 01_domain                    the layer drawn with thickness 0.15; a moment
// Run: 01_domain --epsilon 0.3
//
// What the pictures show. An elastic body Omega+ = (0,1) x (0,1), clamped on Gamma+ (both sides and the top). A thin
// stiff layer Omega_epsilon^- = (0,1) x (-epsilon,0) is grafted onto its lower side Sigma; the layer is clamped on its
// two ends Gamma_D,epsilon^- and may come into contact with a rigid obstacle on Gamma_C,epsilon. The thinner the layer
// the stiffer it is: its Lame coefficients are those of the body divided by epsilon.
//
// The equations, (21) and in variational form (22): with mu_epsilon = 1 in the body and 1/epsilon in the layer,
//
//     u in K_epsilon,   int mu_epsilon grad u . grad (v - u) >= int f (v - u)   for all v in K_epsilon
//
// Two difficulties at once: the domain degenerates and the coefficient explodes. The change of variable y~ = y/epsilon
// in the layer removes the first. There dy = epsilon dy~ and d/dy = epsilon^-1 d/dy~, so that
//
//     int_{thin} 1/epsilon |grad u|^2 = int_{unit} |d/dx u|^2 + epsilon^-2 |d/dy~ u|^2                            (23)
//
// and what is left of the thickness is one factor in front of one form, on a domain that does not change (Figure 2).

#include <fmt/format.h>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// What the parts of a picture are called: Figure 1 with epsilon in the names, Figure 2 without.
struct Names {
  std::string layer, ends, contact, depth, note;
};

// A drawing as a table: kind, name (its first word chooses the colour), label, x, y; a row a corner.
// figures/pictures/domain.cpp reads it.
void write_drawing(const std::filesystem::path& path, double depth, const Names& names) {
  write_file(path, [&](std::ostream& out) {
    out << "kind,name,label,x,y\n";
    const auto points = [&](const char* kind, const char* name, std::vector<Eigen::Vector2d> corners) {
      for (const auto& corner : corners) out << kind << ',' << name << ",," << corner.x() << ',' << corner.y() << '\n';
    };
    const auto label = [&](const char* name, const std::string& text, double x, double y) {
      out << "label," << name << ",\"" << text << "\"," << x << ',' << y << '\n';
    };
    const double obstacle = -depth - 0.17;
    points("page", "", {{-0.45, obstacle - 0.2}, {1.45, 1.32}});
    points("fill", "body", {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    points("fill", "layer", {{0, -depth}, {1, -depth}, {1, 0}, {0, 0}});
    points("line", "sigma", {{0, 0}, {1, 0}});
    points("line", "contact", {{0, -depth}, {1, -depth}});
    points("line", "layer_clamped left", {{0, 0}, {0, -depth}});
    points("line", "layer_clamped right", {{1, 0}, {1, -depth}});
    points("line", "clamped", {{0, 0}, {0, 1}, {1, 1}, {1, 0}});
    points("obstacle", "obstacle", {{0, obstacle}, {1, obstacle}});
    points("arrow", "", {{0.2, -depth}, {0.2, -depth - 0.13}});
    points("dimension", "axis width", {{0, 1.2}, {1, 1.2}});
    points("dimension", "axis height", {{1.3, 0}, {1.3, 1}});
    points("dimension", "axis depth", {{1.3, -depth}, {1.3, 0}});
    points("arrow", "axis x", {{-0.38, obstacle - 0.1}, {-0.2, obstacle - 0.1}});
    points("arrow", "axis y", {{-0.38, obstacle - 0.1}, {-0.38, obstacle + 0.08}});

    label("", "$Ω^+$", 0.5, 0.5);
    label("", names.layer, 0.5, -0.5 * depth);
    if (!names.note.empty()) label("axis", names.note, 0.5, -0.5 * depth - 0.12);
    label("sigma", "$Σ$", 0.8, 0.06);
    for (const auto& [x, y] : {std::pair{0.5, 1.07}, {-0.09, 0.5}, {1.09, 0.5}}) label("clamped", "$Γ^+$", x, y);
    for (const double x : {-0.13, 1.13}) label("layer_clamped", names.ends, x, -0.5 * depth);
    label("contact", names.contact, 0.55, -depth - 0.075);
    label("", "$n$", 0.25, -depth - 0.09);
    label("axis", "rigid obstacle", 0.5, obstacle - 0.1);
    label("axis", "1", 0.5, 1.25);
    label("axis", "1", 1.35, 0.5);
    label("axis", names.depth, 1.35, -0.5 * depth);
    label("axis", "$x$", -0.16, obstacle - 0.1);
    label("axis", "$y$", -0.38, obstacle + 0.12);
  });
}

// The mesh of Figure 1: that of Figure 2 with its layer squashed to the thickness epsilon.
TriangleMesh squashed(TriangleMesh mesh, double epsilon) {
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.vertices(v, 1) < 0) mesh.vertices(v, 1) *= epsilon;
  return mesh;
}

// a(v, v) with the stiff part, wherever it is: in a1 for (22), in B and the compliance for (23).
double energy_form(const VariationalInequality& problem, const Eigen::VectorXd& v) {
  const double rest = v.dot(problem.a1 * v);
  if (problem.b.rows() == 0) return rest;
  const Eigen::VectorXd strain = problem.b * v;
  return rest + strain.dot(problem.m.asDiagonal() * strain) / problem.compliance;
}

void domain(const tutorial::Options& options, tutorial::Report& report) {
  const double epsilon = options.epsilon;
  if (!(epsilon >= 0.05 && epsilon <= 0.6))
    throw Error(fmt::format("--epsilon {}: a layer to look at; accepted 0.05 to 0.6", epsilon));

  // 1. The two drawings.
  report.stage("drawings");
  write_drawing(options.out / "figure1.csv", epsilon, {"$Ω_ε^−$", "$Γ_{D,ε}^−$", "$Γ_{C,ε}$", "$ε$", ""});
  write_drawing(options.out / "figure2.csv", 1, {"$Ω^−$", "$Γ_D^−$", "$Γ_C$", "1", "$y ↦ y/ε$"});

  // 2. Both problems on the same triangles: (22) on the thin layer, (23) on the unit layer.
  report.stage("assemble (22) and (23)");
  const TriangleMesh unit = unstructured_mesh(options.cells), thin = squashed(unit, epsilon);
  const Space unit_space(unit, p1()), thin_space(thin, p1());
  const auto scaled = assemble(Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}), unit_space);
  const auto original = assemble(Scene(Body{paper_load}, ThinLayer{epsilon}, UnilateralContact{}), thin_space);

  // 3. The same function on both: its nodal values do not change, only the places of the vertices.
  Eigen::VectorXd v(unit_space.size());
  for (int i = 0; i < v.size(); ++i) {
    const auto p = unit_space.points().row(i);
    v(i) = std::sin(3 * p.x()) * std::exp(p.y()) + p.x() * p.y();
  }
  const double before = energy_form(original, v), after = energy_form(scaled, v);

  // 4. And the same solution of the inequality.
  report.stage("solve both");
  const Solution u_thin = active_set(original), u_unit = active_set(scaled);
  const double apart = (u_thin.u - u_unit.u).lpNorm<Eigen::Infinity>(), size = u_unit.u.lpNorm<Eigen::Infinity>();
  report.finish();

  fmt::print("\n  epsilon = {}, {} unknowns in both\n", epsilon, unit_space.free_count());
  fmt::print("  {:<38}{:>16}{:>16}{:>12}\n", "", "thin, (22)", "unit, (23)", "difference");
  fmt::print("  {:<38}{:16.10f}{:16.10f}{:12.1e}\n", "a(v, v) of a test function", before, after, after - before);
  fmt::print("  {:<38}{:16.10f}{:16.10f}{:12.1e}\n\n", "largest u of the solution", u_thin.u.maxCoeff(),
             u_unit.u.maxCoeff(), apart);

  // The verdict. Equal up to round-off: sums of some 1e4 terms, and a solver that stops at 1e-10.
  report.claim(std::abs(after - before) <= 1e-12 * before,
               fmt::format("the change of variable keeps the form: a(v, v) agrees to {:.0e}",
                           std::abs(after - before) / before));
  report.claim(apart <= 1e-8 * size, fmt::format("and the solution: (22) and (23) agree to {:.0e}", apart / size));
}

// Three things to try:
// - --epsilon 0.05: the triangles of the thin layer become needles, 20 times as long as high; those of Figure 2 never
// do.
// - replace v by a function of x alone: after the change of variable epsilon^-2 multiplies nothing.
// - write (21) on the unit layer: which normal derivative carries the epsilon^-2 on Sigma and on Gamma_C?
int main(int argc, char** argv) {
  tutorial::Options options;
  options.epsilon = 0.15;
  return tutorial::run(argc, argv, "01_domain", "Figures 1 and 2: the domain and the change of variable", options,
                       domain);
}
