#include "core/read_file.hpp"

#include <cerrno>
#include <cstdio>
#include <memory>

namespace packtrace {

std::string read_file(const std::filesystem::path& file)
{
    const auto close = [](std::FILE* opened) { std::fclose(opened); };
    const std::unique_ptr<std::FILE, decltype(close)> input(std::fopen(file.c_str(), "rb"), close);
    if (!input)
        throw FileError(file, "can't read", errno);

    // In growing steps, not by the file's size: a pipe has none.
    std::string bytes;
    std::size_t used = 0;
    do {
        bytes.resize(used == 0 ? std::size_t{1} << 16 : 2 * used);
        used += std::fread(bytes.data() + used, 1, bytes.size() - used, input.get());
    } while (used == bytes.size());
    if (std::ferror(input.get()))
        throw FileError(file, "can't read", errno);
    bytes.resize(used);
    return bytes;
}

}  // namespace packtrace
