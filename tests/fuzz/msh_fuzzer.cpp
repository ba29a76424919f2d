// Feeds the MSH reader whatever libFuzzer makes of the corpus: it may build a sound mesh or refuse
// with an Error of one line; anything else (a crash, undefined behaviour, another exception, a mesh
// that breaks its promises) ends the run.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/mesh/read_msh.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check_promises(const antilock::TriangleMesh& mesh) {
  using antilock::EdgeTag;
  require(mesh.vertices.allFinite() && mesh.triangle_count() > 0);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    require(mesh.twice_area(t) > 0);
    for (int i = 0; i < 3; ++i) {
      const int edge = mesh.triangle_edges(t, i);
      require(mesh.edge_triangles(edge, 0) == t || mesh.edge_triangles(edge, 1) == t);
    }
  }
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool boundary = mesh.edge_triangles(e, 1) < 0;
    const bool tagged =
        mesh.edge_tag[e] == EdgeTag::clamped || mesh.edge_tag[e] == EdgeTag::contact;
    require(boundary == tagged);
  }
}

/// The pieces of a text between the characters of `separators`, each with the one that ends it.
std::vector<std::string> pieces(const std::string& text, const char* separators) {
  std::vector<std::string> found;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = text.find_first_of(separators, from);
    found.push_back(text.substr(from, end == text.npos ? end : end - from + 1));
    from += found.back().size();
  }
  return found;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// Half of the mutations are libFuzzer's, of bytes; the others move whole words or lines about, so
/// that files stay well enough formed to reach the checks of the mesh itself.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  std::minstd_rand random(seed);
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> parts = pieces(text, random() % 2 == 0 ? " \n" : "\n");
  if (random() % 2 == 0 || parts.empty()) return LLVMFuzzerMutate(data, size, max_size);
  const auto any = [&] { return static_cast<std::ptrdiff_t>(random() % parts.size()); };
  const std::ptrdiff_t at = any();
  switch (random() % 4) {
    case 0:
      parts[at] = parts[any()];
      break;
    case 1:
      std::swap(parts[at], parts[any()]);
      break;
    case 2:
      parts.erase(parts.begin() + at);
      break;
    default:
      parts.insert(parts.begin() + at, std::string(parts[any()]));
  }
  std::string changed;
  for (const std::string& part : parts) changed += part;
  changed.resize(std::min(changed.size(), max_size));
  std::copy(changed.begin(), changed.end(), data);
  return changed.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  try {
    check_promises(antilock::read_msh(in, "fuzz.msh"));
  } catch (const antilock::Error& error) {
    const std::string message = error.what();
    require(message.rfind("fuzz.msh: ", 0) == 0 && message.find('\n') == message.npos &&
            message.size() < 400);
  }
  return 0;
}
