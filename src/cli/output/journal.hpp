#pragma once

#include "core/read_file.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace::cli {

/// What remains of an interrupted run beside its output: a journal `OUTPUT.journal` of finished
/// pieces, and `OUTPUT.part` with their bytes. The journal begins with what the pieces depend on;
/// a file that ends before or in that is no journal yet. Each line has a checksum, so that a line
/// that was cut short counts for nothing. A run has a lock on its journal. All throw FileError.
class Journal {
public:
    /// Begins both files, or goes on with those that are there. `head` is one line. Throws also
    /// where another run is at work on `output`, or where one was begun with another head:
    /// `differs` then says with what it was begun, and what is other now, of the two heads.
    Journal(const std::filesystem::path& output, const std::string& head,
            std::string (*differs)(const std::string& before, const std::string& now));

    /// A line for a piece: its words, parted by spaces.
    using Entry = std::vector<std::uint64_t>;

    /// Those of an earlier run, in order.
    [[nodiscard]] const std::vector<Entry>& entries() const
    {
        return entries_;
    }
    /// Notes a piece whose bytes have been written to the part file.
    void add(const Entry& entry);

    /// The bytes of the part file from `offset` on; fewer where it ends. For pieces.
    void read(std::uint64_t offset, std::span<std::uint8_t> bytes) const;
    void write(std::uint64_t offset, std::span<const std::uint8_t> bytes);
    /// Cuts the part file there.
    void truncate(std::uint64_t length);

    /// Removes both files.
    void remove();
    /// Makes the part file the output, and removes the journal.
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
