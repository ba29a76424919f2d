#include <antilock/mesh/generate.hpp>
#include <antilock/models/anti_plane.hpp>
#include <antilock/solve/active_set.hpp>
using namespace antilock;

int main() {
  const Scene scene(Body{paper_load}, StiffLayer{1e-6}, UnilateralContact{});
  const Space space(unstructured_mesh(64), crouzeix_raviart());
  const Solution solution = active_set(assemble(scene, space));  // right, with a warning, or it throws
  return solution.warning.empty() ? 0 : 1;
}
