#pragma once

#include "core/read_file.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <sys/stat.h>

namespace packtrace {

/// A file that appears complete or not at all. Bytes are written to a temporary name beside
/// `target`, and `commit` renames it. Without a commit the destructor removes the temporary file
/// and leaves `target` unchanged.
///
/// Links are followed. The file at the end of the links is replaced; it keeps its permissions and,
/// if the system allows, its owner. Other hard links to it keep the old content. A target that is
/// not a regular file, such as a pipe or a device, or that has no name, is written directly.
///
/// The constructor also calls remove_left_over(). All members except the destructor throw
/// FileError.
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
    std::filesystem::path temporary_;  ///< empty if `target_` is written directly
    int slot_ = -1;                    ///< index of the slot for remove_all_temporaries()
    OpenFile file_;
};

/// Writes a file, which appears complete or not at all. Throws FileError.
void write_file(const std::filesystem::path& target, std::string_view text);

/// Removes temporary files of `target` whose writers were killed before this program began.
void remove_left_over(const std::filesystem::path& target);

/// Throws FileError if an AtomicFile for `target` would: its folder is missing or not writable, or
/// `target` is a folder. Leaves no file behind.
void check_writable(const std::filesystem::path& target);

/// Creates the folder and the folders above it, if they are missing. Throws FileError.
void make_folders(const std::filesystem::path& folder);

/// Throws FileError if make_folders() would, or if no file can be written into the folder. Leaves
/// nothing behind.
void check_folder(const std::filesystem::path& folder);

/// Removes the temporary files of all living AtomicFiles. For signal handlers: it takes no lock and
/// does not allocate. Returns the number of files.
int remove_all_temporaries();

}  // namespace packtrace
