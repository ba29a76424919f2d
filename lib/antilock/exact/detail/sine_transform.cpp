#include "antilock/exact/detail/sine_transform.hpp"

#include <fftw3.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

namespace antilock {
namespace {

struct FreeBuffer {
  void operator()(double* p) const { fftw_free(p); }
};
struct DestroyPlan {
  void operator()(fftw_plan p) const { fftw_destroy_plan(p); }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, DestroyPlan>;

// From one buffer to another: in place, FFTW finds only a DST-I that takes four times as long.
struct Buffers {
  explicit Buffers(int n) : in(fftw_alloc_real(n + 1)), out(fftw_alloc_real(n + 1)) {}
  std::unique_ptr<double, FreeBuffer> in, out;
};

// The plan of one kind and size, made once for all transforms: at most sizes it takes longer than ten of them. It serves
// any buffers that are aligned like those it was made with. FFTW's planner is the one part of it that two threads may not
// enter at once.
fftw_plan plan(int n, fftw_r2r_kind kind) {
  static std::mutex planner;
  static std::map<std::pair<int, fftw_r2r_kind>, Plan> plans;
  const std::lock_guard lock(planner);
  Plan& found = plans[{n, kind}];
  if (!found) {
    const Buffers b(n);
    found.reset(kind == FFTW_RODFT00 ? fftw_plan_r2r_1d(n - 1, b.in.get() + 1, b.out.get() + 1, kind, FFTW_ESTIMATE)
                                     : fftw_plan_r2r_1d(n + 1, b.in.get(), b.out.get(), kind, FFTW_ESTIMATE));
  }
  return found.get();
}

}  // namespace

struct SineTransform::Plans : Buffers {
  explicit Plans(int n) : Buffers(n), sine(plan(n, FFTW_RODFT00)) {}
  fftw_plan sine;
  fftw_plan cosine = nullptr;  // few want it
};

SineTransform::SineTransform(int n) : n_(n), plans_(std::make_unique<Plans>(n)) {}
SineTransform::~SineTransform() = default;

// FFTW's DST-I is 2 sum_k v_k sin(pi j k / n); applied twice it gives 2 n.
void SineTransform::sine(Eigen::VectorXd& v, double scale) {
  std::copy_n(v.data(), n_ + 1, plans_->in.get());
  fftw_execute_r2r(plans_->sine, plans_->in.get() + 1, plans_->out.get() + 1);
  v(0) = v(n_) = 0;
  for (int i = 1; i < n_; ++i) v(i) = scale * plans_->out.get()[i];
}

void SineTransform::points_from_modes(Eigen::VectorXd& v) { sine(v, 0.5); }
void SineTransform::modes_from_points(Eigen::VectorXd& v) { sine(v, 1.0 / n_); }

// FFTW's DCT-I is v_0 + (-1)^j v_n + 2 sum_k v_k cos(pi j k / n).
void SineTransform::cosine_points(Eigen::VectorXd& v) {
  double* in = plans_->in.get();
  std::copy_n(v.data(), n_ + 1, in);
  in[0] *= 2;
  in[n_] *= 2;
  if (plans_->cosine == nullptr) plans_->cosine = plan(n_, FFTW_REDFT00);
  fftw_execute_r2r(plans_->cosine, in, plans_->out.get());
  for (int i = 0; i <= n_; ++i) v(i) = 0.5 * plans_->out.get()[i];
}

}  // namespace antilock
