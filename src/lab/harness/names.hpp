#pragma once

#include <packtrace/explain.hpp>

namespace packtrace {

/// The name of a kind of ray in tables and JSON.
[[nodiscard]] inline const char* name_of(RayKind kind)
{
    switch (kind) {
        case RayKind::camera:
            return "camera";
        case RayKind::mirrored:
            return "mirrored";
        case RayKind::refracted:
            break;
    }
    return "refracted";
}

}  // namespace packtrace
