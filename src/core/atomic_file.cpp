#include "core/atomic_file.hpp"

#include "core/signal_gate.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <fstream>
#include <map>
#include <mutex>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace packtrace {
namespace {

constexpr std::size_t longest_name = 255;  // file name, on every common file system
constexpr std::string_view ending = ".tmp";

/// The prefix of a target's temporary names. It makes them hidden, and is short enough to leave
/// room for the process and the attempt.
std::string temporary_prefix(const std::filesystem::path& target)
{
    constexpr std::size_t room = 40;
    return "." + target.filename().string().substr(0, longest_name - room) + ".";
}

// Contains the process and the attempt, so that several writers of one target do not collide.
std::filesystem::path temporary_name(const std::filesystem::path& target, int attempt)
{
    std::string name = temporary_prefix(target);
    name += std::to_string(getpid()) + "-" + std::to_string(attempt);
    name += ending;
    return target.parent_path() / name;
}

/// The process in a temporary name; 0 for other names.
pid_t writer_of(std::string_view name, std::string_view prefix)
{
    if (!name.starts_with(prefix) || !name.ends_with(ending))
        return 0;
    name.remove_prefix(prefix.size());
    pid_t process = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
    return error == std::errc() && *end == '-' ? process : 0;
}

/// Whether a process no longer exists or is a zombie, and so writes nothing more.
bool has_ended(pid_t process)
{
    if (kill(process, 0) != 0)
        return errno == ESRCH;
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(status, text);
    // The state follows the program's name, which may contain brackets.
    const std::size_t name_end = text.rfind(')');
    return name_end != std::string::npos && text.substr(name_end).starts_with(") Z");
}

/// Whether nobody writes to the file any more: its process has ended, and its lock is free. The
/// lock also covers processes on other machines.
bool is_left_over(const std::filesystem::path& file, pid_t writer)
{
    if (!has_ended(writer))
        return false;
    const int handle = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (handle < 0)
        return false;
    const bool free = flock(handle, LOCK_EX | LOCK_NB) == 0;
    close(handle);
    return free;
}

struct CloseFolder {
    void operator()(DIR* folder) const
    {
        closedir(folder);
    }
};

/// The names in a folder that may be temporary files. Each folder is read once, so that a run with
/// many files does not read it again and again.
std::vector<std::string> temporaries_in(const std::filesystem::path& folder)
{
    static std::mutex mutex;
    static std::map<std::filesystem::path, std::vector<std::string>> known;
    const std::scoped_lock lock(mutex);
    const auto [place, is_new] = known.try_emplace(folder);
    if (!is_new)
        return place->second;
    // Not std::filesystem's iterators, which end the program if there is no memory for a name.
    const std::unique_ptr<DIR, CloseFolder> opened(opendir(folder.c_str()));
    while (const dirent* const entry = opened ? readdir(opened.get()) : nullptr)
        if (const std::string_view name = entry->d_name; name.ends_with(ending))
            place->second.emplace_back(name);
    return place->second;
}

/// The file at the end of a chain of links; it need not exist. A link to a pipe without a name,
/// such as /dev/stdout may be, is not followed.
std::filesystem::path followed(std::filesystem::path target)
{
    constexpr int longest_chain = 40;
    std::error_code error;
    const std::filesystem::path given = target;
    for (int i = 0; i < longest_chain && std::filesystem::is_symlink(target, error); ++i) {
        const std::filesystem::path next = std::filesystem::read_symlink(target, error);
        if (error)
            break;
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    return std::filesystem::exists(given, error) && !std::filesystem::exists(target, error)
               ? given
               : target;
}

/// The name of an existing temporary file. Signal handlers read it, so the name is written before
/// the flag `complete`.
struct TemporarySlot {
    std::atomic<bool> taken{false};
    std::atomic<bool> complete{false};
    std::array<char, PATH_MAX> name{};
};
std::array<TemporarySlot, 64> temporaries;

/// Held from the decision to create a file until its name is in a slot.
SignalGate creation;

/// Stores a name in a slot. Returns the index of the slot; -1 if all are taken or the name is too
/// long.
int note_temporary(const std::filesystem::path& file)
{
    const std::string& name = file.native();
    if (name.size() >= PATH_MAX)
        return -1;
    for (std::size_t i = 0; i < temporaries.size(); ++i) {
        TemporarySlot& slot = temporaries[i];
        if (slot.taken.exchange(true))
            continue;
        std::memcpy(slot.name.data(), name.c_str(), name.size() + 1);
        slot.complete.store(true);
        return static_cast<int>(i);
    }
    return -1;
}

void forget_temporary(int slot)
{
    if (slot < 0)
        return;
    temporaries[static_cast<std::size_t>(slot)].complete.store(false);
    temporaries[static_cast<std::size_t>(slot)].taken.store(false);
}

}  // namespace

void remove_left_over(const std::filesystem::path& target)
{
    const std::filesystem::path file = followed(target);
    const std::string prefix = temporary_prefix(file);
    const std::filesystem::path folder =
        file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    for (const std::string& name : temporaries_in(folder)) {
        const pid_t writer = writer_of(name, prefix);
        std::error_code ignored;
        if (writer != 0 && is_left_over(folder / name, writer))
            std::filesystem::remove(folder / name, ignored);
    }
}

AtomicFile::AtomicFile(std::filesystem::path target) : target_(followed(std::move(target)))
{
    struct stat found {};
    const bool is_there = stat(target_.c_str(), &found) == 0;
    if (!is_there && errno != ENOENT)
        throw FileError(target_, FileAction::write, errno);
    if (is_there && S_ISDIR(found.st_mode))
        throw FileError(target_, FileAction::write, EISDIR);
    if (is_there && access(target_.c_str(), W_OK) != 0)
        throw FileError(target_, FileAction::write, errno);
    std::error_code ignored;
    // followed() leaves only links to files without a name.
    if (is_there && (!S_ISREG(found.st_mode) || std::filesystem::is_symlink(target_, ignored))) {
        open_directly();
        return;
    }
    open_temporary();
    if (is_there)
        belong_as(found);
}

void AtomicFile::belong_as(const struct stat& replaced)
{
    const int handle = fileno(file_.get());
    // Errors are ignored: users may not give files away, and some file systems have no permissions.
    [[maybe_unused]] const int given = fchown(handle, replaced.st_uid, replaced.st_gid);
    [[maybe_unused]] const int set = fchmod(handle, replaced.st_mode & 0777u);
}

void AtomicFile::open_directly()
{
    file_.reset(std::fopen(target_.c_str(), "wb"));
    if (!file_)
        throw FileError(target_, FileAction::write, errno);
}

bool AtomicFile::create_temporary(int attempt)
{
    temporary_ = temporary_name(target_, attempt);
    const SignalGate::Passage passage(creation);
    if (passage.is_late())
        return false;
    file_.reset(std::fopen(temporary_.c_str(), "wbxe"));
    if (file_)
        slot_ = note_temporary(temporary_);
    else if (errno != EEXIST)
        throw FileError(target_, FileAction::write, errno);
    return true;
}

void AtomicFile::open_temporary()
{
    remove_left_over(target_);
    for (int attempt = 0; !file_; ++attempt)
        if (!create_temporary(attempt))
            wait_for_the_end();
    flock(fileno(file_.get()), LOCK_EX | LOCK_NB);
}

void AtomicFile::remove_temporary()
{
    std::error_code ignored;
    if (!temporary_.empty())
        std::filesystem::remove(temporary_, ignored);
    forget_temporary(slot_);
}

AtomicFile::~AtomicFile()
{
    file_.reset();
    remove_temporary();
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
        throw FileError(target_, FileAction::write, errno);
}

void AtomicFile::write(std::string_view text)
{
    write(std::as_bytes(std::span(text)));
}

void AtomicFile::commit()
{
    // Writing the last buffer may find that the disk is full.
    if (std::fclose(file_.release()) != 0)
        throw FileError(target_, FileAction::write, errno);
    if (temporary_.empty())
        return;
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    // The signal handler has removed the file.
    if (error && creation.is_closed())
        wait_for_the_end();
    if (error)
        throw FileError(target_, FileAction::write, error.value());
    temporary_.clear();
    forget_temporary(std::exchange(slot_, -1));
}

void make_folders(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw FileError(folder, FileAction::make_folder, error.value());
}

void check_folder(const std::filesystem::path& folder)
{
    // The only reliable test is to create the missing folders and remove them again.
    struct Missing {
        std::vector<std::filesystem::path> folders;  ///< innermost first
        ~Missing()
        {
            std::error_code ignored;
            for (const std::filesystem::path& each : folders)
                std::filesystem::remove(each, ignored);
        }
    } missing;
    std::error_code ignored;
    for (std::filesystem::path at = std::filesystem::absolute(folder).lexically_normal();
         !std::filesystem::exists(at, ignored) && at.has_relative_path(); at = at.parent_path())
        missing.folders.push_back(at);
    make_folders(folder);
    check_writable(folder / ".packtrace");
}

void write_file(const std::filesystem::path& target, std::string_view text)
{
    AtomicFile file(target);
    file.write(text);
    file.commit();
}

void check_writable(const std::filesystem::path& target)
{
    std::error_code ignored;
    // Opening a pipe would wait for its reader.
    if (std::filesystem::is_fifo(target, ignored))
        return;
    const AtomicFile probe(target);
}

int remove_all_temporaries()
{
    creation.close();
    int removed = 0;
    for (TemporarySlot& slot : temporaries)
        if (slot.complete.load())
            removed += unlink(slot.name.data()) == 0;
    return removed;
}

}  // namespace packtrace
