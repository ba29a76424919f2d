#pragma once
#include <string>
#include <vector>

#include "antilock/form/elasticity_forms.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

// What chapters 26 and 30 share.

/// A discretisation: triangles, an element per component, and whether edges need their jumps penalised.
struct Rubber {
  std::string name, file;
  TriangleMesh mesh;
  const Element &in_x, &in_y;
  bool jumps, locks;
};
/// The five of the chapter, on n x n squares with free sides or gmsh's triangles of that size; the four without gmsh's.
std::vector<Rubber> rubbers(int cells);
std::vector<Rubber> structured_rubbers(int cells);

/// A uniform strain, u = (.1/(1 + 2 epsilon) x, -.1 y), is in every space: the largest difference of the solution
/// from it.
double patch_error(const Rubber& rubber, double epsilon);

/// Dimension of the kernel of a1 on the free unknowns: the motions that cost no energy.
int zero_modes(VariationalInequality problem);

/// How far the side x = `side`, 0 or 1, moves outwards on average.
double bulge(const Space& space, const Eigen::VectorXd& u, double side);

/// The contact force of Taylor-Hood on graded meshes (freefem/26_elasticity.edp), at epsilon = 1, 1e-2, 1e-4, 1e-8, 0:
/// how much too large a force is, in per cent; 0 / 0 where it is not known.
double percent_too_large(double force, double epsilon);

}  // namespace antilock::tutorial
