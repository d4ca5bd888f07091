#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace packtrace {

/// A file that can't be read or written; `what()` is one line, `file: what: why`.
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
    FileError(const std::filesystem::path& file, const std::string& what, int error_number)
        : std::runtime_error(file.string() + ": " + what + ": " +
                             std::generic_category().message(error_number))
    {
    }
};

}  // namespace packtrace
