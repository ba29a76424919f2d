#pragma once
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/exact/exact_solution.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/flexibility.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"
#include "course/markdown.hpp"
#include "course/median_seconds.hpp"
#include "programs/report.hpp"

namespace antilock::tutorial {

/// The problem on Gamma_C: s = w + F lambda, s >= 0.
struct OnContact {
  Eigen::MatrixXd f;  ///< C x C
  Eigen::VectorXd w;  ///< C
};

/// The answer of one solver on Gamma_C.
struct Found {
  Eigen::VectorXd s, lambda;  ///< C
  int steps = 0;  ///< linear systems, or products with F or K where none is solved
  int outer = 0;  ///< outer steps of a method with two loops
  std::vector<bool> active = {};             ///< C, of the active set
  Eigen::VectorXd latent = {};               ///< C, of proximal Galerkin as published
  std::vector<Eigen::VectorXd> shapes = {};  ///< s in each step, where a picture shows them
};

/// Condenses a problem on Gamma_C. A flexibility that is round-off is set to 0, and so is
/// the value that no force moves.
inline OnContact condense(const VariationalInequality& problem) {
  VariationalInequality linear = problem;
  linear.bounds = {};
  PenalisedCholesky factor(linear);
  Flexibility flexibility =
      LinearResponse(problem, factor, {.tolerance = 1e-12}).flexibility();
  for (Eigen::Index i = 0; i < flexibility.w.size(); ++i)
    if (flexibility.is_fixed(i)) {
      flexibility.f.row(i).setZero();
      flexibility.f.col(i).setZero();
      flexibility.w(i) = 0;
    }
  return {std::move(flexibility.f), std::move(flexibility.w)};
}

/// Returns the largest |w_i|, by which changes of s are divided, or 1 if w is 0.
inline double size_of(const OnContact& p) {
  const double size = p.w.lpNorm<Eigen::Infinity>();
  return size > 0 ? size : 1;
}

/// Returns the indices of the marks that are true.
inline std::vector<int> members(const std::vector<bool>& marks) {
  std::vector<int> set;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i]) set.push_back(static_cast<int>(i));
  return set;
}

/// Solves a symmetric positive definite system. Throws NotConverged where the matrix is not
/// positive definite.
inline Eigen::VectorXd solve_positive(const Eigen::MatrixXd& matrix,
                                      const Eigen::VectorXd& right,
                                      const std::string& solver) {
  const Cholesky factor(matrix);
  if (!factor.positive_definite())
    throw NotConverged(solver + ": the matrix of a step is singular", 1, 0);
  return factor.solve(right);
}

/// Counts a step. Throws NotConverged after `most` steps.
inline void count_step(Found& found, const std::string& solver, int most) {
  if (++found.steps > most)
    throw NotConverged(fmt::format("{}: not converged after {} steps", solver, most), 1,
                       most);
}

/// Returns the largest share of a Newton step, at most 1, by which no psi grows by more
/// than
/// 8. So exp does not overflow.
inline double without_overflow(const Eigen::VectorXd& step) {
  return std::min(1.0, 8 / std::max(step.maxCoeff(), 1e-300));
}

/// The hats of the inner vertices i h of Gamma_C, i = 1 ... C, h = 1 / (C + 1), as
/// functions of the place t in (0, 1) of a cell k = 0 ... C. In the first and the last cell
/// the hats of the multiplier are constant: there left = right.
struct Cell {
  Cell(Eigen::Index k, Eigen::Index count)
      : left(std::max<Eigen::Index>(k - 1, 0)), right(std::min(k, count - 1)) {}
  Eigen::Index left, right;
};

