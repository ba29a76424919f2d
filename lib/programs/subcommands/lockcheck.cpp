// antilock lockcheck A1.mtx B.mtx M.mtx LOAD.mtx: whether the matrices of another program lock.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "antilock/analysis/locking.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/io/write_csv.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "programs/program.hpp"
#include "programs/subcommands/csv_reader.hpp"
#include "programs/subcommands/matrix_market.hpp"
#include "programs/subcommands/subcommands.hpp"

namespace antilock::subcommands {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The files of one problem; empty: not given.
struct Files {
  std::filesystem::path a1, b, m, load, fixed, bounds;
};

/// A row of a CSV file whose first column is an unknown.
struct UnknownRow {
  std::string place;       ///< for messages, "bounds.csv: line 3: unknown 7"
  Eigen::VectorXd values;  ///< the columns after the first
};

/// The rows of a file by unknown, in ascending order. Throws Error for a number that is no unknown,
/// or one for the second time.
std::map<int, UnknownRow> by_unknown(const std::filesystem::path& path,
                                     const std::vector<std::string>& header, Eigen::Index size,
                                     const CsvForm& form = {}) {
  const auto [numbers, line] = read_csv_table(path.string(), header, form);
  std::map<int, UnknownRow> rows;
  for (Eigen::Index i = 0; i < numbers.rows(); ++i) {
    const double number = numbers(i, 0);
    const std::string place =
        fmt::format("{}: line {}: unknown {}", path.string(), line[std::size_t(i)], number);
    if (number != std::floor(number) || number < 0 || number >= double(size))
      throw Error(fmt::format("{}; accepted: whole numbers from 0 to {}", place, size - 1));
    if (!rows.emplace(static_cast<int>(number),
                      UnknownRow{place, numbers.row(i).tail(numbers.cols() - 1)})
             .second)
      throw Error(place + " for the second time; accepted: one row per unknown");
  }
  return rows;
}

void read_fixed(const std::filesystem::path& path, VariationalInequality& problem) {
  std::map<int, double> values;
  for (const auto& [unknown, row] : by_unknown(path, {"unknown", "value"}, problem.a1.rows()))
    values[unknown] = row.values(0);
  set_dirichlet(problem, values);
}

/// The bounds of the unknowns that are not fixed. A side that is infinite, or as large as no u is,
/// bounds nothing; the bounds of a fixed unknown hold its value and bound nothing either.
void read_bounds(const std::filesystem::path& path, VariationalInequality& problem) {
  std::map<int, double> fixed;
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
    fixed[problem.dirichlet_dofs[i]] = problem.dirichlet_values(static_cast<Eigen::Index>(i));
  const CsvForm form{.optional_columns = 1, .infinite = true};
  std::vector<int> bounded;
  std::vector<double> lower, upper;
  for (const auto& [unknown, row] :
       by_unknown(path, {"unknown", "lower", "upper"}, problem.a1.rows(), form)) {
    const double low = bound_or_infinity(row.values(0));
    const double high = bound_or_infinity(row.values.size() > 1 ? row.values(1) : infinity);
    if (!(low <= high && low < infinity && high > -infinity))
      throw Error(fmt::format(
          "{} is bounded from {} to {}; accepted: lower <= upper, -inf below or inf above for none",
          row.place, low, high));
    const auto value = fixed.find(unknown);
    if (value != fixed.end() && !(low <= value->second && value->second <= high))
      throw Error(fmt::format(
          "{} is bounded from {} to {}, but fixed at {}; accepted: bounds that hold this value, or "
          "no row",
          row.place, low, high, value->second));
    if (value != fixed.end() || (low == -infinity && high == infinity)) continue;
    bounded.push_back(unknown);
    lower.push_back(low);
    upper.push_back(high);
  }
  const auto given = [](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  problem.bounds = {bounded, {given(lower), given(upper)}};
}

VariationalInequality read_problem(const Files& files) {
  VariationalInequality problem;
  problem.a1 = read_matrix(files.a1.string());
  problem.b = read_matrix(files.b.string());
  problem.m = read_vector(files.m.string());
  const Eigen::Index n = problem.a1.rows();
  problem.load = files.load.empty() ? Eigen::VectorXd::Zero(n) : read_vector(files.load.string());
  if (!files.fixed.empty()) read_fixed(files.fixed, problem);
  if (!files.bounds.empty()) read_bounds(files.bounds, problem);
  try {
    check(problem);
  } catch (const Error& error) {
    throw Error(fmt::format("{}, {}, {}: {}", files.a1.string(), files.b.string(), files.m.string(),
                            error.what()));
  }
  return problem;
}

void add_files(CLI::App& line, Files& files, const std::string& prefix) {
  line.add_option(prefix + "fixed", files.fixed,
                  "CSV unknown,value: what is prescribed; unknowns count from 0");
  line.add_option(
      prefix + "bounds", files.bounds,
      "CSV unknown,lower or unknown,lower,upper: what is bounded; -inf and inf for none");
}

/// The solutions as the compliance tends to 0.
struct ComplianceTable {
  Table table{std::vector<std::string>{"compliance", "energy", "largest_u", "corrections", "kkt"}};
  /// compliance, unknown, u, lambda; lambda is the force of a bound, 0 where there is none.
  Eigen::MatrixXd answers = Eigen::MatrixXd(0, 4);
};

/// `load_file`: for the message where an energy is not finite.
ComplianceTable solve_all(const VariationalInequality& problem, const std::string& load_file) {
  Sweep sweep(problem);
  ComplianceTable found;
  const Eigen::Index n = problem.size();
  for (const double compliance : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 0.0}) {
    sweep.set_compliance(compliance);
    const Solution solution = sweep.solve();
    const double j = energy(sweep.problem(), solution);
    if (!std::isfinite(j))
      throw Error(fmt::format(
          "{}: the energy of the answer is {}; accepted: a load whose energy is a number",
          load_file, j));
    const double largest = solution.u.lpNorm<Eigen::Infinity>();
    found.table.add({compliance, j, largest, solution.counters.corrections, solution.kkt.residual});
    found.answers.conservativeResize(found.answers.rows() + n, Eigen::NoChange);
    auto rows = found.answers.bottomRows(n);
    rows.col(0).setConstant(compliance);
    rows.col(1) = Eigen::VectorXd::LinSpaced(n, 0, double(n - 1));
    rows.col(2) = solution.u;
    rows.col(3).setZero();
    rows(problem.bounds.unknowns, 3) = solution.lambda;
  }
  return found;
}

}  // namespace

