#include "antilock/space/element.hpp"

#include "antilock/core/error.hpp"
#include "antilock/mesh/quadrature.hpp"

namespace antilock {

Eigen::VectorXd means_on_edge(const Element& element, int i) {
  const auto [places, weights] = gauss_rule(element.degree() / 2 + 1);
  Eigen::VectorXd means = Eigen::VectorXd::Zero(element.dofs());
  for (Eigen::Index q = 0; q < places.size(); ++q)
    means += weights(q) * element.basis(on_edge(i, places(q)));
  return means;
}

const Element& element(const std::string& name) {
  for (int degree = 1; degree <= 6; ++degree)
    if (lagrange(degree).name() == name) return lagrange(degree);
  for (const Element* candidate : {&crouzeix_raviart(), &p1_bubble(), &hybrid_bdm1()})
    if (candidate->name() == name) return *candidate;
  if (name == "M2") return hybrid_bdm1();
  throw Error("element: \"" + name +
              "\" is unknown; accepted \"P1\" to \"P6\", \"CR\", \"P1+bubble\", \"BDM1-hybrid\" "
              "and \"M2\"");
}

}  // namespace antilock