/// The C integrals of exp(psi_h) over Gamma_C times each hat, and the C x C ones times the
/// products of two. psi_h is linear in each cell (Gauss's rule with 6 points).
struct Exponential {
  explicit Exponential(const Eigen::VectorXd& psi)
      : integrals(0 * psi), products(Eigen::MatrixXd::Zero(psi.size(), psi.size())) {
    const auto [points, weights] = gauss_rule(6);
    const double h = 1.0 / static_cast<double>(psi.size() + 1);
    for (Eigen::Index k = 0; k <= psi.size(); ++k)
      for (Eigen::Index q = 0; q < points.size(); ++q) {
        const Cell cell(k, psi.size());
        const double t = points(q);
        const double e =
            h * weights(q) * std::exp((1 - t) * psi(cell.left) + t * psi(cell.right));
        integrals(cell.left) += e * (1 - t);
        integrals(cell.right) += e * t;
        products(cell.left, cell.left) += e * (1 - t) * (1 - t);
        products(cell.left, cell.right) += e * (1 - t) * t;
        products(cell.right, cell.left) += e * (1 - t) * t;
        products(cell.right, cell.right) += e * t * t;
      }
  }
  Eigen::VectorXd integrals;
  Eigen::MatrixXd products;
};

/// Returns the C x C integrals of the hats of u, which are 0 at the ends, times those of
/// the multiplier. The matrix is symmetric.
inline Eigen::MatrixXd mass_matrix(Eigen::Index count) {
  const double h = 1.0 / static_cast<double>(count + 1);
  Eigen::MatrixXd mass = Eigen::VectorXd::Constant(count, 2 * h / 3).asDiagonal();
  mass.diagonal(1).setConstant(h / 6);
  mass.diagonal(-1).setConstant(h / 6);
  mass(0, 0) += h / 6;  // half a hat times 1 in place of itself: h / 2 - h / 3
  mass(count - 1, count - 1) += h / 6;
  return mass;
}

/// Returns the longest step along (ds, dl) that keeps s and lambda at 0 or above, at most
/// 1.
inline double longest_step(const Eigen::VectorXd& s, const Eigen::VectorXd& ds,
                           const Eigen::VectorXd& lambda, const Eigen::VectorXd& dl) {
  double step = 1;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    if (ds(i) < 0) step = std::min(step, -s(i) / ds(i));
    if (dl(i) < 0) step = std::min(step, -lambda(i) / dl(i));
  }
  return step;
}

/// Transfers the active set of a coarser mesh to one with `count` points: each point takes
/// over the status of the nearest one.
inline std::vector<bool> transfer(const std::vector<bool>& coarse, int count) {
  std::vector<bool> fine(count, false);
  const auto points = static_cast<int>(coarse.size());
  for (int i = 0; i < count && points > 0; ++i)
    fine[i] = coarse[(2 * i + 1) * points / (2 * count)];
  return fine;
}

/// Returns the part of a solution of the library that belongs to Gamma_C.
inline Found on_contact(const VariationalInequality& problem, const Solution& solution) {
  Found found{bounded_values(problem.bounds, solution.u), solution.lambda};
  found.steps = solution.counters.contact_iterations;
  found.outer = static_cast<int>(solution.history.size());
  return found;
}

/// Returns the first, second, fourth and last guess of the active set and step of proximal
/// Galerkin, on the vertices x_i = i / (C + 1) of Gamma_C.
inline Table shapes(const std::vector<Eigen::VectorXd>& guesses,
                    const std::vector<Eigen::VectorXd>& steps) {
  Table table({"x", "guess_1", "guess_2", "guess_4", "guess_last", "step_1", "step_2",
               "step_4", "step_last"});
  const Eigen::Index count = guesses.front().size();
  for (Eigen::Index i = -1; i <= count; ++i) {
    std::vector<TableEntry> row{static_cast<double>(i + 1) /
                                static_cast<double>(count + 1)};
    for (const auto* all : {&guesses, &steps})
      for (const std::size_t k :
           {std::size_t{0}, std::size_t{1}, std::size_t{3}, all->size() - 1}) {
        const Eigen::VectorXd& s = (*all)[std::min(k, all->size() - 1)];
        row.emplace_back(i < 0 || i == count ? 0.0 : s(i));
      }
    table.add(std::move(row));
  }
  return table;
}

