#pragma once

#include <packtrace/vec.hpp>

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// Numbers, words and vectors from Python and back. What they are given for, `key`, is named by the
// ValueError that a wrong one raises.
namespace packtrace::python {

namespace py = pybind11;

/// "radius is 'big'; use a number".
[[noreturn]] void throw_wrong(const std::string& key, py::handle value, const std::string& use);

/// A text as UTF-8, and what to_python() makes of other bytes as those; nothing for anything else,
/// and for a text that has no UTF-8 (any other surrogate alone).
[[nodiscard]] std::optional<std::string> text_of(py::handle value);

/// UTF-8 as a text. Scenes may be in another encoding: other bytes become surrogates, one each.
[[nodiscard]] py::str to_python(const std::string& text);

void from_python(py::handle value, const std::string& key, double& to);
void from_python(py::handle value, const std::string& key, int& to);
void from_python(py::handle value, const std::string& key, bool& to);
void from_python(py::handle value, const std::string& key, std::string& to);
void from_python(py::handle value, const std::string& key, Vec2& to);
void from_python(py::handle value, const std::string& key, Vec3& to);
void from_python(py::handle value, const std::string& key, Mat3& to);
void from_python(py::handle value, const std::string& key, Mat4& to);

/// `count` numbers of any sequence.
void read_numbers(py::handle value, const std::string& key, double* to, std::size_t count);

/// The elements of any sequence; an iterator is none.
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

/// None is no value.
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
