#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "core/file_error.hpp"

namespace packtrace {

/// A file that appears complete or not at all: bytes go to a temporary name beside `target`,
/// `commit` renames it. Without a commit the destructor removes it and leaves what was at
/// `target` untouched. Everything but the destructor throws FileError.
class AtomicFile {
public:
    explicit AtomicFile(std::filesystem::path target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    void commit();

private:
    struct Closer {
        void operator()(std::FILE* file) const
        {
            std::fclose(file);
        }
    };

    std::filesystem::path target_;
    std::filesystem::path temporary_;
    std::unique_ptr<std::FILE, Closer> file_;
};

/// Throws FileError, as an AtomicFile for `target` would: its folder is missing or can't be
/// written to, or it is a folder itself. Leaves nothing behind.
void check_writable(const std::filesystem::path& target);

}  // namespace packtrace
