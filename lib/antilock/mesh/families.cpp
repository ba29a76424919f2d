#include "antilock/mesh/families.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>

#include "antilock/core/error.hpp"
#include "antilock/mesh/layered.hpp"

namespace antilock {

MeshFamily structured(const Domain& domain, Diagonal diagonal) {
  return {"structured", [=](int cells) { return structured_mesh(cells, domain, diagonal); }};
}

MeshFamily unstructured(const Domain& domain) {
  return {"unstructured", [=](int cells) { return unstructured_mesh(cells, domain); }};
}

const std::vector<MeshFamily>& mesh_families() {
  // an equilateral triangle of base 1/n is sqrt(3) / (2 n) high
  const auto lines = [](int n) {
    return static_cast<int>(std::lround(2 * n / std::numbers::sqrt3));
  };
  static const std::vector<MeshFamily> all{
      structured(),
      {"layered", [](int n) { return layered_mesh(n); }},
      {"columns", [=](int n) { return columns_mesh(n, lines(n)); }},
      unstructured(),
      {"delaunay", [](int n) { return unstructured_mesh(n, {}, Mesher::delaunay); }},
      {"meshadapt", [](int n) { return unstructured_mesh(n, {}, Mesher::mesh_adapt); }},
      {"jittered", [](int n) { return jittered_mesh(n, 0.2); }},
      {"staggered", [](int n) { return rows_mesh(n, n); }},
      {"rows", [=](int n) { return rows_mesh(n, lines(n)); }}};
  return all;
}

const MeshFamily& mesh_family(const std::string& name) {
  std::vector<std::string> names;
  for (const MeshFamily& family : mesh_families()) {
    if (family.name == name) return family;
    names.push_back(family.name);
  }
  throw Error(fmt::format("mesh: no family '{}'; accepted: {}", name, fmt::join(names, ", ")));
}

}  // namespace antilock
