#pragma once

#include <cerrno>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "core/atomic_file.hpp"

namespace packtrace::cli {

/// Text for standard output, or for a file that appears whole or not at all. All throw
/// FileError.
class TextOutput {
public:
    /// Standard output where `file` is empty or -.
    explicit TextOutput(const std::string& file)
    {
        if (!file.empty() && file != "-")
            file_.emplace(file);
    }

    void write(std::string_view text)
    {
        if (file_)
            file_->write(text);
        else if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
            throw FileError("standard output", "can't write", errno);
    }

    /// Without it, a file does not appear.
    void finish()
    {
        if (file_)
            file_->commit();
        else if (std::fflush(stdout) != 0)
            throw FileError("standard output", "can't write", errno);
    }

private:
    std::optional<AtomicFile> file_;
};

}  // namespace packtrace::cli
