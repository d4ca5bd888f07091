#include <packtrace/unset_allocator.hpp>

#include <cstdlib>
#include <sys/mman.h>

namespace packtrace {
namespace {

constexpr std::size_t alignment = 64;
constexpr std::size_t huge_page = std::size_t{1} << 21;

/// From this size on, what would be taken in small pages has a huge one: it costs less than that
/// many small ones, and what is left of it is never more than three times as much.
constexpr std::size_t worth_a_huge_page = huge_page / 4;

/// Bytes to ask for: whole huge pages, but for a rest that is not worth one.
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
    // Rays walk large arrays in no order, and first frames touch all pages; a refusal costs time
    // only.
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
