#pragma once

#include "core/atomic_file.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace packtrace::cli {

/// Writes text or bytes to standard output, or to a file that appears complete or not at all. All
/// members throw FileError.
class Output {
public:
    /// Writes to standard output if `file` is empty or -.
    explicit Output(const std::string& file)
    {
        if (!file.empty() && file != "-")
            file_.emplace(file);
    }

    void write(std::span<const std::byte> bytes)
    {
        if (file_)
            file_->write(bytes);
        else if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size())
            throw FileError("standard output", FileAction::write, errno);
    }
    void write(std::string_view text)
    {
        write(std::as_bytes(std::span(text)));
    }

    /// Flushes standard output.
    void flush()
    {
        if (!file_ && std::fflush(stdout) != 0)
            throw FileError("standard output", FileAction::write, errno);
    }

    /// Call it at the end. Without it, a file does not appear.
    void finish()
    {
        if (file_)
            file_->commit();
        flush();
    }

private:
    std::optional<AtomicFile> file_;
};

}  // namespace packtrace::cli
