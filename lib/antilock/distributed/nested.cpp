#include "antilock/distributed/nested.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/distributed/kkt_report.hpp"
#include "antilock/distributed/partition.hpp"
#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

/// Measured at 1/h = 512: from 4 on the contact set that follows is right, after 3 it is not yet.
constexpr int smoothings = 6;

void check_question(const Scene& scene, const Element& element) {
  if (element.degree() != 1)
    throw Error("element: \"" + element.name() +
                "\" is not accepted by petsc; accepted \"P1\" and \"CR\"");
  if (std::holds_alternative<VentcelLayer>(scene.layer()))
    throw Error(
        "layer.model: \"ventcel\" is not accepted by petsc; accepted \"scaled\" and \"thin\"");
}

/// The choice where the caller makes none. BoomerAMG finds the kernel of B in columns by itself,
/// with the fewest seconds. A layer before the change of variable is not stiff.
Preconditioner preconditioner_for(const Scene& scene, const TriangleMesh& mesh) {
  const bool is_stiff = std::holds_alternative<StiffLayer>(scene.layer());
  return is_stiff && find_triangle_across_columns(mesh) >= 0 ? Preconditioner::strips
                                                             : Preconditioner::multigrid;
}

/// The corners of child i of a triangle in the barycentric coordinates of its parent
/// (partition.hpp's order): the midpoints of the edges, or corner i and the midpoints beside it.
Eigen::Matrix3d corners_of_child(int i) {
  Eigen::Matrix3d corners = 0.5 * (Eigen::Matrix3d::Ones() - Eigen::Matrix3d::Identity());
  for (int k = 0; k < 3 && i < 3; ++k)
    corners.row(k) = 0.5 * (Eigen::RowVector3d::Unit(i) + Eigen::RowVector3d::Unit((i + k) % 3));
  return corners;
}

}  // namespace

bool ContactSet::at(double where) const {
  if (x.empty()) return false;
  const double slack =
      1e-9 * (x.back() - x.front());  // a point of both meshes stands between itself and itself
  const auto right = std::lower_bound(x.begin(), x.end() - 1, where - slack) - x.begin();
  const auto left = std::upper_bound(x.begin() + 1, x.end(), where + slack) - x.begin() - 1;
  return active[left] != 0 && active[right] != 0;
}

NestedLevel::NestedLevel(const Scene& scene, TriangleMesh subdomain, const Element& element,
                         PenaltyChoice penalty)
    : space(std::move(subdomain), element),
      problem(scene, space, penalty),
      state(zero_state(problem)) {}

ContactSet NestedLevel::contact_set() const {
  std::vector<double> mine;  // x, whether active
  for (int place = 0; place < problem.rows().owned(); ++place)
    if (std::isfinite(problem.lower()(place)))
      mine.insert(mine.end(), {space.dof_coordinates()(problem.rows().unknown(place), 0),
                               double(state.active[place])});
  const std::vector<double> all = all_gather(mine);
  std::map<double, char> by_x;
  for (std::size_t i = 0; i < all.size(); i += 2) by_x[all[i]] = all[i + 1] != 0 ? 1 : 0;
  ContactSet set;
  for (const auto& [x, active] : by_x) {
    set.x.push_back(x);
    set.active.push_back(active);
  }
  return set;
}

void NestedLevel::start_from(const ContactSet& set) {
  for (int place = 0; place < problem.rows().owned(); ++place)
    state.active[place] = std::isfinite(problem.lower()(place)) &&
                                  set.at(space.dof_coordinates()(problem.rows().unknown(place), 0))
                              ? 1
                              : 0;
}

