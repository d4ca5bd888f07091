#pragma once

/// Marks what the library offers. All other symbols of libpacktrace are hidden.
#define PACKTRACE_API [[gnu::visibility("default")]]
