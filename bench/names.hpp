#pragma once

#include "render_scene.hpp"

#include <initializer_list>
#include <string>
#include <type_traits>

namespace packtrace::bench {

/// Joins the parts of a benchmark's name as Google Benchmark joins arguments.
[[nodiscard]] inline std::string benchmark_name(std::initializer_list<std::string> parts)
{
    std::string name;
    for (const std::string& part : parts)
        name += (name.empty() ? "" : "/") + part;
    return name;
}

template <class Real>
[[nodiscard]] std::string precision_name()
{
    return std::is_same_v<Real, float> ? "float" : "double";
}

using test::supported_isas;

}  // namespace packtrace::bench
