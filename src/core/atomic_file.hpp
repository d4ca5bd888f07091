#pragma once

#include "core/read_file.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <sys/stat.h>

namespace packtrace {

/// A file that appears complete or not at all: bytes go to a temporary name beside `target`,
/// `commit` renames it. Without a commit the destructor removes it and leaves what was at
/// `target` untouched. A link is followed: the file it leads to is replaced, and keeps its
/// permissions and, where the system allows, its owner; other hard links to it keep what they have.
/// What is no regular file, such as a pipe or a device, or has no name, is written to directly. The
/// constructor also calls remove_left_over(). Everything but the destructor throws FileError.
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
    void open_directly();
    void open_temporary();
    void belong_as(const struct stat& replaced);
    bool create_temporary(int attempt);
    void remove_temporary();

    std::filesystem::path target_;
    std::filesystem::path temporary_;  ///< empty where `target_` is written to directly
    int slot_ = -1;                    ///< where remove_all_temporaries() finds it
    OpenFile file_;
};

/// Writes all of a file, which appears complete or not at all. Throws FileError.
void write_file(const std::filesystem::path& target, std::string_view text);

/// Removes temporary files of `target` whose writers were killed before this program began.
void remove_left_over(const std::filesystem::path& target);

/// Throws FileError, as an AtomicFile for `target` would: its folder is missing or can't be
/// written to, or it is a folder itself. Leaves nothing behind.
void check_writable(const std::filesystem::path& target);

/// Makes the folder and those above it, where they are missing. Throws FileError.
void make_folders(const std::filesystem::path& folder);

/// Throws FileError where make_folders() would, or where no file can be written into the folder.
/// Leaves nothing behind.
void check_folder(const std::filesystem::path& folder);

/// Removes the temporary files of all AtomicFiles that live, for signal handlers: takes no lock
/// and allocates nothing. Returns how many there were.
int remove_all_temporaries();

}  // namespace packtrace
