#pragma once

#include <packtrace/unset_allocator.hpp>

#include <cstddef>
#include <memory>
#include <type_traits>

namespace packtrace {

/// `size` elements of a trivially copyable type, aligned to at least 64 bytes. Each is T{} unless
/// the array comes from unset().
template <class T>
class AlignedArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    AlignedArray() = default;

    explicit AlignedArray(std::size_t size) : size_(size), data_(allocate(size))
    {
        for (std::size_t i = 0; i < size; ++i)
            data_.get()[i] = T{};
    }

    /// An array without initial values, so that several threads can set them at once.
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
    /// The size of the elements in bytes.
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
            return_pages(memory);
        }
    };

    static T* allocate(std::size_t size)
    {
        return UnsetAllocator<T>().allocate(size);
    }

    std::size_t size_ = 0;
    std::unique_ptr<T, Free> data_;
};

}  // namespace packtrace
