#pragma once

#include "core/read_file.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace::cli {

/// The files of an interrupted run beside its output: a journal `OUTPUT.journal` of finished
/// pieces, and `OUTPUT.part` with their bytes. If the output is a link, they lie beside the file at
/// its end, which may be on another disk. The journal begins with a head, which has everything
/// that the pieces depend on; a file without a complete head is not yet a journal. Each line has a
/// checksum, so that truncated lines are ignored. A run locks its journal. All members throw
/// FileError.
class Journal {
public:
    /// Creates both files, or continues existing ones. `head` is one line. Also throws if another
    /// run works on `output`, or if the existing journal has another head. Then `differs` describes
    /// the difference of the two heads for the message.
    Journal(const std::filesystem::path& output, const std::string& head,
            std::string (*differs)(const std::string& before, const std::string& now));

    /// The line of a piece: numbers separated by spaces.
    using Entry = std::vector<std::uint64_t>;

    /// The entries of an earlier run, in order.
    [[nodiscard]] const std::vector<Entry>& entries() const
    {
        return entries_;
    }
    /// Adds a piece whose bytes were written to the part file.
    void add(const Entry& entry);

    /// Reads bytes of the part file from `offset` on. If it ends early, the rest is unchanged.
    void read(std::uint64_t offset, std::span<std::uint8_t> bytes) const;
    void write(std::uint64_t offset, std::span<const std::uint8_t> bytes);
    /// Truncates the part file to `length` bytes.
    void truncate(std::uint64_t length);

    /// Removes both files.
    void remove();
    /// Renames the part file to the output, and removes the journal.
    void rename_part();

private:
    void open(const std::string& head,
              std::string (*differs)(const std::string&, const std::string&));
    [[nodiscard]] bool lock();
    [[nodiscard]] std::string begin(const std::string& head);
    [[nodiscard]] std::string read_entries(const std::string& text);
    void append(std::string_view text);

    std::filesystem::path output_;
    std::filesystem::path journal_name_;
    std::filesystem::path part_name_;
    OpenFile journal_;
    OpenFile part_;
    std::vector<Entry> entries_;
};

}  // namespace packtrace::cli