/// The name under which the seconds of w and F are recorded.
inline const std::string condensation = "w and F";

/// All runs of the chapter.
struct Study {
  struct Run {
    std::string space, solver;
    double epsilon, h;
  };
  Table runs = Table({"space", "solver", "epsilon", "h", "steps", "outer", "seconds",
                      "error", "answer", "why"});
  Table prices = Table({"space", "solver", "epsilon", "h", "seconds"});
  Table meshes = Table({"space", "epsilon", "h", "unknowns", "relative"});
  int repeats = 1;  ///< runs of each solver, whose median is its time

  /// Adds a mesh with the relative error of u_h at the unknowns.
  void add_mesh(const Run& run, int unknowns, double relative) {
    meshes.add({run.space, run.epsilon, run.h, unknowns, relative});
  }
  void add_price(const Run& run, double seconds) {
    prices.add({run.space, run.solver, run.epsilon, run.h, seconds});
  }

  /// Runs a solver and compares its s with that of `exact`. The answer is "agrees", "0"
  /// where both are 0 to 1e-12, "differs", or "refuses". `error` is relative to the
  /// largest |s|. On a locked mesh s is a billionth of `unlocked`, the size without
  /// locking. The round-off of w and F is that of `unlocked`, so s = w + F lambda has nine
  /// digits less.
  void add(const Run& run, const Found& exact, double unlocked,
           const std::function<Found()>& solve) {
    const Stopwatch watch;
    try {
      Found found;
      const double seconds = median_seconds(repeats, [&] { found = solve(); });
      const double size = exact.s.lpNorm<Eigen::Infinity>();
      const double off = (found.s - exact.s).lpNorm<Eigen::Infinity>();
      const bool locked = size < 1e-12 && off < 1e-8;
      const double error = locked ? off : off / size;
      std::string answer =
          error < 1e-8 + 1e3 * 2.2e-16 * unlocked / size ? "agrees" : "differs";
      if (locked) answer = "0";
      add_price(run, seconds);
      runs.add({run.space, run.solver, run.epsilon, run.h, found.steps, found.outer,
                seconds, error, answer, ""});
    } catch (const NotConverged& failure) {
      runs.add({run.space, run.solver, run.epsilon, run.h, failure.steps, 0,
                watch.seconds(), 1.0, "refuses", failure.what()});
    }
  }
};

/// Returns the largest h at which the relative error is within the tolerance at every
/// epsilon, or 0. `meshes` has the meshes of one space.
inline double coarsest_mesh(const Table& meshes, double tolerance) {
  double coarsest = 0;
  for (const TableEntry& h : meshes.unique("h"))
    if (meshes.filter("h", h).max("relative") <= tolerance)
      coarsest = std::max(coarsest, h.number());
  return coarsest;
}

/// Returns `unknowns: seconds at the first epsilon / at the second / ...` on one mesh. The
/// seconds are those of the whole problem. `prices` has the runs on this mesh.
inline std::string price(const Table& meshes, const Table& prices,
                         const std::string& solver, bool on_contact) {
  std::string text = fmt::format("{}:", meshes.max("unknowns"));
  for (const TableEntry& epsilon : meshes.entries("epsilon")) {
    const Table at = prices.filter("epsilon", epsilon), own = at.filter("solver", solver);
    std::string seconds = "-";
    if (own.size() == 1) {
      const double before =
          on_contact ? at.filter("solver", condensation).number("seconds") : 0.0;
      seconds = fmt::format("{:.2g}", before + own.number("seconds"));
    }
    text += (text.back() == ':' ? " " : " / ") + seconds;
  }
  return text;
}

