#pragma once

#include "fuzzer.hpp"

#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace packtrace::fuzz {

/// A file in memory that holds the bytes, for readers that take a file name.
class InputFile {
public:
    explicit InputFile(Bytes bytes) : handle_(memfd_create("input", MFD_CLOEXEC))
    {
        require(handle_ >= 0 && write(handle_, bytes.data(), bytes.size()) ==
                                    static_cast<ssize_t>(bytes.size()),
                "a file in memory can be written");
    }
    ~InputFile()
    {
        close(handle_);
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    [[nodiscard]] std::string name() const
    {
        return "/proc/self/fd/" + std::to_string(handle_);
    }

private:
    int handle_;
};

}  // namespace packtrace::fuzz
