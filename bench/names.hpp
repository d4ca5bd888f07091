#pragma once

#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include <packtrace/isa.hpp>

namespace packtrace::bench {

/// Parts of a benchmark's name, joined as Google Benchmark joins arguments to them.
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

/// Those this machine can run, narrowest first.
[[nodiscard]] inline std::vector<std::string> supported_isas()
{
    std::vector<std::string> names;
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            names.push_back(isa.name);
    return names;
}

}  // namespace packtrace::bench
