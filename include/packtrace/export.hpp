#pragma once

/// Marks the public symbols of libpacktrace. All other symbols are hidden.
#define PACKTRACE_API [[gnu::visibility("default")]]
