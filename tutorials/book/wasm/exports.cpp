// What the page's script calls. A throw of the library ends the call: the script reads what
// it says (`page.thrown`).
#include <exception>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "live_figure.hpp"

extern "C" __attribute__((import_module("page"), import_name("thrown"))) void page_thrown(
    const char* what);

namespace {

using namespace antilock;

struct Made {
  double amount;
  std::unique_ptr<book::LiveFigure> figure;
};
std::map<std::tuple<int, int, int>, Made>
    made;                      // by element, kind and cells, with the amount asked for last
book::LiveFigure* figures[2];  // of `made`, those that are seen: P1, Crouzeix-Raviart
std::unique_ptr<book::LiveExact> exact;
book::LiveNumbers numbers;
book::RoundOff round_off_numbers;
std::vector<float> picture;
std::vector<double> line;

book::LiveFigure& figure_of(int element, int kind, int cells, double amount) {
  Made& one = made[{element, kind, cells}];
  if (!one.figure || (one.amount != amount &&
                      static_cast<book::LiveMesh>(kind) == book::LiveMesh::moved)) {
    const Element& which = element == 0 ? p1() : crouzeix_raviart();
    one = {amount, std::make_unique<book::LiveFigure>(static_cast<book::LiveMesh>(kind),
                                                      cells, amount, which)};
  }
  return *one.figure;
}

const book::LiveExact& exact_at(double epsilon) {
  if (!exact || exact->epsilon != epsilon)
    exact = std::make_unique<book::LiveExact>(epsilon);
  return *exact;
}

/// The script is told of a throw: what the call returns is not to be read then.
template <class Call>
void told(const Call& call) {
  try {
    call();
  } catch (const std::exception& error) {
    page_thrown(error.what());
  }
}

}  // namespace

#define EXPORT(name) extern "C" __attribute__((export_name(#name)))

/// element: 0 P1, 1 Crouzeix-Raviart; kind: in the order of LiveMesh. A mesh is made once.
EXPORT(discretise) void discretise(int element, int kind, int cells, double amount) {
  told([&] { figures[element] = &figure_of(element, kind, cells, amount); });
}
/// Makes a mesh that is not seen yet, and its factor, before it is asked for.
EXPORT(prepare)
void prepare(int element, int kind, int cells, double amount, double epsilon) {
  told([&] {
    book::LiveFigure& figure = figure_of(element, kind, cells, amount);
    if (figure.solution().u.size() == 0 && &figure != figures[element])
      figure.solve(epsilon, exact_at(epsilon));
  });
}
/// The members of LiveNumbers in their order.
EXPORT(solve) const double* solve(int element, double epsilon) {
  told([&] { numbers = figures[element]->solve(epsilon, exact_at(epsilon)); });
  return &numbers.largest_on_contact;
}
/// Of the last solve: empty, or the sentence of run_scene.
EXPORT(warning) const char* warning(int element) {
  return figures[element]->warning().c_str();
}
/// x, y, u per corner; `size` tells how many numbers there are. The same for the lines
/// below.
EXPORT(surface) const float* surface(int element) {
  picture = figures[element]->picture();
  return picture.data();
}
EXPORT(surface_size) int surface_size() { return static_cast<int>(picture.size()); }
EXPORT(trace) const double* trace(int element) {
  line = figures[element]->trace();
  return line.data();
}
EXPORT(ridge) const double* ridge(double epsilon, int points) {
  told([&] { line = book::ridge_line(exact_at(epsilon), points); });
  return line.data();
}
EXPORT(line_size) int line_size() { return static_cast<int>(line.size()); }
/// The members of RoundOff.
EXPORT(round_off) const double* round_off(int cells, double epsilon) {
  told([&] { round_off_numbers = book::round_off(cells, epsilon, exact_at(epsilon)); });
  return &round_off_numbers.split;
}
