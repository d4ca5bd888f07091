#include "scene/load_text.hpp"

#include <packtrace/read_scene.hpp>

#include "scene/check_text.hpp"
#include "scene/quote.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>

namespace packtrace::reader {
namespace {

[[noreturn]] void fail_file(const std::filesystem::path& file, const std::string& reason)
{
    throw SceneError(escape(file.string()) + ": " + reason);
}

std::string read_up_to(std::istream& in, std::size_t limit)
{
    constexpr std::size_t step = std::size_t{1} << 16u;
    std::string text;
    while (in && text.size() < limit) {
        const std::size_t size = text.size();
        text.resize(size + step);
        in.read(text.data() + size, step);
        text.resize(size + static_cast<std::size_t>(in.gcount()));
    }
    return text;
}

}  // namespace

std::string load_text(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        fail_file(file, "this is a directory; give a scene file");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in)
        fail_file(file, std::string("can't be opened (") + std::strerror(errno) +
                            "); check the name and the permissions");
    std::string text = read_up_to(in, longest_file + 1);
    if (in.bad())
        fail_file(file, "can't be read to its end; check the disk and the permissions");
    return text;
}

}  // namespace packtrace::reader
