#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace packtrace {

/// Memory for `size` elements of a plain type at a 64-byte boundary, all bytes zero.
template <class T>
class AlignedArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    static constexpr std::size_t alignment = 64;

    AlignedArray() = default;

    explicit AlignedArray(std::size_t size) : size_(size), data_(allocate(size))
    {
        for (std::size_t i = 0; i < size; ++i)
            data_.get()[i] = T{};
    }

    [[nodiscard]] T* data() const
    {
        return data_.get();
    }
    [[nodiscard]] std::size_t size() const
    {
        return size_;
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
        const std::size_t bytes = (size * sizeof(T) + alignment) / alignment * alignment;
        void* memory = std::aligned_alloc(alignment, bytes);
        if (memory == nullptr)
            throw std::bad_alloc();
        return static_cast<T*>(memory);
    }

    std::size_t size_ = 0;
    std::unique_ptr<T, Free> data_;
};

}  // namespace packtrace
