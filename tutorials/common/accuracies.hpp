#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

// What chapter 22 leaves out of its page.

/// The layer in contact under a load chosen here: "paper", f = 10 sin(2 pi x), or "bump", 400 exp(-r^2 / (2 0.02^2))
/// around (0.3, 0.6).
Scene load_scene(const std::string& load, double epsilon);

/// load, epsilon, method; asked and of what; unknowns, those quoted one level before (0: none), seconds of all levels;
/// quantity ("bound": proved, "error": against the exact solution) and its value, relative to |u|_a; levels; of_asked,
/// of_quoted: value / asked, unknowns / quoted; of_bound: value / bound.
extern const std::vector<std::string> accuracy_columns;
/// The bound of an answer, and for the paper's load its error.
Table accuracy_rows(const std::string& load, const Exact& exact, const std::string& method, double asked, Quantity of,
                    const CertifiedSolution& found);
/// The certificate of a scene on a mesh.
Certificate certified(const Scene& scene, const TriangleMesh& mesh);
/// The same certificate on gmsh's uniform meshes from 1/8 to 1/finest; the seconds add up, without gmsh's own.
Table on_uniform_meshes(const std::string& load, const Exact& exact, int finest);

/// Prints what was asked and what it cost; writes answers.csv, price_list.csv and .md, p1.csv and the meshes of the
/// picture.
void show_accuracies(const std::filesystem::path& out, const Table& answers, const Table& uniform, const Table& p1);

}  // namespace antilock::tutorial
