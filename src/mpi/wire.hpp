#pragma once

#include "image/bytes.hpp"

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

// Converts values to the bytes of a message and back, between ranks of one version. A type defines
// its fields by each_field(wire, value), which calls wire(field, …) for both writing and reading.
namespace packtrace::mpi {

template <class T>
concept Plain = std::is_trivially_copyable_v<T>;

class WireWriter {
public:
    template <class... T>
    void operator()(const T&... values)
    {
        (put(values), ...);
    }

    Bytes bytes;

private:
    void put_bytes(const void* data, std::size_t size)
    {
        const auto* const from = static_cast<const std::uint8_t*>(data);
        bytes.insert(bytes.end(), from, from + size);
    }
    template <Plain T>
    void put(const T& value)
    {
        put_bytes(&value, sizeof value);
    }
    void put(const std::string& text)
    {
        put(text.size());
        put_bytes(text.data(), text.size());
    }
    template <class T, class A>
    void put(const std::vector<T, A>& values)
    {
        put(values.size());
        if constexpr (Plain<T>)
            put_bytes(values.data(), values.size() * sizeof(T));
        else
            for (const T& value : values)
                put(value);
    }
    template <class T>
    void put(const T& value)
    {
        each_field(*this, value);
    }
};

class WireReader {
public:
    explicit WireReader(const Bytes& bytes)
        : WireReader({reinterpret_cast<const char*>(bytes.data()), bytes.size()})
    {
    }
    explicit WireReader(std::string_view bytes) : bytes_(bytes)
    {
    }

    /// Throws std::runtime_error if the message is too short.
    template <class... T>
    void operator()(T&... values)
    {
        (get(values), ...);
    }

private:
    void get_bytes(void* data, std::size_t size)
    {
        if (size > bytes_.size() - at_)
            throw std::runtime_error("packtrace-mpi: a message is shorter than what it says");
        if (size > 0)
            std::memcpy(data, bytes_.data() + at_, size);
        at_ += size;
    }
    template <Plain T>
    void get(T& value)
    {
        get_bytes(&value, sizeof value);
    }
    std::size_t get_count()
    {
        std::size_t count = 0;
        get(count);
        if (count > bytes_.size() - at_)
            throw std::runtime_error("packtrace-mpi: a message is shorter than what it says");
        return count;
    }
    void get(std::string& text)
    {
        text.resize(get_count());
        get_bytes(text.data(), text.size());
    }
    template <class T, class A>
    void get(std::vector<T, A>& values)
    {
        values.resize(get_count());
        if constexpr (Plain<T>)
            get_bytes(values.data(), values.size() * sizeof(T));
        else
            for (T& value : values)
                get(value);
    }
    template <class T>
    void get(T& value)
    {
        each_field(*this, value);
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
};

}  // namespace packtrace::mpi
