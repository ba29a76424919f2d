// The answers of the uniformity table (12 epsilons from 1 to 1e-20 and 0, P1 and CR, structured and unstructured) by the
// factor that this program is linked with. Run: factor_table write FILE     every u, as it is in memory
//                                              factor_table compare FILE   exit status 1 where one is 1e-12 away
#include <fmt/format.h>

#include <fstream>

#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/method.hpp"

using namespace antilock;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const bool compares = std::string(argv[1]) == "compare";
  std::fstream file(argv[2], std::ios::binary | (compares ? std::ios::in : std::ios::out));
  double worst = 0;
  int answers = 0;
  for (const int cells : {16, 64})
    for (const Method& method : methods()) {
      const Discretisation discrete = method.on(cells);
      for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-16, 1e-20, 0.0}) {
        const Scene scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
        const Solution solution = active_set(assemble(scene, discrete.space()));
        Eigen::VectorXd other = solution.u;
        auto* bytes = reinterpret_cast<char*>(other.data());
        const auto size = static_cast<std::streamsize>(sizeof(double)) * other.size();
        compares ? void(file.read(bytes, size)) : void(file.write(bytes, size));
        if (!file) {
          fmt::print("cannot {} {}\n", compares ? "read" : "write", argv[2]);
          return 1;
        }
        const double away = (solution.u - other).lpNorm<Eigen::Infinity>() / other.lpNorm<Eigen::Infinity>();
        if (!(away < 1e-12))
          fmt::print("{}, 1/h = {}, epsilon = {}: {:.1e} apart\n", method.name(), cells, epsilon, away);
        worst = std::max(worst, away);
        ++answers;
      }
    }
  fmt::print("{} answers, largest difference {:.1e} (relative, largest entry)\n", answers, worst);
  return worst < 1e-12 ? 0 : 1;
}
