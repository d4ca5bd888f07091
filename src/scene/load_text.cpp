#include "scene/load_text.hpp"

#include <packtrace/read_scene.hpp>

#include "scene/check_text.hpp"
#include "scene/quote.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace packtrace::reader {
namespace {

[[noreturn]] void fail_file(const std::string& name, const std::string& reason)
{
    throw SceneError(escape(name) + ": " + reason);
}

/// Stops early in a line that is too long, which a file that is no text mostly is.
std::string read_up_to(std::istream& in, std::size_t limit)
{
    constexpr std::size_t step = std::size_t{1} << 16u;
    std::string text;
    std::size_t line = 0;
    while (in && text.size() < limit && text.size() - line <= longest_line) {
        const std::size_t size = text.size();
        text.resize(size + step);
        in.read(text.data() + size, step);
        text.resize(size + static_cast<std::size_t>(in.gcount()));
        const std::size_t last = std::string_view(text).substr(size).rfind('\n');
        if (last != std::string_view::npos)
            line = size + last + 1;
    }
    return text;
}

}  // namespace

std::string load_text(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        fail_file(file.string(), "this is a directory; give a scene file");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in)
        fail_file(file.string(), std::string("can't be opened (") + std::strerror(errno) +
                                     "); check the name and the permissions");
    return load_text(in, file.string());
}

std::string load_text(std::istream& in, const std::string& name)
{
    std::string text = read_up_to(in, longest_file + 1);
    if (in.bad())
        fail_file(name, "can't be read to its end; check the disk and the permissions");
    return text;
}

}  // namespace packtrace::reader
