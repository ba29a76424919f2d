// Feeds the scene reader, TOML and expressions, whatever libFuzzer makes of the example scenes: it
// may take a scene, whose load is then finite or refused wherever it is asked for, or refuse with
// an Error of one line that names the file; anything else ends the run.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "antilock/core/error.hpp"
#include "antilock/runner/scene_file.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check_promises(const antilock::SceneFile& file) {
  require(file.method.tolerance > 0 && file.method.tolerance < 1);
  require(file.mesh.from_file() || file.mesh.cells > 0);
  for (const double x : {0.0, 0.3, 1.0}) require(std::isfinite(file.scene.body().load(x, 0.5)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    check_promises(
        antilock::read_scene(std::string(reinterpret_cast<const char*>(data), size), "fuzz.toml"));
  } catch (const antilock::Error& error) {
    const std::string message = error.what();
    require(message.rfind("fuzz.toml: ", 0) == 0 && message.find('\n') == message.npos &&
            message.size() < 1000);
  }
  return 0;
}
