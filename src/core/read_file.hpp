#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

// Files read whole, and the error of files that can't be read or written.
namespace packtrace {

/// A file that can't be read or written; `what()` is one line, `file: what: why`.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
    FileError(const std::filesystem::path& file, const std::string& what, int error_number)
        : std::runtime_error(file.string() + ": " + what + ": " +
                             std::generic_category().message(error_number) +
                             advice(what, error_number))
    {
    }

private:
    static const char* advice(const std::string& what, int error_number)
    {
        if (error_number != ENOENT)
            return "";
        return what == "can't write" ? "; make its folder first" : "; check its name";
    }
};

struct FileCloser {
    void operator()(std::FILE* file) const
    {
        if (file != stdin)
            std::fclose(file);
    }
};

/// A file that is closed at its end, unless it is standard input.
using OpenFile = std::unique_ptr<std::FILE, FileCloser>;

/// The bytes of a file. Throws FileError.
[[nodiscard]] inline std::string read_file(const std::filesystem::path& file)
{
    const OpenFile input(std::fopen(file.c_str(), "rb"));
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
