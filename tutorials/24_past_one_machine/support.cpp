#include "support.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <sstream>
#include <thread>

#include "antilock/core/error.hpp"
#include "antilock/distributed/partition.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/distributed/snesvi.hpp"
#include "antilock/distributed/tao.hpp"
#include "antilock/form/edge_forms.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "course/course.hpp"
#include "programs/program.hpp"

namespace antilock::tutorial {
namespace {

constexpr auto flag = "--on-ranks";
const std::vector<std::string> columns{
    "what", "ranks",   "cells",     "epsilon", "unknowns", "corrections", "iterations",
    "most", "seconds", "megabytes", "u_max",   "u_min",    "reason"};

}  // namespace

std::optional<int> answer_as_rank(int argc, char** argv,
                                  const std::function<Ended(const Asked&)>& solve) {
  if (argc != 5 || std::string(argv[1]) != flag) return std::nullopt;
  const distributed::Session session;
  Ended end;
  try {
    end = solve({argv[2], distributed::ranks(), std::stoi(argv[3]), std::stod(argv[4])});
  } catch (const NotConverged&) {
    end.reason = "gave_up";
  } catch (const std::exception& error) {
    distributed::abort(error.what(), 3);
  }
  end.megabytes = distributed::peak_megabytes();
  if (distributed::rank() == 0)
    fmt::print("{} {} {} {} {} {} {} {} {}\n", end.unknowns, end.corrections,
               end.iterations, end.most, end.seconds, end.megabytes, end.u_max, end.u_min,
               end.reason);
  return 0;
}

Table on_ranks(const Asked& asked) {
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const bool crowded = asked.ranks > static_cast<int>(std::thread::hardware_concurrency());
  // MPI_ENVIRONMENT: lib/cmake/mpi_environment.cmake. Where there are more ranks than
  // cores, one that waits gives way.
  const std::string command = fmt::format(
      MPI_ENVIRONMENT " OMPI_MCA_mpi_yield_when_idle={} mpiexec -n {} {} {} {} {} {}",
      crowded ? 1 : 0, asked.ranks, tutorial::in_shell(self), flag,
      tutorial::in_shell(asked.what), asked.cells, asked.epsilon);
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string answer;
  std::array<char, 512> line{};
  while (pipe != nullptr &&
         std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr)
    answer += line.data();
  const int status = pipe != nullptr ? ::pclose(pipe) : -1;
  std::istringstream text(answer);
  Ended end;
  text >> end.unknowns >> end.corrections >> end.iterations >> end.most >> end.seconds >>
      end.megabytes >> end.u_max >> end.u_min >> end.reason;
  if (status != 0 || !text)
    throw Error(
        fmt::format("mpiexec -n {} failed (status {}); accepted: a machine where mpiexec "
                    "starts {} processes",
                    asked.ranks, status, asked.ranks));
  Table row(columns);
  row.add({asked.what, asked.ranks, asked.cells, asked.epsilon, end.unknowns,
           end.corrections, end.iterations, end.most, end.seconds, end.megabytes, end.u_max,
           end.u_min, end.reason});
  return row;
}

Table on_ranks(const std::string& what, const std::vector<int>& ranks,
               const std::function<int(int)>& cells, double epsilon) {
  Table runs(columns);
  for (const int n : ranks) runs.add(on_ranks({what, n, cells(n), epsilon}));
  return runs;
}

Ended by_petsc(const Asked& asked) {
  const TriangleMesh mesh = structured_mesh(asked.cells);
  const Space space(
      distributed::subdomain_of(mesh, distributed::strip_partition(mesh, asked.ranks),
                                distributed::rank()),
      p1());
  const bool summed = asked.what.ends_with(", summed");
  const distributed::DistributedProblem problem(
      paper_scene(asked.epsilon), space,
      summed ? distributed::PenaltyChoice::none
             : distributed::PenaltyChoice::serial_default);
  distributed::State state = distributed::zero_state(problem);
  const distributed::PetscEnd end =
      asked.what.starts_with("SNESVI")
          ? distributed::snesvi(problem, state, !summed)
          : distributed::tao(problem, state, distributed::TaoMethod::bntr, !summed);
  return {problem.rows().total(),
          end.corrections,
          end.linear,
          0,
          0,
          0,
          end.largest,
          0,
          end.reason};
}

Solution serial(const TriangleMesh& mesh, const Element& element, double epsilon) {
  const Space space(mesh, element);
  return active_set(assemble(paper_scene(epsilon), space));
}

void print_runs(const Table& runs) {
  const Table first = runs.rows().front();
  runs.select({"ranks", "cells", "epsilon", "unknowns", "corrections", "iterations", "most",
               "seconds", "megabytes", "u_max", "reason"})
      .print(first.entry("what").text(), 5);
}

std::vector<int> chessboard(const TriangleMesh& mesh, int ranks) {
  std::vector<int> rank_of;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::RowVector3i corners = mesh.triangles.row(t);
    const double x = mesh.vertices.col(0)(corners).mean(),
                 y = mesh.vertices.col(1)(corners).mean();
    rank_of.push_back((static_cast<int>(8 * x) + static_cast<int>(8 * (y + 1))) % ranks);
  }
  return rank_of;
}

void write_scaling(const std::filesystem::path& folder, const Table& strong,
                   const Table& weak, const Table& cut) {
  Table scaling(
      {"ranks", "strong", "weak", "cut", "strong_memory", "weak_memory", "cut_memory"});
  for (const Table& run : strong.rows()) {
    const TableEntry ranks = run.entry("ranks");
    std::vector<TableEntry> row{ranks};
    for (const Table* runs : {&strong, &weak, &cut})
      row.push_back(runs->filter("ranks", ranks).entry("iterations"));
    for (const Table* runs : {&strong, &weak, &cut})
      row.emplace_back(runs->filter("ranks", ranks).number("megabytes") /
                       runs->first("megabytes"));
    scaling.add(row);
  }
  scaling.write(folder / "scaling.csv");
}

}  // namespace antilock::tutorial
