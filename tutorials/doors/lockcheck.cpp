// antilock lockcheck A1.mtx B.mtx M.mtx LOAD.mtx: whether the matrices of another program lock.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "antilock/analysis/locking.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"
#include "doors/csv_reader.hpp"
#include "doors/doors.hpp"
#include "doors/matrix_market.hpp"

namespace antilock::doors {
namespace {

/// The files of one problem; empty: not given.
struct Files {
  std::filesystem::path a1, b, m, load, fixed, bounds;
};

int unknown(const std::filesystem::path& path, double number, Eigen::Index size) {
  if (number != std::floor(number) || number < 0 || number >= double(size))
    throw Error(fmt::format("{}: unknown {}; accepted: whole numbers from 0 to {}", path.string(), number, size - 1));
  return static_cast<int>(number);
}

/// Rows of a CSV by unknown, ascending; the columns after the first are optional from the right.
Eigen::MatrixXd by_unknown(const std::filesystem::path& path, std::vector<std::string> header, Eigen::Index size) {
  std::ifstream in(path);
  if (!in) throw Error(path.string() + ": cannot be opened; accepted: a CSV file");
  std::string first;
  std::getline(in, first);
  if (header.size() == 3 && std::count(first.begin(), first.end(), ',') == 1) header.pop_back();
  Eigen::MatrixXd rows = read_csv(path.string(), header);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(rows.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Eigen::Index i, Eigen::Index j) { return rows(i, 0) < rows(j, 0); });
  Eigen::MatrixXd sorted = rows(order, Eigen::all);
  for (Eigen::Index i = 0; i < sorted.rows(); ++i) unknown(path, sorted(i, 0), size);
  return sorted;
}

VariationalInequality read_problem(const Files& files) {
  VariationalInequality problem;
  problem.a1 = read_matrix(files.a1.string());
  problem.b = read_matrix(files.b.string());
  problem.m = read_vector(files.m.string());
  const Eigen::Index n = problem.a1.rows();
  problem.load = files.load.empty() ? Eigen::VectorXd::Zero(n) : read_vector(files.load.string());
  if (!files.fixed.empty()) {
    const Eigen::MatrixXd rows = by_unknown(files.fixed, {"unknown", "value"}, n);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) problem.fixed.push_back(static_cast<int>(rows(i, 0)));
    problem.fixed_values = rows.col(1);
  }
  if (!files.bounds.empty()) {
    const Eigen::MatrixXd rows = by_unknown(files.bounds, {"unknown", "lower", "upper"}, n);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) problem.contact.push_back(static_cast<int>(rows(i, 0)));
    problem.lower = rows.col(1);
    if (rows.cols() == 3) problem.upper = rows.col(2);
  }
  try {
    check(problem);
  } catch (const Error& error) {
    throw Error(fmt::format("{}, {}, {}: {}", files.a1.string(), files.b.string(), files.m.string(), error.what()));
  }
  return problem;
}

void add_files(CLI::App& line, Files& files, const std::string& prefix) {
  line.add_option(prefix + "fixed", files.fixed, "CSV unknown,value: what is prescribed; unknowns count from 0");
  line.add_option(prefix + "bounds", files.bounds, "CSV unknown,lower or unknown,lower,upper: what is bounded");
}

}  // namespace

int lockcheck(int argc, char** argv) {
  CLI::App line(
      "Whether a discretisation locks, from its matrices alone: a1(u, v) + compliance^-1 (B u, M B v) = L(v), with "
      "bounds. "
      "Prints the diagnosis, and with a load the answers for compliance 1 to 0.",
      "antilock lockcheck");
  Files files, finer;
  std::filesystem::path out;
  line.add_option("A1", files.a1, "Matrix Market, N x N, symmetric")->required();
  line.add_option("B", files.b, "Matrix Market, R x N: one row per strain that becomes stiff")->required();
  line.add_option("M", files.m, "Matrix Market, R entries, positive: one per row of B (areas of cells)")->required();
  line.add_option("LOAD", files.load, "Matrix Market, N entries");
  add_files(line, files, "--");
  std::vector<std::filesystem::path> fine;
  line.add_option("--finer", fine, "A1 B M of the same discretisation on a finer mesh: only two show what grows")
      ->expected(3);
  add_files(line, finer, "--finer-");
  line.add_option(
      "--out", out,
      "CSV compliance,unknown,u,lambda of the answers; lambda is the force of a bound, 0 where there is none");
  line.footer(
      "Export with scipy: scipy.io.mmwrite(\"A1.mtx\", A1). Keep the stiff form in factors: B and M, never B' M B.");
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;

  const VariationalInequality problem = read_problem(files);
  if (problem.b.rows() == 0) throw Error(files.b.string() + ": no row: nothing becomes stiff; accepted: a B with rows");
  if (files.load.empty() && fine.empty())
    throw Error(
        "antilock lockcheck: nothing to do: one mesh without a load tells nothing; accepted: a LOAD, --finer, or both");
  std::string diagnosis;
  if (!fine.empty()) {
    finer.a1 = fine[0], finer.b = fine[1], finer.m = fine[2];
    diagnosis = diagnose_locking(problem, read_problem(finer)).text();
  }
  if (files.load.empty()) {
    fmt::print("{}\n", diagnosis);
    return 0;
  }

  Sweep sweep(problem);
  Table table({"compliance", "energy", "largest_u", "corrections", "kkt"});
  const Eigen::Index n = problem.size();
  Eigen::MatrixXd answers(0, 4);
  for (const double compliance : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 0.0}) {
    sweep.set_compliance(compliance);
    const Solution solution = sweep.solve();
    const double j = energy(sweep.problem(), solution);
    if (!std::isfinite(j))
      throw Error(fmt::format("{}: the energy of the answer is {}; accepted: a load whose energy is a number",
                              files.load.string(), j));
    table.add(
        {compliance, j, solution.u.lpNorm<Eigen::Infinity>(), solution.counters.corrections, solution.kkt.residual});
    answers.conservativeResize(answers.rows() + n, Eigen::NoChange);
    auto rows = answers.bottomRows(n);
    rows << Eigen::VectorXd::Constant(n, compliance), Eigen::VectorXd::LinSpaced(n, 0, double(n - 1)), solution.u,
        Eigen::VectorXd::Zero(n);
    rows(problem.contact, 3) = solution.lambda;
  }
  if (!diagnosis.empty()) fmt::print("{}\n", diagnosis);
  table.print("the answers as the compliance tends to 0");
  if (!out.empty()) write_csv(out, {"compliance", "unknown", "u", "lambda"}, answers);
  return 0;
}

}  // namespace antilock::doors
