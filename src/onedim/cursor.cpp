#include "onedim/cursor.hpp"

namespace packtrace::onedim {
namespace {

std::string found(std::string_view rest)
{
    if (rest.empty())
        return "the end of the line";
    const auto byte = static_cast<unsigned char>(rest.front());
    if (byte > 0x20 && byte < 0x7f)
        return std::string("'") + rest.front() + "'";
    constexpr std::string_view digits = "0123456789abcdef";
    return std::string("byte 0x") + digits[byte >> 4] + digits[byte & 15];
}

}  // namespace

void Cursor::fail(std::string_view what)
{
    skip_space();
    throw SyntaxError{at_ + 1,
                      "expected " + std::string(what) + ", found " + found(line_.substr(at_))};
}

}  // namespace packtrace::onedim
