#include "antilock/space/element.hpp"

#include "antilock/core/error.hpp"

namespace antilock {

const Element& element(const std::string& name) {
  for (const Element* page : {&p1(), &p2(), &p3(), &p4(), &crouzeix_raviart()})
    if (page->name() == name) return *page;
  throw Error("element: \"" + name + "\" is unknown; accepted \"P1\", \"P2\", \"P3\", \"P4\" and \"CR\"");
}

}  // namespace antilock
