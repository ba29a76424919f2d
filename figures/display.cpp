#include <X11/Xlib.h>

#include <cstdlib>

#include "antilock/scene/error.hpp"
#include "page.hpp"

namespace antilock::figures {

void require_display() {
  if (Display* display = XOpenDisplay(nullptr)) {
    XCloseDisplay(display);
    return;
  }
  const char* name = std::getenv("DISPLAY");
  const std::string found =
      name == nullptr || *name == 0 ? "DISPLAY is not set" : "DISPLAY=" + std::string(name) + " does not answer";
  throw Error("no display (" + found + "); run the same command under a virtual one: xvfb-run -a render ...");
}

}  // namespace antilock::figures
