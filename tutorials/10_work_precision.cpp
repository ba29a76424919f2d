// What accuracy costs in time: the error against wall seconds, and where the seconds go.
//
// Run: 10_work_precision                         h from 1/8 to 1/64; half a minute
// Run: 10_work_precision --cells 128 --limit 20  h from 1/8 to 1/128; minutes (figures/benchmark does this)
// Run: 10_work_precision --freefem freefem/run   FreeFEM's active set beside them, the stiff part summed as it comes
//
// A method is an element, a kind of mesh and a solver. Three solvers of (23): the primal-dual active set on Gamma_C,
// Uzawa with a Cholesky factor, and Uzawa as the paper ran it, with conjugate gradients and ILUT. Each point is the
// median of at least five runs; what fails, or takes longer than the limit, stands in the table as failed.
//
// Files: work_precision.csv (one row a run: element, mesh, solver, epsilon, cells, unknowns, status ok or failed,
// seconds and their least and largest, mesh_seconds apart, iterations, errors absolute: max_at_unknowns, max, h1,
// energy, the last three 0 for FreeFEM; scale, the largest |u|; why), price_list.csv and price_list.md, stages.csv
// (seconds by stage over 1/h), stopping.csv (below), machine.csv.
//
// Stop when it is accurate enough. P1 minimises J over a part of K, so J(u_P1) >= J(u); Crouzeix-Raviart comes from
// below (measured; the reason is that it relaxes continuity). The bracket (J(u_P1) - J(u_CR)) / |J| is of order h^2,
// like the error: Uzawa's steps far below it buy nothing. Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <map>
#include <thread>

#include "antilock/exact/truth_table.hpp"
#include "antilock/io/atomic_file.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/problem/assemble.hpp"
#include "antilock/scene/error.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

constexpr std::array epsilons{1.0, 1e-2, 1e-6};
constexpr int repeats = 5;

struct Row {
  std::string element, mesh, solver;
  double epsilon;
  int cells, unknowns = 0, iterations = 0;
  bool ok = true;
  double seconds = 0, least = 0, most = 0, mesh_seconds = 0;
  Errors errors{};
  double scale = 0;  // largest |u_h|: what makes an error relative
  std::string why;
  std::string method() const { return element + " " + mesh + ", " + solver; }
  double relative() const { return errors.max_at_unknowns / scale; }
};

// The solvers by name. Assembly is not counted: it is the same for all of them.
Solution solve(const std::string& solver, const VariationalInequality& problem, double limit) {
  UzawaOptions options;
  options.max_seconds = limit;
  if (solver == "active set") return active_set(problem);
  return solver == "Uzawa, Cholesky" ? uzawa(problem, options) : uzawa_cg_ilut(problem, options);
}

void note_seconds(Row& row, std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  row.least = seconds.front();
  row.most = seconds.back();
  row.seconds = seconds[seconds.size() / 2];
}

Row measure(Row row, const Space& space, const VariationalInequality& problem, const TruthTable& truth, double limit) {
  row.unknowns = problem.free_count();
  std::vector<double> seconds;
  const Stopwatch since_start;
  try {
    Solution solution;
    for (int run = 0; run < repeats; ++run) {
      const Stopwatch watch;
      solution = solve(row.solver, problem, limit);
      seconds.push_back(watch.seconds());
      // a run that took longer than the limit counts as a failure, even where its answer is good
      if (seconds.back() > limit) throw NotConverged("took longer than the limit", 1, 0);
    }
    row.iterations = solution.counters.contact;
    row.errors = measure_errors(space, solution, row.epsilon, reference(truth));
    row.scale = solution.u.cwiseAbs().maxCoeff();
    note_seconds(row, seconds);
  } catch (const Error& failure) {
    row.ok = false;
    row.seconds = row.least = row.most = since_start.seconds();
    row.why = failure.what();
    std::replace(row.why.begin(), row.why.end(), ',', ';');  // one field of the table
  }
  return row;
}

