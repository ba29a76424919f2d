#include "cross_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "antilock/core/error.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/errors.hpp"
#include "runner.hpp"

namespace antilock::freefem {
namespace {

constexpr double same_place = 1e-8;

std::filesystem::path mesh_in(const std::filesystem::path& folder, const Space& space) {
  auto file = folder / "mesh.freefem.msh";
  write_freefem_mesh(file, space.mesh());
  return file;
}

Points places(const ScriptTable& table) {
  Points points(table.rows.rows(), 2);
  points << table.column("x"), table.column("y");
  return points;
}

/// The rows of a table of contact unknowns, by x.
std::vector<int> by_x(const ScriptTable& table) {
  const Eigen::VectorXd x = table.column("x");
  std::vector<int> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return x(i) < x(j); });
  return order;
}

SparseMatrix matrix(const std::filesystem::path& path, const std::vector<int>& ours) {
  const ScriptTable table = read_table(path);
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index k = 0; k < table.rows.rows(); ++k) {
    const double row = table.rows(k, 0), column = table.rows(k, 1),
                 n = static_cast<double>(ours.size());
    if (!(row >= 0 && row < n && column >= 0 && column < n))
      throw Error(
          fmt::format("{}: entry ({}, {}) of a matrix of {} rows", path.string(), row, column, n));
    entries.emplace_back(ours[static_cast<int>(row)], ours[static_cast<int>(column)],
                         table.rows(k, 2));
  }
  SparseMatrix a(static_cast<Eigen::Index>(ours.size()), static_cast<Eigen::Index>(ours.size()));
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

}  // namespace

std::vector<int> match(const Points& ours, const Points& theirs) {
  if (ours.rows() != theirs.rows())
    throw Error(fmt::format("match: {} unknowns here, {} there", ours.rows(), theirs.rows()));
  const auto cell = [](double x) { return std::llround(x / same_place); };
  const auto cells = [&](const Points& points, Eigen::Index i) {
    std::array<long long, 3> key{};  // in the plane the third number is 0
    for (Eigen::Index k = 0; k < points.cols(); ++k) key[k] = cell(points(i, k));
    return key;
  };
  std::map<std::array<long long, 3>, int> row;
  for (Eigen::Index i = 0; i < theirs.rows(); ++i) row[cells(theirs, i)] = static_cast<int>(i);
  if (static_cast<Eigen::Index>(row.size()) != theirs.rows())
    throw Error("match: two unknowns at one place");
  std::vector<int> rows(ours.rows(), -1);
  std::vector<char> taken(ours.rows(), 0);
  for (Eigen::Index i = 0; i < ours.rows(); ++i) {
    const auto [x, y, z] = cells(ours, i);
    for (const int dx : {0, -1, 1})  // round-off may put the same point into the next cell
      for (const int dy : {0, -1, 1})
        for (const int dz : {0, -1, 1})
          if (const auto found = row.find({x + dx, y + dy, z + dz});
              found != row.end() && rows[i] < 0)
            rows[i] = found->second;
    if (rows[i] < 0 || taken[rows[i]]++)
      throw Error(
          fmt::format("match: no unknown of its own at ({:.9g}, {:.9g})", ours(i, 0), ours(i, 1)));
  }
  return rows;
}

Discretisation assemble(const Space& space, const std::filesystem::path& folder) {
  run("matrices", {"-mesh", mesh_in(folder, space), "-element",
                   space.element().name() == "CR" ? "P1nc" : "P1", "-out", folder});
  const ScriptTable unknowns = read_table(folder / "unknowns.csv");
  const std::vector<int> theirs = match(space.dof_coordinates(), places(unknowns));
  std::vector<int> ours(theirs.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) ours[theirs[i]] = static_cast<int>(i);

  Discretisation d{matrix(folder / "a1.csv", ours), matrix(folder / "a0.csv", ours), {}, {}, {}};
  d.load = unknowns.column("load")(theirs);
  const Eigen::VectorXd clamped = unknowns.column("clamped"), contact = unknowns.column("contact");
  for (int i = 0; i < space.size(); ++i) {
    if (clamped(theirs[i]) > 0.5) d.clamped.push_back(i);
    if (contact(theirs[i]) > 0.5) d.contact.push_back(i);
  }
  std::sort(d.contact.begin(), d.contact.end(), [&](int i, int j) {
    return space.dof_coordinates()(i, 0) < space.dof_coordinates()(j, 0);
  });
  return d;
}

Result solve(const std::string& script, const Space& space, double epsilon,
             const std::filesystem::path& folder, const std::vector<std::string>& options) {
  std::vector<std::string> all{
      "-mesh", mesh_in(folder, space), "-epsilon", fmt::format("{}", epsilon), "-out", folder};
  all.insert(all.end(), options.begin(), options.end());
  run(script, all);

  const ScriptTable solution = read_table(folder / "solution.csv"),
                    contact = read_table(folder / "contact.csv"),
                    summary = read_table(folder / "summary.csv", 1);
  Result answer;
  answer.road = summary.names.at(0);
  answer.u = solution.column("u")(match(space.dof_coordinates(), places(solution)));
  const std::vector<int> order = by_x(contact);
  answer.gap = contact.column("gap")(order);
  answer.pressure = contact.column("pressure")(order);
  const Eigen::VectorXd x = contact.column("x")(order);
  const std::vector<int>& here = space.contact_dofs();
  const bool as_many = x.size() == static_cast<Eigen::Index>(here.size());
  if (x.size() > 0 &&
      !(as_many && (x - space.dof_coordinates().col(0)(here)).cwiseAbs().maxCoeff() < same_place))
    throw Error(script + ": its contact unknowns are others than ours");
  answer.energy = summary.column("energy")(0);
  answer.residual = summary.column("residual")(0);
  answer.seconds = summary.column("seconds")(0);
  answer.steps = static_cast<int>(summary.column("steps")(0));
  return answer;
}

