#include "antilock/study/method.hpp"

namespace antilock {

Discretisation::Discretisation(TriangleMesh mesh, const Element& element)
    : mesh_(std::make_shared<const TriangleMesh>(std::move(mesh))), space_(*mesh_, element) {}

Discretisation::Discretisation(const Discretisation& other, const Element& element)
    : mesh_(other.mesh_), space_(*mesh_, element) {}

std::string Method::name() const { return element->name() + " " + family.name; }

std::vector<Method> methods(const std::vector<const Element*>& elements, const std::vector<MeshFamily>& families) {
  std::vector<Method> all;
  for (const Element* element : elements)
    for (const MeshFamily& family : families) all.push_back({element, family});
  return all;
}

}  // namespace antilock
