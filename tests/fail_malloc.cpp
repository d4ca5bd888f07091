// Preloaded into a program, it lets one allocation fail: the one whose number, counted from the
// start of main(), the variable FAIL_MALLOC_AT names. With FAIL_MALLOC_AT=count none fails, and the
// end of standard error says how many there were.
#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

using Main = int (*)(int, char**, char**);
using StartMain = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);

constexpr long enough = 1000000000;
std::atomic<long> left{0};
Main real_main = nullptr;

bool fails()
{
    if (left.load() <= 0 || left.fetch_sub(1) != 1)
        return false;
    errno = ENOMEM;
    return true;
}

void print_count()
{
    std::fprintf(stderr, "%ld\n", enough - left.load());
}

int counted_main(int count, char** words, char** environment)
{
    const char* const at = std::getenv("FAIL_MALLOC_AT");
    const bool counts = at != nullptr && std::strcmp(at, "count") == 0;
    if (counts)
        std::atexit(print_count);
    left = counts ? enough : at == nullptr ? 0 : std::atol(at);
    return real_main(count, words, environment);
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept
{
    return fails() ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept
{
    return fails() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) noexcept
{
    return fails() ? nullptr : __libc_realloc(block, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept
{
    return fails() ? nullptr : __libc_memalign(alignment, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept
{
    return fails() ? nullptr : __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) noexcept
{
    *block = fails() ? nullptr : __libc_memalign(alignment, size);
    return *block == nullptr ? ENOMEM : 0;
}

int __libc_start_main(Main main, int count, char** words, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end)
{
    const auto next = reinterpret_cast<StartMain>(dlsym(RTLD_NEXT, "__libc_start_main"));
    real_main = main;
    return next(counted_main, count, words, init, fini, rtld_fini, stack_end);
}
}
