#pragma once
#include <memory>

namespace antilock::figures {

/// A connection to the X display, without which VTK would end the process. Keep it as long as
/// anything is rendered: a virtual display starts afresh when its last client leaves, and refuses
/// clients meanwhile.
using DisplayConnection = std::shared_ptr<void>;

/// Throws Error, saying what to do, unless a display answers within two seconds.
DisplayConnection connect_display();

}  // namespace antilock::figures
