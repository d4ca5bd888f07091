#pragma once

namespace packtrace::cli {

/// What to say of each ray: its first hit, all of them in order, or whether there is any.
enum class RayQuery { closest, all, any };

/// Whether hits come with proven bounds of their t.
enum class RayBounds { none, proven };

}  // namespace packtrace::cli
