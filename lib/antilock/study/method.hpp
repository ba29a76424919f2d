#pragma once
#include <string>
#include <vector>

#include "antilock/mesh/families.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// A method of the paper's Section 4: an element on a family of meshes.
struct Method {
  const Element* element;
  MeshFamily family;

  std::string name() const { return element->name() + " " + family.name; }  ///< "P1 structured"
  TriangleMesh mesh(int cells) const { return family.mesh(cells); }
  /// The space of this element on the mesh with so many cells.
  Space space(int cells) const { return Space(mesh(cells), *element); }
};

/// Every element on every family, elements first: without arguments four methods (the caption of Figure 9 counts
/// three).
inline std::vector<Method> methods(const std::vector<const Element*>& elements = {&p1(), &crouzeix_raviart()},
                                   const std::vector<MeshFamily>& families = {structured(), unstructured()}) {
  std::vector<Method> all;
  for (const Element* element : elements)
    for (const MeshFamily& family : families) all.push_back({element, family});
  return all;
}

}  // namespace antilock
