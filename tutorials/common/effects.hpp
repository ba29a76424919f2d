#pragma once
#include <string>
#include <vector>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// A scene from question to answer by Crouzeix-Raviart and the active set, and what each step took (seconds).
struct Run {
  Run(const Scene& scene, TriangleMesh mesh);
  Discretisation on;
  VariationalInequality problem;
  Solution solution;
  double energy = 0, contact_from = 1, assemble_seconds = 0, solve_seconds = 0;

  /// The largest |u - truth| at the contact unknowns.
  double error_on_contact(const Truth& truth) const;
};

/// What a scene costs: its name, triangles, unknowns, factorisations, solves, contact, corrections, assemble_s,
/// solve_s, and the smallest and the largest u.
extern const std::vector<std::string> cost_columns;
std::vector<Entry> costs(const std::string& name, const Run& run);

/// One model of the layer on gmsh's mesh of this many cells: its name, unknowns, mesh_s, assemble_s, solve_s,
/// error_on_contact, energy, contact_from.
extern const std::vector<std::string> model_columns;
std::vector<Entry> model(const std::string& name, const Scene& scene, int cells, const Truth& truth);

/// Prints the models, and claims that each is within the error of its mesh and of its model from the exact
/// solution. What it returns is the model's error: how far the limit is from the exact solution on Gamma_C.
double judge_models(const Table& models, const Exact& exact, const Exact& limit, int cells, Report& report);

/// The largest difference of two columns in a row.
double most_apart(const Table& table, const std::string& one, const std::string& other);

/// The structured mesh with its layer pressed to the thickness epsilon.
TriangleMesh pressed_mesh(int cells, double epsilon);

}  // namespace antilock::tutorial
