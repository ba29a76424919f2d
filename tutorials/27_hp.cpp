#include "antilock/mesh/graded.hpp"
#include "antilock/core/stopwatch.hpp"
#include "common/study.hpp"
#include "antilock/measure/contact_trace.hpp"
using namespace antilock;
using tutorial::Exact;
struct Res { double h1, l2c, en, maxc; int n; double c0, c1, J; double sec; int corr; };
Res solve(const TriangleMesh& mesh, const Element& el, const Exact& ex) {
  Stopwatch w;
  Discretisation on(mesh, el);
  const VariationalInequality pr = assemble(tutorial::paper_scene(ex.epsilon), on.space());
  const Solution s = active_set(pr);
  double sec = w.seconds();
  const Errors e = ex.errors(on.space(), s);
  Eigen::MatrixX3d tr = contact_trace(on.space(), s.u, 32);
  double l2 = 0, mx = 0;
  for (int i = 0; i < tr.rows(); ++i) { double d = tr(i,1) - ex.truth.value(tr(i,0), -1); l2 += tr(i,2)*d*d; mx = std::max(mx, std::abs(d)); }
  double c0 = 0, c1 = 1; bool first = true;
  for (size_t i = 0; i < pr.contact.size(); ++i) { double x = on.space().points()(pr.contact[i], 0); if (s.active[i]) { if (first) c1 = x; first = false; } else if (first) c0 = x; }
  return {e.h1, std::sqrt(l2), e.energy, mx, on.space().free_count(), c0, c1, energy(pr, s) - ex.truth.energy(), sec, s.counters.corrections};
}
TriangleMesh hpmesh(double c, double h, int layers, double ratio, double eps) {
  int below = layers, above = layers;
  if (eps < 1) { double k = eps > 0 ? std::log(eps) / std::log(ratio) : 1e9; below = std::max(0., std::ceil(layers - k)); above = std::min<double>(layers, std::ceil(k)); } else above = 0;
  auto y = graded_lines(-1, -1, 0, h, below, ratio), b = graded_lines(0, 0, 1, h, above, ratio);
  y.insert(y.end(), b.begin() + 1, b.end());
  return tensor_mesh(graded_lines(0, c, 1, h, layers, ratio), y);
}
int main(int argc, char** argv) {
  double ratio = argc > 1 ? atof(argv[1]) : 0.5;
  int mult = argc > 2 ? atoi(argv[2]) : 2;
  double H = argc > 3 ? atof(argv[3]) : 0.34;
  bool know = argc > 4 && atoi(argv[4]);
  for (double eps : {1.0, 1e-2, 1e-6, 0.0}) {
    Exact ex(eps);
    const double c = ex.contact_from(), um = ex.truth.max_on_contact();
    fmt::print("eps {} c {}\n", eps, c);
    auto show = [&](const char* what, int p, double k, const Res& r) { fmt::print("{:8} P{} {:7.4f} N {:6} h1 {:.2e} en {:.2e} J {:.2e} l2c {:.2e} max/u {:.2e} c {:8.1e} {:8.1e} {:.4f}s {}\n", what, p, k, r.n, r.h1, r.en, std::sqrt(std::abs(2*r.J)), r.l2c, r.maxc/um, r.c0-c, r.c1-c, r.sec, r.corr); };
    if (argc > 5) for (int p = 1; p <= 6; ++p)
      for (int n = 4; n * p <= 128; n *= 2) show("uniform", p, 1./n, solve(structured_mesh(n), lagrange(p), ex));
    if (argc > 6)
    for (int p = 1; p <= 4; ++p) { double end = .5;
      for (int n = 2; n * p <= 96; n *= 2) {
        int layers = n == 2 ? 0 : std::ceil((2*p/3. - 1) * std::log(n) / -std::log(ratio));
        if (layers < 0) layers = 0;
        Res r = solve(hpmesh(know ? c : end, 1./n, layers, ratio, eps), lagrange(p), ex);
        show("graded", p, 1./n, r); end = .5*(r.c0 + r.c1);
      } }
    double end = .5;
    for (int p = 1; p <= 6; ++p) {
        Res r = solve(hpmesh(know ? c : end, H, mult * p, ratio, eps), lagrange(p), ex);
        show("hp", p, end - c, r);
        end = .5*(r.c0 + r.c1);
    }
  }
}
