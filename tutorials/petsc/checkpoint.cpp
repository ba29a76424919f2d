#include "petsc/checkpoint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "antilock/core/detail/atomic_file.hpp"
#include "antilock/core/detail/text.hpp"
#include "antilock/core/error.hpp"

namespace antilock::distributed {
namespace {

constexpr auto first_line = "antilock checkpoint 1";

}  // namespace

std::string question_of(const std::filesystem::path& scene, const std::filesystem::path& mesh) {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  for (const std::filesystem::path& path : {scene, mesh}) {
    std::ifstream in(path, std::ios::binary);
    for (std::istreambuf_iterator<char> byte(in), end; byte != end; ++byte)
      hash = (hash ^ static_cast<unsigned char>(*byte)) * 1099511628211U;
  }
  return fmt::format("{:016x}", hash);
}

std::filesystem::path checkpoint_path(const std::filesystem::path& out) {
  std::filesystem::path path = out.has_filename() ? out : out.parent_path();
  return path += ".checkpoint";
}

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    text.print("{}\n{} {} {}\n", first_line, checkpoint.question, checkpoint.cells, checkpoint.set.x.size());
    for (std::size_t i = 0; i < checkpoint.set.x.size(); ++i)
      text.print("{} {}\n", checkpoint.set.x[i], static_cast<int>(checkpoint.set.active[i]));
  });
}

Checkpoint read_checkpoint(const std::filesystem::path& path, const std::string& question) {
  std::ifstream in(path);
  if (!in)
    throw Error(path.string() + ": --restart: there is no checkpoint; accepted: after a run to this folder was ended");
  Checkpoint checkpoint;
  std::string line;
  std::size_t count = 0;
  const bool head = std::getline(in, line) && line == first_line;
  if (!head || !(in >> checkpoint.question >> checkpoint.cells >> count) || checkpoint.cells < 1)
    throw Error(path.string() + ": --restart: is no checkpoint; accepted: a run without --restart");
  if (checkpoint.question != question)
    throw Error(path.string() +
                ": --restart: belongs to another scene; accepted: the scene file as it was then, or a "
                "run without --restart");
  for (std::size_t i = 0; i < count; ++i) {
    double x = 0;
    int active = 0;
    const bool whole = static_cast<bool>(in >> x >> active);
    if (!whole || !std::isfinite(x) || (!checkpoint.set.x.empty() && x < checkpoint.set.x.back()))
      throw Error(fmt::format("{}: --restart: is damaged at point {} of {}; accepted: a run without --restart",
                              path.string(), i + 1, count));
    checkpoint.set.x.push_back(x);
    checkpoint.set.active.push_back(active != 0 ? 1 : 0);
  }
  return checkpoint;
}

}  // namespace antilock::distributed
