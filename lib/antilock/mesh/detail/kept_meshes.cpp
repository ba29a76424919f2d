#include "antilock/mesh/detail/kept_meshes.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "antilock/core/detail/atomic_file.hpp"

namespace antilock {

// A file for the machine that wrote it: the numbers of vertices and of triangles, then both arrays as they lie in memory.
MeshArrays kept_mesh(const std::string& name, const std::function<MeshArrays()>& make) {
  const char* folder = std::getenv("ANTILOCK_MESHES");
  if (folder == nullptr || *folder == '\0') return make();
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  constexpr std::size_t vertex = 2 * sizeof(double), triangle = 3 * sizeof(int);
  std::array<std::uint64_t, 2> counts{};
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  const auto get = [&](auto* data, std::uint64_t bytes) -> bool {
    return !!in.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(bytes));
  };
  if (!error && get(counts.data(), sizeof counts) && counts[0] <= size / vertex && counts[1] <= size / triangle &&
      size == sizeof counts + counts[0] * vertex + counts[1] * triangle) {
    MeshArrays kept{Points(counts[0], 2), Triples(counts[1], 3)};
    if (get(kept.first.data(), counts[0] * vertex) && get(kept.second.data(), counts[1] * triangle)) return kept;
  }
  MeshArrays made = make();
  counts = {static_cast<std::uint64_t>(made.first.rows()), static_cast<std::uint64_t>(made.second.rows())};
  write_file(path, [&](std::ostream& out) {
    const auto put = [&](const auto* data, std::uint64_t bytes) {
      out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(bytes));
    };
    put(counts.data(), sizeof counts);
    put(made.first.data(), counts[0] * vertex);
    put(made.second.data(), counts[1] * triangle);
  });
  return made;
}

}  // namespace antilock
