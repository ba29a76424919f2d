#pragma once
#include <string>
#include <vector>

#include "antilock/form/elasticity_forms.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/plane_strain.hpp"

namespace antilock::tutorial {

// What chapters 26 and 30 share.

/// A discretisation: triangles, an element per component, and whether edges need their jumps penalised.
struct Rubber {
  std::string name, file;
  TriangleMesh mesh;
  const Element &in_x, &in_y;
  bool jumps, locks;
};

/// Four on n x n squares with free sides.
inline std::vector<Rubber> structured_rubbers(int cells) {
  const TriangleMesh right = with_free_sides(structured_mesh(cells, Domain{0}));
  const TriangleMesh crossed = with_free_sides(structured_mesh(cells, Domain{0}, Diagonal::crossed));
  return {{"P1 right diagonals", "p1_right", right, p1(), p1(), false, true},
          {"P1 crossed triangles", "p1_crossed", crossed, p1(), p1(), false, false},
          {"Crouzeix-Raviart with jumps", "cr", right, crouzeix_raviart(), crouzeix_raviart(), true, false},
          {"Kouhia-Stenberg", "ks", right, p1(), crouzeix_raviart(), false, false}};
}

/// And P1 on gmsh's triangles of that size.
inline std::vector<Rubber> rubbers(int cells) {
  const TriangleMesh any = with_free_sides(unstructured_mesh(cells, Domain{0}));
  std::vector<Rubber> all;
  for (const Rubber& rubber : structured_rubbers(cells)) {
    all.push_back(rubber);
    if (rubber.locks) all.push_back({"P1 unstructured", "p1_unstructured", any, p1(), p1(), false, true});
  }
  return all;
}

}  // namespace antilock::tutorial
