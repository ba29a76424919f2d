#include "live_figure.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/analysis/locking_report.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/summed.hpp"

namespace antilock::book {
namespace {

Scene paper_scene(double epsilon) {
  return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
}

double largest_error(const Space& space, const Eigen::VectorXd& u,
                     const ExactTable& table) {
  double error = 0;
  for (int i = 0; i < space.size(); ++i)
    error = std::max(error, std::abs(u(i) - table.value(space.dof_coordinates()(i, 0),
                                                        space.dof_coordinates()(i, 1))));
  return error;
}

}  // namespace

TriangleMesh live_mesh(LiveMesh kind, int cells, double amount) {
  switch (kind) {
    case LiveMesh::structured:
      return structured_mesh(cells);
    case LiveMesh::moved:
      return jittered_mesh(cells, amount);
    case LiveMesh::layered:
      return layered_mesh(cells);
    case LiveMesh::unstructured:
      break;
  }
  return unstructured_mesh(cells);
}

LiveFigure::LiveFigure(LiveMesh kind, int cells, double amount, const Element& element)
    : space_(live_mesh(kind, cells, amount), element), sweep_(paper_scene(1), space_) {}

LiveNumbers LiveFigure::solve(double epsilon, const LiveExact& exact) {
  const Stopwatch watch;
  sweep_.set_epsilon(epsilon);
  solution_ = sweep_.solve();
  LiveNumbers numbers;
  numbers.milliseconds = 1e3 * watch.seconds();
  warning_ =
      report_locking(paper_scene(epsilon), {space_, sweep_.problem(), solution_})->warning;
  for (std::size_t i = 0; i < space_.contact_dofs().size(); ++i) {
    const int unknown = space_.contact_dofs()[i];
    numbers.largest_on_contact = std::max(numbers.largest_on_contact, solution_.u(unknown));
    if (!solution_.active[i]) continue;
    ++numbers.touching;
    numbers.touches_from =
        std::min(numbers.touches_from, space_.dof_coordinates()(unknown, 0));
  }
  numbers.contact = static_cast<double>(space_.contact_dofs().size());
  numbers.ridge = exact.solution.max_on_contact();
  numbers.error = largest_error(space_, solution_.u, exact.table);
  numbers.unknowns = solution_.counters.unknowns;
  numbers.corrections = solution_.counters.corrections;
  numbers.factorisations = solution_.counters.factorisations;
  return numbers;
}

std::vector<float> LiveFigure::picture() const {
  const TriangleMesh& mesh = space_.mesh();
  const Eigen::Matrix3d corners = Eigen::Matrix3d::Identity();
  std::vector<float> numbers;
  numbers.reserve(9 * static_cast<std::size_t>(mesh.triangle_count()));
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::VectorXd u = solution_.u(space_.cell_dofs().row(t));
    for (int i = 0; i < 3; ++i) {
      const int v = mesh.triangles(t, i);
      const double height = u.dot(space_.element().basis(corners.row(i)));
      for (const double number : {mesh.vertices(v, 0), mesh.vertices(v, 1), height})
        numbers.push_back(static_cast<float>(number));
    }
  }
  return numbers;
}

std::vector<double> LiveFigure::trace() const {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < space_.contact_dofs().size(); ++i) {
    const int unknown = space_.contact_dofs()[i];
    numbers.insert(numbers.end(), {space_.dof_coordinates()(unknown, 0),
                                   solution_.u(unknown), solution_.active[i] ? 1.0 : 0.0});
  }
  return numbers;
}

LiveExact::LiveExact(double epsilon)
    : epsilon(epsilon),
      solution(paper_sine_load(), epsilon, true, 10),
      table(solution, 1 << 10) {}

std::vector<double> ridge_line(const LiveExact& exact, int points) {
  std::vector<double> numbers;
  for (int i = 0; i < points; ++i) {
    const double x = static_cast<double>(i) / (points - 1);
    numbers.insert(numbers.end(), {x, exact.table.value(x, -1)});
  }
  return numbers;
}

RoundOff round_off(int cells, double epsilon, const LiveExact& exact) {
  const Space space(structured_mesh(cells), p1());
  const VariationalInequality problem = assemble(paper_scene(epsilon), space);
  RoundOff errors;
  errors.split = largest_error(space, active_set(problem).u, exact.table);
  const NaiveResult summed = naive_summed_solve(problem, SummedFactor::cholesky);
  errors.summed = summed.reason == ConvergedReason::linear_solve_failed
                      ? 1
                      : largest_error(space, summed.solution.u, exact.table);
  return errors;
}

}  // namespace antilock::book
