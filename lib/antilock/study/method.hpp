#pragma once
#include <string>
#include <vector>

#include "antilock/mesh/families.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// A method as in Section 4 of [SR04] (cited in problem/variational_inequality.hpp): an element on
/// a family of meshes.
struct Method {
  const Element* element;
  MeshFamily family;

  std::string name() const { return element->name() + " " + family.name; }  ///< "P1 structured"
  TriangleMesh mesh(int cells) const { return family.mesh(cells); }
  /// Returns the space of this element on the mesh of the family with this number of cells.
  Space space(int cells) const { return Space(mesh(cells), *element); }
};

/// Returns all pairs of an element and a family, ordered by elements. Without arguments these are
/// four methods (the caption of Figure 9 of [SR04] counts three).
inline std::vector<Method> methods(
    const std::vector<const Element*>& elements = {&p1(), &crouzeix_raviart()},
    const std::vector<MeshFamily>& families = {structured(), unstructured()}) {
  std::vector<Method> all;
  for (const Element* element : elements)
    for (const MeshFamily& family : families) all.push_back({element, family});
  return all;
}

}  // namespace antilock