// FreeFEM's script on the same mesh, the stiff part summed as a plain script does; its own clock, without start-up and
// reading the mesh. Its error is at the unknowns, the only values that its file holds.
Row run_freefem(Row row, const std::string& command, const Space& space, const TruthTable& truth, double limit,
                const std::filesystem::path& folder) {
  row.solver = "FreeFEM, active set";
  row.unknowns = space.free_count();
  std::filesystem::create_directories(folder);
  write_freefem_mesh(folder / "mesh.freefem.msh", space.mesh());
  const std::string script = row.element == "P1" ? "04_p1_structured" : "06_crouzeix_raviart";
  const std::string line =
      fmt::format("timeout {} '{}' {} -mesh '{}' -out '{}' -epsilon {} -stiff sum > /dev/null 2>&1", limit + 5, command,
                  script, (folder / "mesh.freefem.msh").string(), folder.string(), row.epsilon);
  std::vector<double> seconds;
  for (int run = 0; run < repeats && row.ok; ++run) {
    row.ok = std::system(line.c_str()) == 0;
    std::ifstream summary(folder / "summary.csv");
    std::string text;
    std::getline(summary, text);
    if (row.ok && std::getline(summary, text)) seconds.push_back(std::stod(text.substr(text.rfind(',') + 1)));
  }
  row.ok = row.ok && !seconds.empty();
  if (!row.ok) {
    row.why = "failed or took longer than the limit";
    row.seconds = row.least = row.most = limit;
    return row;
  }
  note_seconds(row, seconds);
  std::ifstream solution(folder / "solution.csv");
  std::string text;
  std::getline(solution, text);
  double x = 0, y = 0, u = 0;
  for (char comma = 0; solution >> x >> comma >> y >> comma >> u;) {
    row.errors.max_at_unknowns = std::max(row.errors.max_at_unknowns, std::abs(u - truth.value(x, y)));
    row.scale = std::max(row.scale, std::abs(u));
  }
  return row;
}

void write_rows(const std::filesystem::path& path, const std::vector<Row>& rows) {
  write_file(path, [&](std::ostream& out) {
    out << "element,mesh,solver,epsilon,cells,unknowns,status,seconds,least,most,mesh_seconds,iterations,max_at_"
           "unknowns,max,h1,energy,"
           "scale,why\n";
    for (const Row& r : rows)
      out << fmt::format(
          "{},{},\"{}\",{:g},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}\n",
          r.element, r.mesh, r.solver, r.epsilon, r.cells, r.unknowns, r.ok ? "ok" : "failed", r.seconds, r.least,
          r.most, r.mesh_seconds, r.iterations, r.errors.max_at_unknowns, r.errors.max, r.errors.h1, r.errors.energy,
          r.scale, r.why);
  });
}

// The cheapest measured run within each tolerance; "locked" where the error hardly falls from mesh to mesh, so that no
// mesh of use will do; "beyond" where a finer mesh than measured would.
void write_price_list(const std::filesystem::path& folder, const std::vector<Row>& rows) {
  std::map<std::pair<std::string, double>, std::vector<Row>> by_method;
  for (const Row& row : rows) by_method[{row.method(), -row.epsilon}].push_back(row);
  std::string csv = "method,epsilon,tolerance,seconds,unknowns,outcome\n";
  std::string page = "| method | epsilon | 1e-2 | 1e-3 | 1e-4 |\n|---|---|---|---|---|\n";
  for (const auto& [key, runs] : by_method) {
    std::vector<Row> good;
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(good), [](const Row& r) { return r.ok; });
    const bool locked = good.size() > 1 && good.back().relative() > 0.9 * good[good.size() - 2].relative();
    page += fmt::format("| {} | {:g} |", key.first, -key.second);
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
      const Row* cheapest = nullptr;
      for (const Row& r : good)
        if (r.relative() <= tolerance && (cheapest == nullptr || r.seconds < cheapest->seconds)) cheapest = &r;
      const std::string outcome = cheapest != nullptr ? "reached"
                                  : locked            ? "never"
                                  : good.empty()      ? "failed"
                                                      : "beyond";
      csv += fmt::format("\"{}\",{:g},{:g},{:.6g},{},{}\n", key.first, -key.second, tolerance,
                         cheapest ? cheapest->seconds : 0, cheapest ? cheapest->unknowns : 0, outcome);
      page += cheapest ? fmt::format(" {:.2g} s, {} |", cheapest->seconds, cheapest->unknowns) : " " + outcome + " |";
    }
    page += "\n";
  }
  write_file(folder / "price_list.csv", [&](std::ostream& out) { out << csv; });
  write_file(folder / "price_list.md", [&](std::ostream& out) { out << page; });
  fmt::print("\nThe price list: seconds and unknowns within a relative error at the unknowns of ...\n{}\n", page);
}

