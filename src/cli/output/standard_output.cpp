#include "cli/output/standard_output.hpp"

#include "core/read_file.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <unistd.h>

namespace packtrace::cli {

void hold_standard_output()
{
    if (fcntl(STDOUT_FILENO, F_GETFD) >= 0 || errno != EBADF)
        return;
    // Read-only, so that writing fails as it does on a closed descriptor.
    const int nothing = open("/dev/null", O_RDONLY);
    if (nothing < 0 || nothing == STDOUT_FILENO)
        return;
    dup2(nothing, STDOUT_FILENO);
    close(nothing);
}

void check_standard_output()
{
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0;
    if (!std::cout || !flushed || std::ferror(stdout) != 0)
        throw FileError("standard output", FileAction::write, errno != 0 ? errno : EIO);
}

}  // namespace packtrace::cli
