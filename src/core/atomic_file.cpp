#include "core/atomic_file.hpp"

#include <cerrno>
#include <string>
#include <utility>

#include <unistd.h>

namespace packtrace {
namespace {

// Hidden, and told apart by process and by call, so that writers of one target don't meet.
std::filesystem::path temporary_name(const std::filesystem::path& target, int attempt)
{
    std::string name = ".";
    name += target.filename().string();
    name += "." + std::to_string(getpid()) + "-" + std::to_string(attempt) + ".tmp";
    return target.parent_path() / name;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target))
{
    std::error_code ignored;
    if (std::filesystem::is_directory(target_, ignored))
        throw FileError(target_, "can't write", EISDIR);
    for (int attempt = 0; !file_; ++attempt) {
        temporary_ = temporary_name(target_, attempt);
        file_.reset(std::fopen(temporary_.c_str(), "wbx"));
        if (!file_ && errno != EEXIST)
            throw FileError(target_, "can't write", errno);
    }
}

AtomicFile::~AtomicFile()
{
    file_.reset();
    std::error_code ignored;
    if (!temporary_.empty())
        std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
        throw FileError(target_, "can't write", errno);
}

void AtomicFile::write(std::string_view text)
{
    write(std::as_bytes(std::span(text)));
}

void AtomicFile::commit()
{
    // A full disk may show only now, when the last buffer goes out.
    if (std::fclose(file_.release()) != 0)
        throw FileError(target_, "can't write", errno);
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error)
        throw FileError(target_, "can't write", error.value());
    temporary_.clear();
}

void check_writable(const std::filesystem::path& target)
{
    const AtomicFile probe(target);
}

}  // namespace packtrace
