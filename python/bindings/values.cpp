#include "values.hpp"

#include <limits>
#include <string_view>

namespace packtrace::python {
namespace {

/// Reads a number, or an element of a sequence, as double. Returns false for other values.
bool read_number(py::handle value, double& to)
{
    // Rejects a bool and a text, which Python would convert to a number.
    if (PyBool_Check(value.ptr()) != 0 || PyUnicode_Check(value.ptr()) != 0)
        return false;
    to = PyFloat_AsDouble(value.ptr());
    if (to != -1.0 || PyErr_Occurred() == nullptr)
        return true;
    PyErr_Clear();
    return false;
}

template <class Matrix>
void read_rows(py::handle value, const std::string& key, Matrix& to)
{
    constexpr int size = Matrix::length();
    const std::string use = std::to_string(size) + " rows of " + std::to_string(size) + " numbers";
    const std::vector<py::object> rows = elements_of(value, key);
    if (rows.size() != static_cast<std::size_t>(size))
        throw_wrong(key, value, use);
    for (int row = 0; row < size; ++row) {
        std::array<double, static_cast<std::size_t>(size)> numbers;
        from_python(rows[static_cast<std::size_t>(row)], key, numbers);
        for (int column = 0; column < size; ++column)
            to[column][row] = numbers[static_cast<std::size_t>(column)];
    }
}

template <class Matrix>
py::tuple rows_of(const Matrix& value)
{
    constexpr int size = Matrix::length();
    py::tuple rows(static_cast<std::size_t>(size));
    for (int row = 0; row < size; ++row) {
        py::tuple numbers(static_cast<std::size_t>(size));
        for (int column = 0; column < size; ++column)
            numbers[static_cast<std::size_t>(column)] = value[column][row];
        rows[static_cast<std::size_t>(row)] = numbers;
    }
    return rows;
}

/// Joins the lines of a text. The repr of an array has one line per row.
py::object on_one_line(py::object text)
{
    py::list lines = text.attr("splitlines")();
    for (std::size_t i = 0; i < lines.size(); ++i)
        lines[i] = lines[i].attr("strip")();
    return py::str(" ").attr("join")(lines);
}

}  // namespace

void throw_wrong(const std::string& key, py::handle value, const std::string& use)
{
    // Counted in characters, so that none is cut.
    constexpr py::ssize_t longest = 60;
    const py::object all = on_one_line(py::repr(value));
    const bool is_long = PyUnicode_GET_LENGTH(all.ptr()) > longest;
    const py::object begin = all[py::slice(0, longest, 1)];
    const std::string shown = begin.attr("encode")("utf-8", "backslashreplace").cast<std::string>();
    throw py::value_error(key + " is " + shown + (is_long ? "..." : "") + "; use " + use);
}

std::optional<std::string> text_of(py::handle value)
{
    if (PyUnicode_Check(value.ptr()) == 0)
        return std::nullopt;
    const auto bytes = py::reinterpret_steal<py::bytes>(
        PyUnicode_AsEncodedString(value.ptr(), "utf-8", "surrogateescape"));
    if (!bytes) {
        PyErr_Clear();
        return std::nullopt;
    }
    return static_cast<std::string>(bytes);
}

py::str to_python(const std::string& text)
{
    PyObject* const decoded =
        PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "surrogateescape");
    if (decoded == nullptr)
        throw py::error_already_set();
    return py::reinterpret_steal<py::str>(decoded);
}

void read_numbers(py::handle value, const std::string& key, double* to, std::size_t count)
{
    const std::string use = std::to_string(count) + " numbers";
    if (PyUnicode_Check(value.ptr()) != 0)
        throw_wrong(key, value, use);
    // A tuple, because it cannot change: an element's __float__ could shorten its list.
    const auto elements = py::reinterpret_steal<py::object>(PySequence_Tuple(value.ptr()));
    if (!elements) {
        PyErr_Clear();
        throw_wrong(key, value, use);
    }
    if (static_cast<std::size_t>(PyTuple_GET_SIZE(elements.ptr())) != count)
        throw_wrong(key, value, use);
    for (std::size_t i = 0; i < count; ++i)
        if (!read_number(PyTuple_GET_ITEM(elements.ptr(), static_cast<Py_ssize_t>(i)), to[i]))
            throw_wrong(key, value, use);
}

std::vector<py::object> elements_of(py::handle value, const std::string& key)
{
    // Rejects iterators, which would be empty at the next conversion.
    if (PyUnicode_Check(value.ptr()) != 0 || PyIter_Check(value.ptr()) != 0 ||
        !py::isinstance<py::iterable>(value))
        throw_wrong(key, value, "a list");
    std::vector<py::object> elements;
    for (const py::handle element : py::reinterpret_borrow<py::iterable>(value))
        elements.push_back(py::reinterpret_borrow<py::object>(element));
    return elements;
}

void from_python(py::handle value, const std::string& key, double& to)
{
    if (!read_number(value, to))
        throw_wrong(key, value, "a number");
}

void from_python(py::handle value, const std::string& key, int& to)
{
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    PyErr_Clear();
    if (!number || PyBool_Check(value.ptr()) != 0)
        throw_wrong(key, value, "a whole number");
    constexpr int least = std::numeric_limits<int>::min();
    constexpr int most = std::numeric_limits<int>::max();
    int overflow = 0;
    const long long whole = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
    if (overflow != 0 || whole < least || whole > most)
        // The fields' own ranges are narrower, so these limits would mislead.
        throw_wrong(key, value,
                    overflow < 0 || (overflow == 0 && whole < least) ? "a larger whole number"
                                                                     : "a smaller whole number");
    to = static_cast<int>(whole);
}

void from_python(py::handle value, const std::string& key, bool& to)
{
    const std::string_view type = Py_TYPE(value.ptr())->tp_name;
    if (PyBool_Check(value.ptr()) == 0 && type != "numpy.bool_" && type != "numpy.bool")
        throw_wrong(key, value, "True or False");
    to = PyObject_IsTrue(value.ptr()) == 1;
}

void from_python(py::handle value, const std::string& key, std::string& to)
{
    const std::optional<std::string> text = text_of(value);
    if (!text)
        throw_wrong(key, value, "a text");
    to = *text;
}

void from_python(py::handle value, const std::string& key, Vec2& to)
{
    read_numbers(value, key, &to.x, 2);
}

void from_python(py::handle value, const std::string& key, Vec3& to)
{
    read_numbers(value, key, &to.x, 3);
}

void from_python(py::handle value, const std::string& key, Mat3& to)
{
    read_rows(value, key, to);
}

void from_python(py::handle value, const std::string& key, Mat4& to)
{
    read_rows(value, key, to);
    if (to[0][3] != 0.0 || to[1][3] != 0.0 || to[2][3] != 0.0 || to[3][3] != 1.0)
        throw_wrong(key, value, "a matrix with the last row (0, 0, 0, 1)");
}

Rgb color_of(py::handle value, const std::string& key)
{
    double grey = 0.0;
    if (read_number(value, grey))
        return Rgb(grey);
    return value_of<Vec3>(value, key);
}

py::tuple to_python(const Vec2& value)
{
    return py::make_tuple(value.x, value.y);
}

py::tuple to_python(const Vec3& value)
{
    return py::make_tuple(value.x, value.y, value.z);
}

py::tuple to_python(const Mat3& value)
{
    return rows_of(value);
}

py::tuple to_python(const Mat4& value)
{
    return rows_of(value);
}

}  // namespace packtrace::python
