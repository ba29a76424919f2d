#include "common/worst_loads_output.hpp"

#include <cmath>

#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/study/method.hpp"

namespace antilock::tutorial {

void write_load(const std::filesystem::path& path, const LoadModes& modes, Eigen::VectorXd f) {
  if (f.dot(modes.constant_in_y(1, 1) + modes.constant_in_y(2, 1)) < 0) f = -f;
  const TriangleMesh drawn = structured_mesh(48, Domain{0});
  const Space space(drawn, p1());
  Eigen::VectorXd values(space.size());
  for (int i = 0; i < space.size(); ++i) values(i) = modes.value(f, space.points()(i, 0), space.points()(i, 1));
  write_vtu(path, space, values);
}

double likeness(const LoadModes& modes, const Eigen::VectorXd& f, int k) {
  const Eigen::VectorXd g = (modes.k().array() == k).select(modes.held_at_top(), 0.0);
  return std::abs(f.dot(g)) / g.norm();
}

void write_worst_errors(const std::filesystem::path& out, const Table& results, double h) {
  const Table rigid = results.where("epsilon", 0);
  for (const Entry& load : rigid.different("load"))
    rigid.where("load", load).pivot("method", "h", "error").print(load.text() + ", epsilon = 0");
  rigid.write(out / "errors.csv");
  results.where_number("h", [&](double own) { return std::abs(own / h - 1) < 1e-9; })
      .where_number("epsilon", [](double epsilon) { return epsilon > 1e-10; })
      .write(out / "epsilon.csv");
}

double half_of_the_loss(const Element& element, int cells) {
  const Discretisation on(unstructured_mesh(cells), element);
  ErrorForm form(on.space(), LoadModes(cells));
  const auto square = [&](double epsilon) {
    form.set_epsilon(epsilon);
    return std::pow(form.worst(1e-3).error, 2);
  };
  const double middle = 0.5 * (square(1) + square(0));
  double low = -6, high = 0;
  for (int i = 0; i < 10; ++i) {
    const double tried = 0.5 * (low + high);
    (square(std::pow(10.0, tried)) > middle ? low : high) = tried;
  }
  return std::pow(10.0, 0.5 * (low + high));
}

}  // namespace antilock::tutorial
