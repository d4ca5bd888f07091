#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace packtrace {

/// A number as JSON. Infinity and NaN become null, because JSON does not have them.
[[nodiscard]] inline nlohmann::json finite_or_null(double value)
{
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

/// JSON as the program writes it: indented, with a final line end. Bytes that are not UTF-8 are
/// replaced.
template <class Json>
[[nodiscard]] std::string json_text(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace packtrace