void NestedLevel::start_from(const NestedLevel& coarse) {
  const Element& element = space.element();
  std::array<Eigen::Matrix3d, 4> values;  // the parent's basis at the unknowns of child i
  for (int i = 0; i < 4; ++i) {
    const Eigen::Matrix3d support = element.support_points();
    const Eigen::Matrix3d nodes = support * corners_of_child(i);
    for (int k = 0; k < 3; ++k) values[i].row(k) = element.basis(nodes.row(k)).transpose();
  }
  for (Eigen::Index t = 0; t < space.cell_dofs().rows(); ++t) {
    const Eigen::RowVector3i parent = coarse.space.cell_dofs().row(t / 4),
                             child = space.cell_dofs().row(t);
    const Eigen::Vector3d u(coarse.state.u(parent(0)), coarse.state.u(parent(1)),
                            coarse.state.u(parent(2)));
    const Eigen::Vector3d here = values[t % 4] * u;
    for (int k = 0; k < 3; ++k) state.u(child(k)) = here(k);
  }
  // rows of B stand in the order of their triangles, and the children of one triangle follow each
  // other
  for (Eigen::Index r = 0; r < state.p.size(); ++r) state.p(r) = coarse.state.p(r / 4);
}

std::unique_ptr<NestedLevel> solve_nested(const Scene& scene, const TriangleMesh& coarse,
                                          const Element& element, const NestedOptions& options,
                                          NestedReport& report) {
  require_triangles(coarse, "solution on nested meshes");
  Stopwatch watch;
  TriangleMesh subdomain;
  Preconditioner preconditioner = Preconditioner::multigrid;
  collectively([&] {
    check_question(scene, element);
    preconditioner = options.loop.preconditioner.value_or(preconditioner_for(scene, coarse));
    const std::vector<int> rank_of =
        options.partition ? options.partition(coarse, ranks()) : strip_partition(coarse, ranks());
    subdomain = subdomain_of(coarse, rank_of, rank());
  });
  const PenaltyChoice penalty = preconditioner == Preconditioner::strips
                                    ? PenaltyChoice::mesh_width
                                    : PenaltyChoice::distributed_default;
  watch.lap();
  const int first = std::max(0, std::min(options.first_level, options.refinements));
  for (int l = 0; l < first; ++l) collectively([&] { subdomain = refined_subdomain(subdomain); });
  report.mesh += watch.lap();
  std::unique_ptr<NestedLevel> level;
  for (int l = first;; ++l) {
    const bool last = l >= options.refinements;
    options.stage(fmt::format("level {} of {}: {} triangles", l, options.refinements,
                              sum(static_cast<long long>(subdomain.triangle_count()))));
    watch.lap();
    auto finer =
        std::make_unique<NestedLevel>(scene, std::exchange(subdomain, {}), element, penalty);
    if (level) {
      finer->start_from(*level);
      finer->start_from(level->contact_set());
    } else if (options.start) {
      finer->start_from(*options.start);
    }
    level = std::move(finer);
    report.assemble += watch.lap();
    LoopOptions loop = options.loop;
    if (!last) {  // a start, no answer
      loop.tolerance = std::max(loop.tolerance, 1e-6);
      loop.residual = std::max(loop.residual, 1e-4);
    }
    loop.preconditioner = preconditioner;
    // the smoothing steps rely on columns; without them the set of the coarse level is a good start
    // by itself (measured: it changes 0 to 2 times)
    if (l > first && preconditioner != Preconditioner::strips) loop.smoothings = smoothings;
    report.last = contact_loop(level->problem, level->state, loop);
    report.loops.push_back(report.last);
    report.unknowns.push_back(level->problem.rows().total());
    report.linear_iterations += report.last.linear_iterations;
    report.setup += report.last.seconds_setup;
    report.solve += report.last.seconds_solve;
    if (last) break;
    options.checkpoint(l, level->contact_set());
    watch.lap();
    collectively([&] { subdomain = refined_subdomain(level->space.mesh()); });
    report.mesh += watch.lap();
  }
  watch.lap();
  report.kkt = certified(level->problem, level->state, options.loop.tolerance, report.warning);
  report.solve += watch.lap();
  return level;
}

}  // namespace antilock::distributed
