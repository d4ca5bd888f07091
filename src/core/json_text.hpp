#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace packtrace {

/// A number as JSON, which has no infinity and no NaN: these are null.
[[nodiscard]] inline nlohmann::json finite_or_null(double value)
{
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

/// As the program writes JSON: indented, a line end last, bytes that are not UTF-8 replaced.
template <class Json>
[[nodiscard]] std::string json_text(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace packtrace
