#pragma once
#include <filesystem>
#include <string>

#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock::tutorial {

/// Writes what every solved scene leaves behind: mesh.msh, mesh.freefem.msh, solution.csv,
/// solution.vtu and contact.csv.
void write_results(const std::filesystem::path& out, const Space& space, const VariationalInequality& problem,
                   const Solution& solution);

/// Prints how a problem was solved: unknowns, iterations, KKT report, contact zone, energy, seconds
/// by stage.
void print_solution(const Space& space, const VariationalInequality& problem, const Solution& solution);

/// The three of them for one solved scene: prints how it was solved, what it says of its own locking, and its errors;
/// writes its files.
void present(const std::filesystem::path& out, const Scene& scene, const Space& space,
             const VariationalInequality& problem, const Solution& solution, const std::string& what,
             const Errors& errors);

/// Prints the errors in every norm, absolute.
void print_errors(const std::string& what, const Errors& errors);

}  // namespace antilock::tutorial