void write_machine(const std::filesystem::path& path) {
  std::ifstream info("/proc/cpuinfo");
  std::string processor = "unknown", line;
  while (std::getline(info, line))
    if (line.starts_with("model name")) processor = line.substr(line.find(':') + 2);
  std::array<char, 32> date{};
  const std::time_t now = std::time(nullptr);
  std::strftime(date.data(), date.size(), "%F %T UTC", std::gmtime(&now));
  const char* blas_threads = std::getenv("OPENBLAS_NUM_THREADS");
  write_file(path, [&](std::ostream& out) {
    out << "processor,cores,blas_threads,compiler,eigen,cholmod,date\n"
        << fmt::format("\"{}\",{},{},\"{}\",{}.{}.{},{}.{}.{},{}\n", processor, std::thread::hardware_concurrency(),
                       blas_threads ? blas_threads : "all", __VERSION__, EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION,
                       EIGEN_MINOR_VERSION, CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION,
                       date.data());
  });
}

// Where the time goes: P1, structured, active set, epsilon = 1e-6.
void write_stages(const std::filesystem::path& folder, int finest) {
  std::vector<Eigen::VectorXd> rows;
  for (int n = 16; n <= finest; n *= 2) {
    Stopwatch watch;
    const TriangleMesh mesh = structured_mesh(n);
    const Space space(mesh, p1());
    const double mesh_seconds = watch.lap();
    const VariationalInequality problem =
        assemble(Scene(Body{paper_load}, StiffLayer{1e-6}, UnilateralContact{}), space);
    const double assembly = watch.lap();
    const Solution solution = active_set(problem);
    const double rest = watch.lap() - solution.seconds.total();
    write_solution_csv(folder / "stages_solution.csv", space, solution.u);
    const double output = watch.lap();
    std::filesystem::remove(folder / "stages_solution.csv");
    const SolveSeconds& s = solution.seconds;
    rows.emplace_back(
        Eigen::VectorXd{{1.0 * n, mesh_seconds, assembly, s.analyse, s.factor, s.contact, s.solve, rest, output}});
  }
  Eigen::MatrixXd table(static_cast<Eigen::Index>(rows.size()), 9);
  for (std::size_t i = 0; i < rows.size(); ++i) table.row(static_cast<Eigen::Index>(i)) = rows[i];
  write_csv(folder / "stages.csv",
            {"cells", "mesh", "assembly", "analyse", "factor", "contact", "corrections", "rest", "output"}, table);
}

// Uzawa stopped at a hundredth of the relative energy bracket against Uzawa to the last digit.
void stop_early(const tutorial::Options& options, tutorial::Report& report, const TriangleMesh& mesh,
                const TruthTable& truth) {
  const Scene scene(Body{paper_load}, StiffLayer{1e-2}, UnilateralContact{});
  const Space conforming(mesh, p1()), nonconforming(mesh, crouzeix_raviart());
  const VariationalInequality problem = assemble(scene, conforming), other = assemble(scene, nonconforming);
  const double above = energy(problem, active_set(problem)), below = energy(other, active_set(other));
  const double bracket = (above - below) / std::abs(above);
  std::vector<Eigen::VectorXd> rows;
  for (const double tolerance : {1e-10, 0.01 * bracket}) {
    UzawaOptions uzawa_options;
    uzawa_options.tolerance = tolerance;
    const Stopwatch watch;
    const Solution solution = uzawa(problem, uzawa_options);
    const double seconds = watch.seconds(), error = measure_errors(conforming, solution, 1e-2, reference(truth)).max;
    rows.emplace_back(Eigen::VectorXd{{tolerance, 1.0 * solution.counters.contact, seconds, error}});
  }
  const Eigen::MatrixXd table = (Eigen::MatrixXd(2, 4) << rows[0].transpose(), rows[1].transpose()).finished();
  write_csv(options.out / "stopping.csv", {"tolerance", "steps", "seconds", "max"}, table);
  report.claim(bracket > 0 && rows[1](1) < rows[0](1) && rows[1](3) < 1.05 * rows[0](3),
               fmt::format("accurate enough: Uzawa stopped at 1 % of the energy bracket {:.1e} takes {:.0f} steps, not "
                           "{:.0f}; its error {:.3e}, not {:.3e}",
                           bracket, rows[1](1), rows[0](1), rows[1](3), rows[0](3)));
}

