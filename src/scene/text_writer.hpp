#pragma once

#include <packtrace/vec.hpp>

#include <charconv>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace packtrace::writer {

/// Grows a text in the scene language.
class TextWriter {
public:
    TextWriter& put(std::string_view text)
    {
        text_ += text;
        return *this;
    }

    TextWriter& put(int number)
    {
        text_ += std::to_string(number);
        return *this;
    }

    /// The shortest form that reads back as the same double.
    TextWriter& put(double number)
    {
        char buffer[32];
        const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, number);
        text_.append(buffer, end);
        return *this;
    }

    /// (a, b, …)
    TextWriter& put(std::span<const double> numbers)
    {
        for (std::size_t i = 0; i < numbers.size(); ++i)
            put(i == 0 ? "(" : ",").put(numbers[i]);
        return put(")");
    }

    TextWriter& put(const Vec3& v)
    {
        return put(std::span<const double>(&v.x, 3));
    }

    /// Linear, each channel 0 to 1.
    TextWriter& put_color(const Rgb& color)
    {
        return put("rgb").put(color);
    }

    TextWriter& put_name(std::string_view name)
    {
        for (const char c : name)
            if (c == '"' || static_cast<unsigned char>(c) < 0x20u || c == 0x7f)
                throw std::invalid_argument(
                    "a name with quotes or control characters can't be written as a scene");
        return put("\"").put(name).put("\"");
    }

    /// A line `key = value`, of anything that `put` takes.
    template <class Value>
    TextWriter& line(std::string_view key, const Value& value)
    {
        return put(key).put(" = ").put(value).put("\n");
    }

    [[nodiscard]] std::string take()
    {
        return std::move(text_);
    }

private:
    std::string text_;
};

}  // namespace packtrace::writer
