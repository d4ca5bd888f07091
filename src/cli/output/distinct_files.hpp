#pragma once

#include "core/read_file.hpp"
#include "scene/language/quote.hpp"

#include <filesystem>
#include <string>
#include <vector>

// Rejects outputs that would replace another file of the command line.
namespace packtrace::cli {

/// Whether two names are names of one file, also by links. The file need not exist.
[[nodiscard]] inline bool is_same_file(const std::filesystem::path& a,
                                       const std::filesystem::path& b)
{
    std::error_code error;
    if (std::filesystem::equivalent(a, b, error) && !error)
        return true;
    const std::filesystem::path whole_a = std::filesystem::weakly_canonical(a, error);
    if (error)
        return false;
    const std::filesystem::path whole_b = std::filesystem::weakly_canonical(b, error);
    return !error && whole_a == whole_b;
}

/// Throws FileError if `output` is one of the `inputs`. Names may be empty or - for standard
/// streams. Files that are not regular are not replaced, so they are allowed.
inline void check_not_read(const std::string& output, const std::vector<std::string>& inputs)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(output, error))
        return;
    for (const std::string& input : inputs)
        if (!input.empty() && input != "-" && is_same_file(output, input))
            throw FileError(language::escape(output) +
                            ": is read by this command, and would be replaced; write to another "
                            "file");
}

/// Throws FileError if two outputs are one file.
inline void check_two_files(const std::string& a, const std::string& b)
{
    std::error_code error;
    const bool is_device =
        std::filesystem::exists(a, error) && !std::filesystem::is_regular_file(a, error);
    if (!a.empty() && !b.empty() && !is_device && is_same_file(a, b))
        throw FileError(language::escape(b) +
                        ": is written twice by this command; give each output a file of its own");
}

}  // namespace packtrace::cli