/// Writes price_list.md, the seconds to an accuracy: one row per space and solver.
inline void write_price_list(const std::filesystem::path& folder, const Study& study) {
  const std::vector<std::pair<std::string, bool>> solvers{
      {"active_set of the library", false},
      {"active set", true},
      {"augmented Lagrangian", true},
      {"proximal Galerkin", true},
      {"proximal Galerkin, library", false},
      {"interior point", true},
      {"Uzawa", true},
      {"Uzawa, accelerated", true},
      {"MPRGP", false}};  // whether it is a solver on Gamma_C, which needs w and F
  Table page({"element and mesh", "solver", "1e-2", "1e-3"});
  for (const char* space : {"P1 structured", "CR unstructured"}) {
    const Table meshes = study.meshes.filter("space", space),
                prices = study.prices.filter("space", space);
    for (const auto& [solver, on_contact] : solvers) {
      if (prices.filter("solver", solver).size() == 0) continue;
      std::vector<TableEntry> row{space, solver};
      for (const double tolerance : {1e-2, 1e-3}) {
        const double h = coarsest_mesh(meshes, tolerance);
        const bool reached = h > 0;
        row.emplace_back(reached ? price(meshes.filter("h", h), prices.filter("h", h),
                                         solver, on_contact)
                                 : std::string(">"));
      }
      page.add(std::move(row));
    }
  }
  write_markdown(
      folder / "price_list.md",
      fmt::format(
          "Further solvers, of chapter 34. An entry has the number of unknowns, a "
          "colon, and the seconds at epsilon = 1 / 0.01 / 1e-6 / 0 (medians of {} "
          "runs). The relative error at the unknowns is below 1e-2 or 1e-3 at each "
          "of them. The seconds contain those of w and F where the solver needs "
          "them, and not mesh and assembly. `-` means that the solver has no answer, "
          "and `>` that the finest mesh is too coarse.",
          study.repeats),
      page);
}

/// Returns the runs of a picture: P1 on columns, the solvers that answer at every epsilon.
inline Table chart(const Table& runs) {
  Table rows({"solver", "epsilon", "h", "steps"});
  const Table columns = runs.filter("space", "P1 structured").filter("answer", "agrees");
  for (const Table& row : columns.rows()) {
    const std::string solver = row.entry("solver").text();
    if (solver == "MPRGP" || solver == "proximal Galerkin, library") continue;
    rows.add({solver, row.number("epsilon"), row.number("h"), row.number("steps")});
  }
  return rows;
}

/// Prints the steps on the columns against h, and all on the finest mesh.
inline void print_steps(const Study& study, int cells) {
  const auto on = [](const Table& table, const std::string& space) {
    const Table rows = table.filter("space", space);
    return rows.filter("h", rows.min("h"));
  };
  const Table columns = study.runs.filter("space", "P1 structured");
  for (const double epsilon : {1.0, 0.0})
    columns.filter("epsilon", epsilon)
        .pivot("solver", "h", "steps")
        .print(fmt::format("P1 on columns, epsilon = {}: steps by solver and h", epsilon));
  on(study.runs, "P1 structured")
      .pivot("solver", "epsilon", "steps")
      .print(fmt::format("P1 on columns, 1/h = {}: steps by solver and epsilon", cells));
  on(study.runs, "CR unstructured")
      .pivot("solver", "epsilon", "steps")
      .print(fmt::format("CR, unstructured, 1/h = {}: steps by solver and epsilon",
                         cells / 2));
  on(study.runs, "P1 structured")
      .pivot("solver", "epsilon", "error")
      .print("P1 on columns: distance from the answer of the library, relative", 1);
  on(study.runs, "P1 unstructured")
      .pivot("solver", "epsilon", "answer")
      .print("P1 on the unstructured mesh, which locks: the answers");
  on(study.prices, "P1 structured")
      .pivot("solver", "epsilon", "seconds")
      .print("P1 on columns: seconds, without those of w and F", 2);
}

