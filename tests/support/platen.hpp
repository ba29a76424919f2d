#pragma once
#include "antilock/mesh/generate.hpp"
#include "antilock/models/plane_strain.hpp"

namespace antilock::test {

/// A gap under a block in plane strain: contact begins in its middle.
inline double parabola(double x) { return (x - 0.5) * (x - 0.5); }

/// The block over that gap.
inline PlaneStrain platen(double epsilon, double jump_weight = 0) {
  return {BlockLoading{.gap = parabola, .jump_weight = jump_weight}, epsilon};
}

/// The block on squares cut along /.
inline TriangleMesh block(int cells) { return with_free_sides(structured_mesh(cells, Domain{0})); }

/// Rubber over that gap, both components in one space; with jumps where it is not conforming.
inline VariationalInequality rubber(const Space& space, bool per_vertex, double epsilon = 0) {
  PlaneStrain scene = platen(epsilon, space.element().conforming() ? 0 : 1);
  scene.continuous_pressure = per_vertex;
  return assemble(scene, {space, space});
}

}  // namespace antilock::test
