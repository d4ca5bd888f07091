#pragma once

#include <exception>
#include <string>

namespace packtrace::test {

/// The message of the `Error` that `call` throws; "accepted" if it throws nothing.
template <class Error = std::exception>
[[nodiscard]] std::string refusal(const auto& call)
{
    try {
        static_cast<void>(call());
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace packtrace::test
