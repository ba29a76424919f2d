#include "antilock/exact/sine_transform.hpp"

#include <fftw3.h>

#include <algorithm>
#include <mutex>

namespace antilock {
namespace {

struct FreeBuffer {
  void operator()(double* p) const { fftw_free(p); }
};
struct DestroyPlan {
  void operator()(fftw_plan p) const { fftw_destroy_plan(p); }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, DestroyPlan>;

// FFTW's planner is the one part of it that two threads may not enter at once.
Plan make_plan(int n, double* in, double* out, fftw_r2r_kind kind) {
  static std::mutex planner;
  const std::lock_guard lock(planner);
  return Plan(fftw_plan_r2r_1d(n, in, out, kind, FFTW_ESTIMATE));
}

}  // namespace

// From one buffer to another: in place, FFTW finds only a DST-I that takes four times as long.
struct SineTransform::Plans {
  explicit Plans(int n)
      : in(fftw_alloc_real(n + 1)),
        out(fftw_alloc_real(n + 1)),
        sine(make_plan(n - 1, in.get() + 1, out.get() + 1, FFTW_RODFT00)),
        cosine(make_plan(n + 1, in.get(), out.get(), FFTW_REDFT00)) {}
  std::unique_ptr<double, FreeBuffer> in, out;
  Plan sine, cosine;
};

SineTransform::SineTransform(int n) : n_(n), plans_(std::make_unique<Plans>(n)) {}
SineTransform::~SineTransform() = default;

// FFTW's DST-I is 2 sum_k v_k sin(pi j k / n); applied twice it gives 2 n.
void SineTransform::sine(Eigen::VectorXd& v, double scale) {
  std::copy_n(v.data(), n_ + 1, plans_->in.get());
  fftw_execute(plans_->sine.get());
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
  fftw_execute(plans_->cosine.get());
  for (int i = 0; i <= n_; ++i) v(i) = 0.5 * plans_->out.get()[i];
}

}  // namespace antilock