void study(const tutorial::Options& options, tutorial::Report& report, double limit, const std::string& freefem) {
  report.stage("truth for three epsilons");
  std::map<double, TruthTable> truth;
  for (const double epsilon : epsilons) truth.emplace(epsilon, TruthTable(Truth(paper_sine_load(), epsilon)));

  std::vector<Row> rows;
  for (int n = 8; n <= options.cells; n *= 2)
    for (const std::string kind : {"structured", "unstructured"}) {
      report.stage(fmt::format("1/h = {}, {}", n, kind));
      const Stopwatch watch;
      const TriangleMesh mesh = kind == "structured" ? structured_mesh(n) : unstructured_mesh(n);
      const double mesh_seconds = watch.seconds();
      for (const std::string name : {"P1", "CR"}) {
        const Space space(mesh, element(name));
        for (const double epsilon : epsilons) {
          const Scene scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
          const VariationalInequality problem = assemble(scene, space);
          Row row{};
          row.element = name;
          row.mesh = kind;
          row.epsilon = epsilon;
          row.cells = n;
          row.mesh_seconds = mesh_seconds;
          for (const std::string solver : {"active set", "Uzawa, Cholesky", "Uzawa, CG + ILUT"}) {
            row.solver = solver;
            rows.push_back(measure(row, space, problem, truth.at(epsilon), limit));
          }
          if (!freefem.empty())
            rows.push_back(run_freefem(row, freefem, space, truth.at(epsilon), limit, options.out / "freefem"));
        }
      }
    }
  report.stage("where the time goes");
  write_stages(options.out, std::max(128, options.cells));
  report.finish();
  write_rows(options.out / "work_precision.csv", rows);
  write_machine(options.out / "machine.csv");
  write_price_list(options.out, rows);

  // The verdicts: nothing about seconds, which depend on the machine; errors and counts alone.
  bool reliable = true, agree = true;
  std::map<std::pair<std::string, double>, double> finest;
  for (const Row& r : rows) {
    if (r.solver == "active set") reliable = reliable && r.ok;
    if (r.cells * 2 > options.cells && r.solver == "active set" && r.ok)
      finest[{r.element + " " + r.mesh, r.epsilon}] = r.relative();
  }
  for (const Row& r : rows)
    for (const Row& a : rows)
      if (a.solver == "active set" && r.solver == "Uzawa, Cholesky" && r.ok && a.element == r.element &&
          a.mesh == r.mesh && a.epsilon == r.epsilon && a.cells == r.cells)
        agree = agree && std::abs(a.errors.max - r.errors.max) <= 1e-3 * a.errors.max;
  report.claim(reliable, "the active set answers on every mesh and at every epsilon");
  report.claim(agree, "where Uzawa ends within its limit, its error is that of the active set");
  const double locked = finest[{"P1 unstructured", 1e-6}], free = finest[{"CR unstructured", 1e-6}];
  report.claim(locked > 5 * free, fmt::format("no time buys accuracy from P1 on the unstructured mesh at epsilon = "
                                              "1e-6: {:.1e} relative, Crouzeix-Raviart {:.1e}",
                                              locked, free));
  stop_early(options, report, structured_mesh(options.cells), truth.at(1e-2));
}

// Three things to try:
// - --limit 60: Uzawa as in the paper ends on more meshes, and the price list says what that costs.
// - OPENBLAS_NUM_THREADS=1 in front: small meshes are faster on one thread.
// - 1e-1 among the epsilons: P1 on unstructured meshes already lags there, and its price shows it.
int main(int argc, char** argv) {
  double limit = 0.3;
  std::string freefem;
  tutorial::Options options;
  options.cells = 64;
  options.add = [&](CLI::App& app) {
    app.add_option("--limit", limit, "seconds after which a run counts as failed")->capture_default_str();
    app.add_option("--freefem", freefem, "the command freefem/run, to measure FreeFEM's script too");
  };
  return tutorial::run(argc, argv, "10_work_precision", "What accuracy costs in time", options,
                       [&](const tutorial::Options& o, tutorial::Report& r) { study(o, r, limit, freefem); });
}
