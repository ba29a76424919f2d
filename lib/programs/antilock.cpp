// antilock: command-line tools for the solutions of other programs, one subcommand for each.
//
// Run:    antilock exact tutorials/scenes/figure8.toml < points.csv     the exact solution at points
// Run:    antilock sweep tutorials/scenes/figure7.toml --epsilon 1:1e-6:7
//
// Every subcommand ends with status 0, or with one line on standard error and nothing written:
// status 2 for a question that cannot be asked, 3 for a solve that did not get there.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <new>
#include <system_error>

#include "antilock/core/error.hpp"
#include "antilock/core/standard_output.hpp"
#include "programs/program.hpp"
#include "programs/subcommands/subcommands.hpp"

namespace {

struct Subcommand {
  const char* name;
  std::function<int(int, char**)> run;
  const char* summary;
  const char* old_name = "";  ///< the name in 0.2, which works as well and is not shown

  bool is_called(const char* word) const {
    return std::strcmp(word, name) == 0 || std::strcmp(word, old_name) == 0;
  }
};

const std::vector<Subcommand>& subcommands() {
  using namespace antilock;
  static const std::vector<Subcommand> all{
      {"run",
       [](int, char** argv) -> int {
         tutorial::exec_program("run_scene", argv);
         throw Error(
             "antilock run: run_scene is not beside this program; accepted: the folder of both");
       },
       "solve a scene: run_scene, the same options"},
      {"exact", subcommands::exact, "the exact solution of a scene at given points", "truth"},
      {"estimate", subcommands::estimate,
       "the error of another program's solution, with a proved bound", "judge"},
      {"lockcheck", subcommands::lockcheck, "whether the matrices of another program lock"},
      {"sweep", subcommands::sweep, "a scene over epsilons and meshes: one table"}};
  return all;
}

int help(std::FILE* where, int status) {
  antilock::open_standard_streams();
  fmt::print(where, "antilock SUBCOMMAND ...; each has --help\n");
  for (const Subcommand& subcommand : subcommands())
    fmt::print(where, "  {:<10} {}\n", subcommand.name, subcommand.summary);
  return antilock::delivered(status, "antilock");
}

int fail(const std::string& message, int status) {
  // fmt::print would throw where standard error is full or closed, and end the program by a signal
  std::fputs((antilock::printable(message, 4000) + "\n").c_str(), stderr);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (const Subcommand& subcommand : subcommands())
      for (int k = 0; k < std::min(argc, 2); ++k)  // 0: it started again, as reexec_tuned does
        if (subcommand.is_called(argv[k])) {
          const int status = subcommand.run(argc - k, argv + k);
          return antilock::delivered(status, std::string("antilock ") + argv[k]);
        }
    if (argc < 2) return help(stderr, 2);
    if (!std::strcmp(argv[1], "--help") || !std::strcmp(argv[1], "-h")) return help(stdout, 0);
    return fail(std::string("antilock: \"") + argv[1] +
                    "\" is unknown; accepted: run, exact, estimate, lockcheck, sweep (see --help)",
                2);
  } catch (const antilock::NotConverged& failure) {
    return fail(failure.what(), 3);
  } catch (const std::bad_alloc&) {
    return fail("antilock: out of memory; accepted: fewer cells or points", 3);
  } catch (const std::system_error& error) {  // of standard output: those of files come as Error
    return fail(std::string("antilock: standard output: ") + error.what(), 2);
  } catch (const std::exception& error) {
    return fail(error.what(), 2);
  }
}
