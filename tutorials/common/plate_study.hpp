#pragma once
#include <filesystem>
#include <string>

#include "antilock/exact/plate_truth.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// A discretisation of the plate: an element for w, one for each component of theta, and what of the shear counts.
struct PlateMethod {
  std::string name, file;
  const Element &deflection, &rotation;
  ShearRule shear;
  bool locks;
};

/// The method on a mesh, which must outlive it.
struct Discrete {
  Discrete(const PlateMethod& method, const TriangleMesh& mesh)
      : w(mesh, method.deflection), theta(mesh, method.rotation), space{w, {theta, theta}, method.shear} {}
  Space w, theta;
  PlateSpace space;
};

/// Largest error of w at its unknowns.
double largest_error(const Space& w, const Solution& solution, const PlateTruth& truth);

/// The patch test: largest error of theta at the vertices of a plate that is bent with constant curvature by its rim.
double patch_error(const PlateMethod& method, const TriangleMesh& mesh, double thickness);

/// Draws a method at the thickness of the options: FILE.vtu, mesh.freefem.msh, and for profile.csv the rows x, element,
/// w along the diameter y = 0, with the first method those of the exact plate too.
void draw(const Options& options, const PlateMethod& method, const Space& w, const Solution& solution, Table& profile);

/// Prints the checks (one row per element) and the errors on the finest mesh (one row per element, mesh and thickness);
/// writes errors.csv and profile.csv.
void print_plate(const std::filesystem::path& out, const Table& checks, const Table& errors, const Table& profile);

/// Claims what is to come out: the patch test, what P1 loses, and the bound, order and corrections of each
/// cure. h: the width of the finest mesh.
void judge_plate(const Table& checks, const Table& errors, double h, Report& report);

}  // namespace antilock::tutorial
