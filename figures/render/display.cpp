#include "render/display.hpp"

#include <X11/Xlib.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "antilock/core/error.hpp"

namespace antilock::figures {

DisplayConnection connect_display() {
  const char* name = std::getenv("DISPLAY");
  const bool named = name != nullptr && *name != 0;
  constexpr int attempts =
      10;  // a display that has just lost its last client comes back within a moment
  for (int i = 0; named && i < attempts; ++i) {
    if (Display* display = XOpenDisplay(name))
      return {static_cast<void*>(display),
              [](void* open) { XCloseDisplay(static_cast<Display*>(open)); }};
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  throw Error(fmt::format(
      "no display ({}); run the same command under a virtual one: xvfb-run -a render ...",
      named ? fmt::format("DISPLAY={} does not answer", name) : "DISPLAY is not set"));
}

}  // namespace antilock::figures