int lockcheck(int argc, char** argv) {
  CLI::App line(
      "Whether a discretisation locks, from its matrices alone: a1(u, v) + compliance^-1 (B u, M B "
      "v) = L(v), with "
      "bounds. "
      "Prints the diagnosis, and with a load the answers for compliance 1 to 0.",
      "antilock lockcheck");
  Files files, finer;
  std::filesystem::path out;
  line.add_option("A1", files.a1, "Matrix Market, N x N, symmetric")->required();
  line.add_option("B", files.b, "Matrix Market, R x N: one row per strain that becomes stiff")
      ->required();
  line.add_option("M", files.m,
                  "Matrix Market, R entries, positive: one per row of B (areas of cells)")
      ->required();
  line.add_option("LOAD", files.load, "Matrix Market, N entries");
  add_files(line, files, "--");
  std::vector<std::filesystem::path> fine;
  line.add_option("--finer", fine,
                  "A1 B M of the same discretisation on a finer mesh: only two show what grows")
      ->expected(3);
  add_files(line, finer, "--finer-");
  line.add_option("--out", out,
                  "CSV compliance,unknown,u,lambda of the answers; lambda is the force of a bound, "
                  "0 where there is none");
  line.footer(
      "Export with scipy: scipy.io.mmwrite(\"A1.mtx\", A1). Keep the stiff form in factors: B and "
      "M, never B' M B.");
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;

  check_not_an_input(out, {files.a1, files.b, files.m, files.load, files.fixed, files.bounds});
  check_not_an_input(out, fine);
  const VariationalInequality problem = read_problem(files);
  if (problem.b.rows() == 0)
    throw Error(files.b.string() + ": no row: nothing becomes stiff; accepted: a B with rows");
  if (files.load.empty() && fine.empty())
    throw Error(
        "antilock lockcheck: nothing to do: one mesh without a load tells nothing; accepted: a "
        "LOAD, --finer, or both");
  std::string diagnosis;
  if (!fine.empty()) {
    finer.a1 = fine[0];
    finer.b = fine[1];
    finer.m = fine[2];
    diagnosis = diagnose_locking(problem, read_problem(finer)).text();
  }
  if (files.load.empty()) {
    fmt::print("{}\n", diagnosis);
    return 0;
  }

  const ComplianceTable found = solve_all(problem, files.load.string());
  if (!diagnosis.empty()) fmt::print("{}\n", diagnosis);
  found.table.print("the answers as the compliance tends to 0");
  if (!out.empty()) write_csv(out, {"compliance", "unknown", "u", "lambda"}, found.answers);
  return 0;
}

}  // namespace antilock::subcommands
