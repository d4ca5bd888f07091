#pragma once

#include <packtrace/vec.hpp>

#include <charconv>
#include <string>

namespace packtrace::peers {

/// The shortest text that is read back as the same double.
[[nodiscard]] inline std::string number(double value)
{
    char buffer[32];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, end};
}

/// Three numbers with `separator` between them.
[[nodiscard]] inline std::string numbers(const Vec3& v, const char* separator)
{
    return number(v.x) + separator + number(v.y) + separator + number(v.z);
}

}  // namespace packtrace::peers
