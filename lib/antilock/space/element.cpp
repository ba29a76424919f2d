#include "antilock/space/element.hpp"

#include "antilock/core/error.hpp"

namespace antilock {

const Element& element(const std::string& name) {
  for (int degree = 1; degree <= 6; ++degree)
    if (lagrange(degree).name() == name) return lagrange(degree);
  for (const Element* candidate : {&crouzeix_raviart(), &p1_bubble()})
    if (candidate->name() == name) return *candidate;
  throw Error("element: \"" + name +
              "\" is unknown; accepted \"P1\" to \"P6\", \"CR\" and \"P1+bubble\"");
}

}  // namespace antilock
