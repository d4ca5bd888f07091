#include <packtrace/unset_allocator.hpp>

#include <cstdlib>

#include <sys/mman.h>

namespace packtrace {
namespace {

constexpr std::size_t alignment = 64;
constexpr std::size_t huge_page = std::size_t{1} << 21;

}  // namespace

void* take_pages(std::size_t bytes)
{
    if (bytes > std::numeric_limits<std::size_t>::max() - alignment)
        throw std::bad_alloc();
    const std::size_t boundary = bytes < huge_page ? alignment : huge_page;
    // Not up to the next huge page: what is left over is taken in small ones.
    const std::size_t rounded = (bytes + alignment) / alignment * alignment;
    void* memory = nullptr;
    if (posix_memalign(&memory, boundary, rounded) != 0)
        throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
    // Rays walk large arrays in no order, and first frames touch all pages; a refusal costs time only.
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
