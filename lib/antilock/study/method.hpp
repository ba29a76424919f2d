#pragma once
#include <memory>
#include <string>
#include <vector>

#include "antilock/mesh/families.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// A mesh and the space on it, kept together: the space looks at the mesh.
class Discretisation {
 public:
  Discretisation(TriangleMesh mesh, const Element& element)
      : mesh_(std::make_shared<const TriangleMesh>(std::move(mesh))), space_(*mesh_, element) {}
  /// Another element on the same mesh.
  Discretisation(const Discretisation& other, const Element& element) : mesh_(other.mesh_), space_(*mesh_, element) {}
  const TriangleMesh& mesh() const { return *mesh_; }
  const Space& space() const { return space_; }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;  // stays where it is when this is moved or copied
  Space space_;
};

/// A method of the paper's Section 4: an element on a family of meshes.
struct Method {
  const Element* element;
  MeshFamily family;

  std::string name() const { return element->name() + " " + family.name; }  ///< "P1 structured"
  TriangleMesh mesh(int cells) const { return family.mesh(cells); }
  /// The space of this element on a mesh, which must outlive it.
  Space space(const TriangleMesh& mesh) const { return Space(mesh, *element); }
  Discretisation discretise(int cells) const { return {mesh(cells), *element}; }
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
