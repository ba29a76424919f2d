#include "antilock/space/element.hpp"

#include "antilock/core/error.hpp"

namespace antilock {

const Element& element(const std::string& name) {
  for (const Element* page : {&p1(), &p2(), &p3(), &p4(), &crouzeix_raviart(), &p1_bubble()})
    if (page->name() == name) return *page;
  throw Error("element: \"" + name +
              "\" is unknown; accepted \"P1\", \"P2\", \"P3\", \"P4\", \"CR\" and \"P1+bubble\"");
}

}  // namespace antilock
