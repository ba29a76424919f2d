#include "programs/petsc/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/input_file.hpp"

namespace antilock::distributed {

std::string question_of(const std::filesystem::path& scene, const std::filesystem::path& mesh) {
  std::uint64_t hash = 14695981039346656037U;  // FNV-1a
  for (const std::filesystem::path& path : {scene, mesh}) {
    if (path.empty()) continue;  // the mesh is made
    const std::string name = printable(path.string(), 1000);
    const auto in =  // devices and pipes may never end
        path == scene ? open_file(path, name + ": file", "a scene file in TOML")
                      : open_file(path, printable(scene.string(), 1000) + ": mesh.file: " + name,
                                  "a MSH file, 2.2 or 4.1, ASCII");
    for (std::istreambuf_iterator<char> byte(*in), end; byte != end; ++byte)
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
    out << nlohmann::json{{"question", checkpoint.question},
                          {"cells", checkpoint.cells},
                          {"x", checkpoint.set.x},
                          {"active", checkpoint.set.active}};
  });
}

Checkpoint read_checkpoint(const std::filesystem::path& path, const std::string& question) {
  std::error_code ignored;
  std::ifstream in;
  if (std::filesystem::is_regular_file(path, ignored)) in.open(path);
  if (!in.is_open())
    throw Error(
        path.string() +
        ": --restart: there is no checkpoint; accepted: after a run to this folder was ended");
  Checkpoint checkpoint;
  auto& [asked, cells, set] = checkpoint;
  try {
    const nlohmann::json read = nlohmann::json::parse(in);
    read.at("question").get_to(asked);
    read.at("cells").get_to(cells);
    read.at("x").get_to(set.x);
    read.at("active").get_to(set.active);
  } catch (const nlohmann::json::exception&) {
    cells = 0;
  }
  if (cells < 1 || set.active.size() != set.x.size() || !std::is_sorted(set.x.begin(), set.x.end()))
    throw Error(path.string() +
                ": --restart: is no checkpoint, or is damaged; accepted: a run without --restart");
  if (asked != question)
    throw Error(
        path.string() +
        ": --restart: belongs to another scene; accepted: the scene file as it was then, or a "
        "run without --restart");
  return checkpoint;
}

}  // namespace antilock::distributed
