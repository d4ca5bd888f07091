#pragma once

// One header for Catch2 3 (Debian 13, Ubuntu 24.04) and 2.13 (Debian 12).
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
namespace packtrace {
using Catch::Approx;
namespace test {
using Catch::Matchers::ContainsSubstring;
}
}  // namespace packtrace
#else
#include <catch2/catch.hpp>
namespace packtrace::test {
inline auto ContainsSubstring(const std::string& text)
{
    return Catch::Contains(text);
}
}  // namespace packtrace::test
#endif
