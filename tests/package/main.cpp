#include <antilock/analysis/solve.hpp>
#include <antilock/mesh/generate.hpp>
#include <iostream>
using namespace antilock;

int main() {
  const Scene scene(Body{paper_load}, StiffLayer{1e-6}, UnilateralContact{});
  const Space space(unstructured_mesh(64), crouzeix_raviart());
  const Result result = solve(scene, space);
  std::cout << "largest u on the contact line: "
            << result.solution.u(space.contact_dofs()).maxCoeff() << "\n"
            << "warning: " << (result.warning.empty() ? "none" : result.warning) << "\n";
}
