// gmsh's meshes for pages, which have no gmsh. Their names are those under which the
// library keeps them (mesh/unstructured.cpp): it does so in the folder
// ANTILOCK_MESHES. Run: tutorials/book/runs.py | ANTILOCK_MESHES=FOLDER page_meshes
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

#include "antilock/mesh/generate.hpp"

int main() try {
  for (std::string line; std::getline(std::cin, line);) {
    int mesher = 0;
    antilock::Domain domain;
    double h = 0;
    if (std::sscanf(line.c_str(), "tetrahedra_%la_%la", &domain.layer_depth, &h) == 2) {
      domain.kind = antilock::CellKind::tetrahedron;
      mesher = static_cast<int>(antilock::Mesher::frontal);
    } else if (std::sscanf(line.c_str(), "recombined%d_%la_%la", &mesher,
                           &domain.layer_depth, &h) == 3) {
      domain.kind = antilock::CellKind::quadrilateral;
    } else if (std::sscanf(line.c_str(), "unstructured%d_%la_%la", &mesher,
                           &domain.layer_depth, &h) != 3) {
      fmt::print(stderr, "page_meshes: \"{}\" names no mesh\n", line);
      return 2;
    }
    antilock::unstructured_mesh(static_cast<int>(std::lround(1 / h)), domain,
                                static_cast<antilock::Mesher>(mesher));
  }
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "page_meshes: {}\n", error.what());
  return 1;
}
