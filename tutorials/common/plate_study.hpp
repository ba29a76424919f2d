#pragma once
#include <string>

#include "antilock/exact/plate_truth.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"

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

/// For the picture: rows x, element, w along the diameter y = 0 of a disc, and with the first method those of the exact
/// plate of this thickness.
void add_diameter(Table& profile, const PlateMethod& method, const Space& w, const Solution& solution,
                  double thickness);

}  // namespace antilock::tutorial
