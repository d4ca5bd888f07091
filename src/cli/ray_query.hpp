#pragma once

namespace packtrace::cli {

/// What to say of each ray: its first hit, all of them in order, or whether there is any.
enum class RayQuery { closest, all, any };

}  // namespace packtrace::cli
