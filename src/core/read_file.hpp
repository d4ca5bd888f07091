#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

// Reads whole files, and defines the error of files that cannot be read or written.
namespace packtrace {

/// The action that failed.
enum class FileAction { read, write, make_folder };

/// A file cannot be read or written. `what()` is one line, `file: what: why`.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
    FileError(const std::filesystem::path& file, FileAction action, int error_number)
        : std::runtime_error(file.string() + ": can't " + word_of(action) + ": " +
                             std::generic_category().message(error_number) +
                             (error_number == ENOENT ? advice(action) : ""))
    {
    }

private:
    static const char* word_of(FileAction action)
    {
        return action == FileAction::read    ? "read"
               : action == FileAction::write ? "write"
                                             : "make this folder";
    }
    /// Advice if there is no such file or folder.
    static const char* advice(FileAction action)
    {
        return action == FileAction::write ? "; make its folder first" : "; check its name";
    }
};

struct FileCloser {
    void operator()(std::FILE* file) const
    {
        if (file != stdin)
            std::fclose(file);
    }
};

/// An open file. Its destructor closes it, unless it is standard input.
using OpenFile = std::unique_ptr<std::FILE, FileCloser>;

/// The bytes of a file. Throws FileError.
[[nodiscard]] inline std::string read_file(const std::filesystem::path& file)
{
    const OpenFile input(std::fopen(file.c_str(), "rb"));
    if (!input)
        throw FileError(file, FileAction::read, errno);

    // Read in growing steps, because a pipe has no size.
    std::string bytes;
    std::size_t used = 0;
    do {
        bytes.resize(used == 0 ? std::size_t{1} << 16 : 2 * used);
        used += std::fread(bytes.data() + used, 1, bytes.size() - used, input.get());
    } while (used == bytes.size());
    if (std::ferror(input.get()))
        throw FileError(file, FileAction::read, errno);
    bytes.resize(used);
    return bytes;
}

}  // namespace packtrace
