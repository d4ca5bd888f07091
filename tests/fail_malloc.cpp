// A library to preload into a program. It makes one allocation fail: number FAIL_MALLOC_AT, an
// environment variable, counted from the start of main(). With FAIL_MALLOC_AT=count none fails, and
// the last line of standard error gives the number of allocations. With
// FAIL_MALLOC_AT=FIRST..LAST..STEP, main() runs once for each of these numbers. Each run is a
// process in the folder NUMBER with standard error in NUMBER.err; this takes half the time of
// starting the program once per number. When a run ends, a line `NUMBER STATUS` gives its exit
// code, or 128 plus its signal. A program linked with this file chooses the allocation itself and
// counts unfreed blocks (fail_malloc.hpp).
#include "fail_malloc.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}

namespace {

using Main = int (*)(int, char**, char**);
using StartMain = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);

constexpr long enough = 1000000000;
std::atomic<long> left{0};
std::atomic<long> live{0};
Main real_main = nullptr;

bool fails()
{
    if (left.load() <= 0 || left.fetch_sub(1) != 1)
        return false;
    errno = ENOMEM;
    return true;
}

void* counted(void* block)
{
    if (block != nullptr)
        ++live;
    return block;
}

void print_count()
{
    std::fprintf(stderr, "%ld\n", enough - left.load());
}

/// Begins the copy of this process in which allocation `number` fails.
void begin_run(long number)
{
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%ld.err", number);
    const int errors = open(name.data(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    std::snprintf(name.data(), name.size(), "%ld", number);
    if (errors < 0 || dup2(errors, STDERR_FILENO) < 0 || close(errors) != 0 ||
        mkdir(name.data(), 0700) != 0 || chdir(name.data()) != 0)
        _exit(125);
    left = number;
}

/// True in a copy of the process that runs one of the numbers; false in the original process after
/// all runs.
bool is_run(long first, long last, long step)
{
    for (long number = first; number <= last; number += step) {
        std::fflush(stdout);
        const pid_t process = fork();
        if (process == 0) {
            begin_run(number);
            return true;
        }
        int status = 0;
        if (process < 0 || waitpid(process, &status, 0) != process)
            _exit(125);
        std::printf("%ld %d\n", number,
                    WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
    }
    return false;
}

int counted_main(int count, char** words, char** environment)
{
    const char* const at = std::getenv("FAIL_MALLOC_AT");
    const bool counts = at != nullptr && std::strcmp(at, "count") == 0;
    if (counts)
        std::atexit(print_count);
    long first = 0;
    long last = 0;
    long step = 0;
    if (at != nullptr && std::sscanf(at, "%ld..%ld..%ld", &first, &last, &step) == 3)
        return is_run(first, last, step) ? real_main(count, words, environment) : 0;
    left = counts ? enough : at == nullptr ? 0 : std::atol(at);
    return real_main(count, words, environment);
}

}  // namespace

extern "C" {

bool fail_malloc_at(long number)
{
    return left.exchange(number) <= 0;
}

long live_blocks()
{
    return live.load();
}

void* malloc(std::size_t size) noexcept
{
    return fails() ? nullptr : counted(__libc_malloc(size));
}

void* calloc(std::size_t count, std::size_t size) noexcept
{
    return fails() ? nullptr : counted(__libc_calloc(count, size));
}

void* realloc(void* block, std::size_t size) noexcept
{
    if (fails())
        return nullptr;
    void* const moved = __libc_realloc(block, size);
    if (block == nullptr)
        counted(moved);
    else if (moved == nullptr && size == 0)
        --live;
    return moved;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept
{
    return fails() ? nullptr : counted(__libc_memalign(alignment, size));
}

void* memalign(std::size_t alignment, std::size_t size) noexcept
{
    return fails() ? nullptr : counted(__libc_memalign(alignment, size));
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept
{
    *block = fails() ? nullptr : counted(__libc_memalign(alignment, size));
    return *block == nullptr ? ENOMEM : 0;
}

void free(void* block) noexcept
{
    if (block != nullptr)
        --live;
    __libc_free(block);
}

int __libc_start_main(Main main, int count, char** words, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end)
{
    const auto next = reinterpret_cast<StartMain>(dlsym(RTLD_NEXT, "__libc_start_main"));
    real_main = main;
    return next(counted_main, count, words, init, fini, rtld_fini, stack_end);
}
}
