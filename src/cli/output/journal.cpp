#include "cli/output/journal.hpp"

#include "core/checksum.hpp"
#include "core/read_file.hpp"

#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace packtrace::cli {
namespace {

constexpr std::string_view first_line = "packtrace journal 1\n";

std::filesystem::path beside(const std::filesystem::path& output, const char* ending)
{
    std::filesystem::path name = output;
    name += ending;
    return name;
}

std::uint32_t checksum_of(std::string_view text)
{
    return static_cast<std::uint32_t>(text_hash(text));
}

/// Removes the next line from `text` and returns it. The last line may have no end.
std::string_view cut_line(std::string_view& text)
{
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

/// The numbers of a line, whose last one must be a correct checksum; empty for other lines.
Journal::Entry parse_entry(std::string_view line)
{
    const std::size_t last = line.rfind(' ');
    if (last == std::string_view::npos)
        return {};
    Journal::Entry entry;
    const char* at = line.data();
    const char* const end = at + line.size();
    while (at < end) {
        std::uint64_t number = 0;
        const auto [stop, error] = std::from_chars(at, end, number);
        if (error != std::errc() || (stop != end && *stop != ' '))
            return {};
        entry.push_back(number);
        at = stop + 1;
    }
    if (entry.back() != checksum_of(line.substr(0, last)))
        return {};
    entry.pop_back();
    return entry;
}

/// Whether the text comes from a run that ended before it had written the head.
bool has_no_head(std::string_view text)
{
    if (!text.starts_with(first_line))
        return first_line.starts_with(text);
    text.remove_prefix(first_line.size());
    return text.find('\n') == std::string_view::npos;
}

/// The end of a chain of symbolic links; other names are returned unchanged.
std::filesystem::path end_of_link(const std::filesystem::path& name)
{
    std::error_code error;
    if (!std::filesystem::is_symlink(name, error))
        return name;
    std::filesystem::path end = std::filesystem::weakly_canonical(name, error);
    if (error)
        throw FileError(name, FileAction::write, error.value());
    return end;
}

/// The file that the name stands for, at the end of its links. Throws FileError for a pipe or a
/// device, whose link may have no end: /dev/stdout may be a pipe without a name.
std::filesystem::path checked_output(const std::filesystem::path& output)
{
    std::error_code ignored;
    if (std::filesystem::exists(output, ignored) &&
        !std::filesystem::is_regular_file(output, ignored))
        throw FileError(output.string() +
                        ": --resume: is no regular file, beside which a journal could lie; "
                        "leave out --resume");
    return end_of_link(output);
}

}  // namespace

Journal::Journal(const std::filesystem::path& output, const std::string& head,
                 std::string (*differs)(const std::string& before, const std::string& now))
    : output_(checked_output(output)),
      journal_name_(beside(output_, ".journal")),
      part_name_(beside(output_, ".part"))
{
    open(head, differs);
}

void Journal::open(const std::string& head,
                   std::string (*differs)(const std::string&, const std::string&))
{
    while (!lock())
        continue;
    std::string text = read_file(journal_name_);
    if (has_no_head(text))
        text = begin(head);
    const std::string before = read_entries(text);
    if (before != head)
        throw FileError(journal_name_.string() + ": was begun " + differs(before, head) +
                        "; use what it was begun with, or remove this file to begin again");
    // Ends a truncated line, so that new entries are not appended to it.
    if (!text.ends_with('\n'))
        append("\n");
    const int handle = ::open(part_name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    part_.reset(handle < 0 ? nullptr : fdopen(handle, "r+b"));
    if (!part_)
        throw FileError(part_name_, FileAction::write, errno);
}

/// Opens the journal, or creates an empty one, and locks it for this run. Returns false if the run
/// that had the lock has removed the journal meanwhile, because a lock on a removed file is
/// useless.
bool Journal::lock()
{
    journal_.reset(std::fopen(journal_name_.c_str(), "abe"));
    if (!journal_)
        throw FileError(journal_name_, FileAction::write, errno);
    if (flock(fileno(journal_.get()), LOCK_EX | LOCK_NB) != 0)
        throw FileError(journal_name_.string() +
                        ": another run is at work on this output; wait for it or end it");
    struct stat locked {};
    struct stat named {};
    return fstat(fileno(journal_.get()), &locked) == 0 &&
           stat(journal_name_.c_str(), &named) == 0 && locked.st_dev == named.st_dev &&
           locked.st_ino == named.st_ino;
}

/// Turns a file without a head into a journal without pieces. Returns its text.
std::string Journal::begin(const std::string& head)
{
    std::string text = std::string(first_line) + head + "\n";
    try {
        // The part file is created after the head, so a part file without a journal is not ours.
        std::error_code ignored;
        if (std::filesystem::exists(part_name_, ignored))
            throw FileError(part_name_.string() +
                            ": is in the way of --resume, and no journal tells what it is; move "
                            "it away or remove it");
        if (ftruncate(fileno(journal_.get()), 0) != 0)
            throw FileError(journal_name_, FileAction::write, errno);
        append(text);
    } catch (const FileError&) {
        std::error_code ignored;
        std::filesystem::remove(journal_name_, ignored);
        throw;
    }
    return text;
}

/// Reads the entries and returns the head.
std::string Journal::read_entries(const std::string& text)
{
    std::string_view rest = text;
    if (!rest.starts_with(first_line))
        throw FileError(journal_name_.string() +
                        ": is not a journal of this version; remove it to begin again");
    rest.remove_prefix(first_line.size());
    const std::string head(cut_line(rest));
    while (!rest.empty())
        if (Entry entry = parse_entry(cut_line(rest)); !entry.empty())
            entries_.push_back(std::move(entry));
    return head;
}

void Journal::add(const Entry& entry)
{
    std::string line;
    for (const std::uint64_t number : entry)
        line += std::to_string(number) + " ";
    line.pop_back();
    line += " " + std::to_string(checksum_of(line)) + "\n";
    append(line);
}

void Journal::append(std::string_view text)
{
    if (std::fwrite(text.data(), 1, text.size(), journal_.get()) != text.size() ||
        std::fflush(journal_.get()) != 0)
        throw FileError(journal_name_, FileAction::write, errno);
}

void Journal::read(std::uint64_t offset, std::span<std::uint8_t> bytes) const
{
    while (!bytes.empty()) {
        const ssize_t got =
            pread(fileno(part_.get()), bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (got < 0 && errno != EINTR)
            throw FileError(part_name_, FileAction::read, errno);
        if (got == 0)
            return;
        if (got > 0) {
            offset += static_cast<std::uint64_t>(got);
            bytes = bytes.subspan(static_cast<std::size_t>(got));
        }
    }
}

void Journal::write(std::uint64_t offset, std::span<const std::uint8_t> bytes)
{
    while (!bytes.empty()) {
        const ssize_t put =
            pwrite(fileno(part_.get()), bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (put < 0 && errno != EINTR)
            throw FileError(part_name_, FileAction::write, errno);
        if (put > 0) {
            offset += static_cast<std::uint64_t>(put);
            bytes = bytes.subspan(static_cast<std::size_t>(put));
        }
    }
}

void Journal::truncate(std::uint64_t length)
{
    if (ftruncate(fileno(part_.get()), static_cast<off_t>(length)) != 0)
        throw FileError(part_name_, FileAction::write, errno);
}

void Journal::remove()
{
    std::error_code ignored;
    // In this order, because a part file without a journal counts as somebody else's.
    std::filesystem::remove(part_name_, ignored);
    std::filesystem::remove(journal_name_, ignored);
}

void Journal::rename_part()
{
    std::error_code error;
    std::filesystem::rename(part_name_, output_, error);
    if (error)
        throw FileError(output_, FileAction::write, error.value());
    remove();
}

}  // namespace packtrace::cli
