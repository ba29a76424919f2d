#pragma once
#include <filesystem>
#include <vector>

#include "antilock/analysis/certificate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

// What the chapters on certificates (17, 19) leave out of their pages.

/// One row per solution and its certificate: element, mesh, epsilon, cells, h; the bracket lower, upper and its width;
/// inside: how far the exact energy lies from the nearer end; cr_below: J(u) less the energy of Crouzeix-Raviart;
/// bound, error, their ratio, layer_share; width_ratio = (2 width)^(1/2) / error; shift = (J(CR) - lower) / h^2.
extern const std::vector<std::string> certificate_columns;
std::vector<Entry> certified_row(const std::string& element, const std::string& mesh, int cells, const Exact& exact,
                                 const Certificate& found, double error, double cr_energy);

/// Uzawa's iteration of chapter 04, lambda = max(0, lambda - rho (u + g)) with rho = 1 / (largest eigenvalue of the
/// compliance on Gamma_C), from lambda = 0, on the unstructured mesh with h = 1/16: bound and error of Crouzeix-Raviart
/// after 1, 2, 4, ... 512 steps, as a table of steps, quantity and value. epsilon must not be 0.
Table certify_uzawa(const Exact& exact);

/// Prints the finest meshes' results, writes results.csv, effectivity.csv and uzawa.csv, and the pictures' fields at
/// epsilon = 1e-6: the density of the bound of three functions, and the flux.
void show_certificates(const std::filesystem::path& out, const Table& results, const Table& uzawa);

std::vector<Exercise> certificate_exercises();

/// The indicator per area, as log10: VTU with one colour per triangle.
void write_density(const std::filesystem::path& file, const TriangleMesh& mesh, const Eigen::VectorXd& indicator);

}  // namespace antilock::tutorial
