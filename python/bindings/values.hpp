#pragma once

#include <packtrace/vec.hpp>

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// Converts numbers, words and vectors from Python and back. Wrong values raise ValueError, which
// names the `key` that the value is for.
namespace packtrace::python {

namespace py = pybind11;

/// "radius is 'big'; use a number".
[[noreturn]] void throw_wrong(const std::string& key, py::handle value, const std::string& use);

/// A text as UTF-8. The surrogates of to_python() become the original bytes. Not set for other
/// values, and for a text that cannot be UTF-8, because it has another single surrogate.
[[nodiscard]] std::optional<std::string> text_of(py::handle value);

/// A text from UTF-8. Scenes may have another encoding, so each other byte becomes a surrogate.
[[nodiscard]] py::str to_python(const std::string& text);

void from_python(py::handle value, const std::string& key, double& to);
void from_python(py::handle value, const std::string& key, int& to);
void from_python(py::handle value, const std::string& key, bool& to);
void from_python(py::handle value, const std::string& key, std::string& to);
void from_python(py::handle value, const std::string& key, Vec2& to);
void from_python(py::handle value, const std::string& key, Vec3& to);
void from_python(py::handle value, const std::string& key, Mat3& to);
void from_python(py::handle value, const std::string& key, Mat4& to);

/// Reads `count` numbers from any sequence.
void read_numbers(py::handle value, const std::string& key, double* to, std::size_t count);

/// The elements of any sequence. An iterator is not a sequence.
[[nodiscard]] std::vector<py::object> elements_of(py::handle value, const std::string& key);

/// A colour: three numbers, or one for all channels.
[[nodiscard]] Rgb color_of(py::handle value, const std::string& key);

[[nodiscard]] py::tuple to_python(const Vec2& value);
[[nodiscard]] py::tuple to_python(const Vec3& value);
[[nodiscard]] py::tuple to_python(const Mat3& value);
[[nodiscard]] py::tuple to_python(const Mat4& value);

template <std::size_t count>
void from_python(py::handle value, const std::string& key, std::array<double, count>& to)
{
    read_numbers(value, key, to.data(), count);
}

template <std::size_t count>
[[nodiscard]] py::tuple to_python(const std::array<double, count>& value)
{
    py::tuple result(count);
    for (std::size_t i = 0; i < count; ++i)
        result[i] = value[i];
    return result;
}

template <class T>
[[nodiscard]] T value_of(py::handle value, const std::string& key)
{
    T result{};
    from_python(value, key, result);
    return result;
}

/// Not set for None.
template <class T>
[[nodiscard]] std::optional<T> optional_of(py::handle value, const std::string& key)
{
    if (value.is_none())
        return std::nullopt;
    return value_of<T>(value, key);
}

/// The attribute `key` of an object.
template <class T>
[[nodiscard]] T field(py::handle object, const char* key)
{
    return value_of<T>(object.attr(key), key);
}

}  // namespace packtrace::python