inline const std::vector<std::string> answer_columns{
    "epsilon", "h", "active set", "u_h", "lowest", "exp(psi_h)", "proximal", "Newton"};

/// Returns the largest errors at the vertices of Gamma_C, and the lowest u_h, all over the
/// ridge, of the active set and of proximal Galerkin as published.
inline std::vector<TableEntry> answer_row(const ExactSolution& exact, const Found& nodal,
                                          const Found& published) {
  const Eigen::Index count = nodal.s.size();
  const double h = 1.0 / static_cast<double>(count + 1), ridge = exact.max_on_contact();
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i)
    values(i) = exact.value(static_cast<double>(i + 1) * h, -1);
  const auto error = [&](const Eigen::VectorXd& s) {
    return (s - values).lpNorm<Eigen::Infinity>() / ridge;
  };
  const Eigen::VectorXd positive = published.latent.array().exp();
  return {exact.epsilon(),
          h,
          error(nodal.s),
          error(published.s),
          published.s.minCoeff() / ridge,
          error(positive),
          published.outer,
          published.steps};
}

/// Claims that the border of the active set moves by one point per guess, from 1/2 to the
/// end c of contact. `rigid` has the runs of P1 on columns at epsilon = 0.
inline void judge_border(const Table& rigid, Report& report) {
  const ExactSolution exact(paper_sine_load(), 0, true, 14);
  const double c = exact.contact_zones().front().first;
  double off = 0;
  for (const Table& row : rigid.filter("solver", "active set").rows()) {
    const double law = (c - 0.5) / row.number("h") + 2;
    off = std::max(off, std::abs(row.number("steps") - law));
  }
  report.claim(
      off <= 1,
      "epsilon = 0: the guesses from nothing are (c - 1/2) / h + 2 with c = {:.3f}, "
      "up to {:.1f} (observed)",
      c, off);
}

inline void judge_published(const Table& answers, Report& report) {
  double ratio = 0;
  for (const Table& row : answers.rows())
    ratio = std::max(ratio, row.number("u_h") / row.number("active set"));
  report.claim(
      ratio < 1.5,
      "as published, u_h has at most {:.2f} times the active set's error (observed)",
      ratio);
  report.claim(answers.max("lowest") < 0 && answers.min("lowest") > -0.02,
               "and sinks below 0, by {:.1e} of the ridge at most (observed)",
               -answers.min("lowest"));
  // beside the clamped ends, where exp(psi_h) is not 0
  report.claim_orders(answers.filter("epsilon", 0.0), "exp(psi_h)", 0.8, 1.2,
                      "exp(psi_h) at epsilon = 0: error");
}

inline void judge_answers(const Table& runs, Report& report) {
  const Table locked = runs.filter("space", "P1 unstructured").filter("epsilon", 0.0);
  bool refuse = locked.size() > 0, zero = refuse, agree = true;
  for (const Table& row : locked.rows()) {
    const std::string solver = row.entry("solver").text(),
                      answer = row.entry("answer").text();
    if (solver.starts_with("proximal")) refuse = refuse && answer == "refuses";
    if (solver.starts_with("active set")) zero = zero && answer == "0";
  }
  report.claim(refuse,
               "the locked mesh at epsilon = 0: proximal Galerkin refuses, since no point "
               "of K_h is inside (proved)");
  report.claim(zero, "there the active set answers 0 and is content (proved)");
  double furthest = 0;
  for (const Table& row : runs.rows()) {
    const bool on_the_locked_mesh =
        row.entry("space").text() == "P1 unstructured" && row.number("epsilon") == 0;
    if (on_the_locked_mesh || row.entry("solver").text() == "MPRGP") continue;
    agree = agree && row.entry("answer").text() == "agrees";
    furthest = std::max(furthest, row.number("error"));
  }
  report.claim(agree,
               "elsewhere every solver but MPRGP has the answer of the library, to {:.0e} "
               "(observed)",
               furthest);
}

}  // namespace antilock::tutorial
