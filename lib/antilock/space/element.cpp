#include "antilock/space/element.hpp"

#include "antilock/core/error.hpp"

namespace antilock {

const Element& element(const std::string& name) {
  for (int degree = 1; degree <= 6; ++degree)
    if (lagrange(degree).name() == name) return lagrange(degree);
  if (crouzeix_raviart().name() == name) return crouzeix_raviart();
  throw Error("element: \"" + name + "\" is unknown; accepted \"P1\" to \"P6\" and \"CR\"");
}

}  // namespace antilock
