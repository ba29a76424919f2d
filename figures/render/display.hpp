#pragma once
#include <memory>

namespace antilock::figures {

/// A connection to the X display, without which VTK would end the process. It must exist while
/// anything is rendered, because a virtual display restarts when its last client disconnects, and
/// refuses clients meanwhile.
using DisplayConnection = std::shared_ptr<void>;

/// Connects to the display. Throws Error, with the remedy, unless a display replies within two
/// seconds.
DisplayConnection connect_display();

}  // namespace antilock::figures
