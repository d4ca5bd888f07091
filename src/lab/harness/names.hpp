#pragma once

#include <packtrace/explain.hpp>
#include <packtrace/render.hpp>

namespace packtrace {

/// As the command line has it.
[[nodiscard]] inline const char* name_of(Accuracy accuracy)
{
    return accuracy == Accuracy::fast ? "fast" : "exact";
}

/// What tables and JSON call a kind of ray.
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
