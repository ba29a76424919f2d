#include "antilock/exact/sine_transform.hpp"

#include <fftw3.h>

#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace antilock {
namespace {

struct DestroyPlan {
  void operator()(fftw_plan p) const { fftw_destroy_plan(p); }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, DestroyPlan>;

// From one vector to another: in place, FFTW finds only a DST-I that takes four times as long. The
// plan of one kind and size is made once: at most sizes it takes longer than ten transforms. It
// serves all vectors, since all lie in memory alike (eigen_memory.hpp). FFTW's planner is the one
// part of it that two threads may not enter at once.
void transform(int n, fftw_r2r_kind kind, double* from, double* to) {
  static std::mutex planner;
  static std::map<std::pair<int, fftw_r2r_kind>, Plan> plans;
  fftw_plan plan = nullptr;
  {
    const std::lock_guard lock(planner);
    Plan& found = plans[{n, kind}];
    if (!found) found.reset(fftw_plan_r2r_1d(n, from, to, kind, FFTW_ESTIMATE));
    plan = found.get();
  }
  fftw_execute_r2r(plan, from, to);
}

// FFTW's DST-I is 2 sum_k v_k sin(pi j k / n); applied twice it gives 2 n.
void sine(Eigen::VectorXd& v, double scale) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(v.size());
  transform(static_cast<int>(v.size()) - 2, FFTW_RODFT00, v.data() + 1, sums.data() + 1);
  v = scale * sums;
}

}  // namespace

void points_from_modes(Eigen::VectorXd& v) { sine(v, 0.5); }
void modes_from_points(Eigen::VectorXd& v) { sine(v, 1.0 / static_cast<double>(v.size() - 1)); }

// FFTW's DCT-I is v_0 + (-1)^j v_n + 2 sum_k v_k cos(pi j k / n).
void cosine_points(Eigen::VectorXd& v) {
  v(0) *= 2;
  v(v.size() - 1) *= 2;
  Eigen::VectorXd sums(v.size());
  transform(static_cast<int>(v.size()), FFTW_REDFT00, v.data(), sums.data());
  v = 0.5 * sums;
}

}  // namespace antilock
