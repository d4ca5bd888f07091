#include <packtrace/unset_allocator.hpp>

#include <cstdlib>
#include <sys/mman.h>

namespace packtrace {
namespace {

constexpr std::size_t alignment = 64;
constexpr std::size_t huge_page = std::size_t{1} << 21;

/// From this size on, memory is taken in a huge page. It costs less than as many small pages, and
/// the unused rest is at most three times the used part.
constexpr std::size_t worth_a_huge_page = huge_page / 4;

/// The number of bytes to allocate: whole huge pages, and a rest that is too small for one.
std::size_t rounded_up(std::size_t bytes)
{
    const std::size_t step = bytes % huge_page >= worth_a_huge_page ? huge_page : alignment;
    return bytes + (step - bytes % step);
}

}  // namespace

void* take_pages(std::size_t bytes)
{
    if (bytes > std::numeric_limits<std::size_t>::max() - huge_page)
        throw std::bad_alloc();
    const std::size_t boundary = bytes < worth_a_huge_page ? alignment : huge_page;
    const std::size_t rounded = rounded_up(bytes);
    void* memory = nullptr;
    if (posix_memalign(&memory, boundary, rounded) != 0)
        throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
    // Rays access large arrays in random order, and first frames touch all pages. An error only
    // costs time, so it is ignored.
    if (boundary == huge_page)
        (void)madvise(memory, rounded, MADV_HUGEPAGE);
#endif
    return memory;
}

void return_pages(void* memory)
{
    std::free(memory);
}

}  // namespace packtrace
