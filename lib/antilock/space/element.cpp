#include "antilock/space/element.hpp"

#include "antilock/core/error.hpp"
#include "antilock/mesh/quadrature.hpp"

namespace antilock {

Eigen::VectorXd means_on_facet(const Element& element, int i) {
  const Quadrature rule = facet_rule(element.kind(), element.degree());
  Eigen::VectorXd means = Eigen::VectorXd::Zero(element.dofs());
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
    means += rule.weights(q) * element.basis(on_facet(element.kind(), i, rule.points.row(q)));
  return means;
}

const Element& element(const std::string& name, CellKind kind) {
  if (kind == CellKind::quadrilateral) {
    for (const Element* candidate : {&q1(), &q1(Integration::selective), &q1(Integration::reduced),
                                     &rotated_q1(), &rotated_q1_plus()})
      if (candidate->name() == name) return *candidate;
    throw Error("element: \"" + name +
                "\" is unknown on quadrilaterals; accepted \"Q1\", \"Q1-selective\", "
                "\"Q1-reduced\", \"Q1rot\" and \"Q1rot+\"");
  }
  if (kind == CellKind::tetrahedron) {
    for (const Element* candidate : {&p1(kind), &p2(kind), &crouzeix_raviart(kind)})
      if (candidate->name() == name) return *candidate;
    throw Error("element: \"" + name +
                "\" is unknown on tetrahedra; accepted \"P1\", \"P2\" and \"CR\"");
  }
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