History uzawa_history(const Space& space, double epsilon, double rho, int steps,
                      const std::filesystem::path& folder) {
  run("04_reference_solution",
      {"-mesh", mesh_in(folder, space), "-epsilon", fmt::format("{}", epsilon), "-solver", "uzawa",
       "-rho", fmt::format("{}", rho), "-steps", std::to_string(steps), "-out", folder});
  const ScriptTable history = read_table(folder / "history.csv"),
                    summary = read_table(folder / "summary.csv", 1);
  return {summary.names.at(0), history.column("change"), summary.column("seconds")(0)};
}

void run_elastic(const std::string& script, const TriangleMesh& mesh, double parameter,
                 const std::filesystem::path& folder) {
  const auto file = folder / "mesh.freefem.msh";
  write_freefem_mesh(file, mesh);
  // 16 cells: of Taylor-Hood's own, graded mesh; its force is right to 0.03 %
  run(script, {"-mesh", file, script == "32_coating" ? "-thickness" : "-epsilon",
               fmt::format("{}", parameter), "-cells", "16", "-out", folder});
}

ElasticAnswer elastic_answer(const std::filesystem::path& folder, const std::string& name,
                             const VectorSpace& space) {
  const ScriptTable x = read_table(folder / (name + "_x.csv")),
                    y = read_table(folder / (name + "_y.csv")),
                    summary = read_table(folder / (name + "_summary.csv"), 1),
                    contact = read_table(folder / (name + "_contact.csv"));
  ElasticAnswer answer;
  answer.u.resize(space.size());
  answer.u << x.column("u")(match(space.x.dof_coordinates(), places(x))),
      y.column("u")(match(space.y.dof_coordinates(), places(y)));
  answer.road = summary.names.at(0);
  answer.force = contact.column("force")(by_x(contact));
  answer.energy = summary.column("energy")(0);
  answer.residual = summary.column("residual")(0);
  answer.seconds = summary.column("seconds")(0);
  return answer;
}

ElasticAnswer friction_answer(const std::filesystem::path& folder, const std::string& name,
                              const VectorSpace& space) {
  ElasticAnswer answer = elastic_answer(folder, name, space);
  const ScriptTable floor = read_table(folder / (name + "_floor.csv"));
  const Eigen::VectorXd normal = answer.force, tangential = floor.column("force")(by_x(floor));
  answer.force.resize(normal.size() + tangential.size());
  answer.force << normal, tangential;
  return answer;
}

double taylor_hood_force(const std::filesystem::path& folder) {
  return read_table(folder / "TaylorHood_summary.csv", 1).column("force")(0);
}

void run_plate(const TriangleMesh& mesh, double epsilon, const std::filesystem::path& folder) {
  const auto file = folder / "mesh.freefem.msh";
  write_freefem_mesh(file, mesh);
  run("27_plate", {"-mesh", file, "-epsilon", fmt::format("{}", epsilon), "-out", folder});
}

PlateAnswer plate_answer(const std::filesystem::path& folder, const std::string& name,
                         const Space& deflection) {
  const ScriptTable values = read_table(folder / (name + ".csv")),
                    summary = read_table(folder / (name + "_summary.csv"), 1);
  const std::vector<int> order = match(deflection.dof_coordinates(), places(values));
  return {summary.names.at(0), values.column("u")(order), values.column("force")(order),
          summary.column("energy")(0), summary.column("seconds")(0)};
}

Comparison compare(const Space& space, const VariationalInequality& problem, const Solution& ours,
                   const Result& theirs) {
  Comparison c;
  c.difference = (ours.u - theirs.u).cwiseAbs().maxCoeff() / ours.u.cwiseAbs().maxCoeff();
  const double j = energy(problem, ours);
  c.energy = std::abs(j - theirs.energy) / std::abs(j);
  if (problem.bounds.unknowns.empty()) return c;
  if (theirs.gap.size() != static_cast<Eigen::Index>(problem.bounds.unknowns.size()))
    throw Error(fmt::format("compare: {} contact unknowns here, {} there",
                            problem.bounds.unknowns.size(), theirs.gap.size()));
  const Eigen::MatrixX3d table = contact_table({space, problem, ours});  // x, gap, pressure
  for (Eigen::Index i = 0; i < table.rows(); ++i) {
    const bool undecided = std::max({std::abs(table(i, 1)), std::abs(theirs.gap(i)),
                                     std::abs(table(i, 2)), std::abs(theirs.pressure(i))}) < 1e-10;
    if (!undecided && ours.active[i] != (theirs.pressure(i) != 0))
      ++c.contact_disagree;  // exactly 0 where free
  }
  return c;
}

}  // namespace antilock::freefem
