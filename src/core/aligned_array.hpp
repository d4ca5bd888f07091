#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#include <sys/mman.h>

namespace packtrace {

/// Memory for `size` elements of a plain type at a 64-byte boundary, all bytes zero; in huge
/// pages, where the system has any, from the size of one on.
template <class T>
class AlignedArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    static constexpr std::size_t alignment = 64;
    static constexpr std::size_t huge_page = std::size_t{1} << 21;

    AlignedArray() = default;

    explicit AlignedArray(std::size_t size) : size_(size), data_(allocate(size))
    {
        for (std::size_t i = 0; i < size; ++i)
            data_.get()[i] = T{};
    }

    /// With any bytes, to be set by several threads at once.
    [[nodiscard]] static AlignedArray unset(std::size_t size)
    {
        AlignedArray array;
        array.size_ = size;
        array.data_.reset(allocate(size));
        return array;
    }

    [[nodiscard]] T* data() const
    {
        return data_.get();
    }
    [[nodiscard]] std::size_t size() const
    {
        return size_;
    }
    /// Of the elements.
    [[nodiscard]] std::size_t bytes() const
    {
        return size_ * sizeof(T);
    }
    [[nodiscard]] T& operator[](std::size_t i) const
    {
        return data_.get()[i];
    }

private:
    struct Free {
        void operator()(T* memory) const
        {
            std::free(memory);
        }
    };

    static T* allocate(std::size_t size)
    {
        const std::size_t wanted = size * sizeof(T);
        const std::size_t boundary = wanted < huge_page ? alignment : huge_page;
        // Not up to the next huge page: what is left over is taken in small ones.
        const std::size_t bytes = (wanted + alignment) / alignment * alignment;
        void* memory = nullptr;
        if (posix_memalign(&memory, boundary, bytes) != 0)
            throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
        // Rays walk large arrays in no order; a refusal costs time only.
        if (boundary == huge_page)
            (void)madvise(memory, bytes, MADV_HUGEPAGE);
#endif
        return static_cast<T*>(memory);
    }

    std::size_t size_ = 0;
    std::unique_ptr<T, Free> data_;
};

}  // namespace packtrace
