#pragma once

#include "scene/language/values.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

// The scene language, one row per key. The reader, the writer, the suggestions in messages and the
// tables of docs/scene.md are all made from the rows.
namespace packtrace::language {

/// A key of a block, and the part of `Owner` that it sets. A default-constructed `Owner` has the
/// default.
template <class Owner>
struct Row {
    std::string_view key;
    std::string_view meaning;
    std::string takes;
    std::function<void(const Field&, Owner&)> read;
    std::function<void(std::string&, const Owner&)> write;
    std::function<bool(const Owner&)> is_set;
    /// The fault of the owner's value, if it is set.
    std::function<Fault(const Owner&)> check;
    std::string_view example{};  ///< of a required key: a value for the message
    /// Whether an owner can have the key, given the keys before it. `fault` is the message if not.
    bool (*condition)(const Owner&) = nullptr;
    std::string_view fault{};
    /// For an owner that cannot have the key: whether the value behind it means nothing, and so is
    /// no fault.
    bool (*is_idle)(const Owner&) = nullptr;
    bool repeatable = false;
    bool omit_default = false;  ///< the writer omits default values

    [[nodiscard]] Row needed(std::string_view value) &&
    {
        example = value;
        return std::move(*this);
    }

    [[nodiscard]] Row only_if(bool (*allowed)(const Owner&), std::string_view message,
                              bool (*idle)(const Owner&) = nullptr) &&
    {
        condition = allowed;
        fault = message;
        is_idle = idle;
        return std::move(*this);
    }

    /// The fault of the owner at this key.
    [[nodiscard]] Fault fault_in(const Owner& owner) const
    {
        if (is_allowed(owner))
            return check ? check(owner) : std::nullopt;
        if (is_idle != nullptr && !is_idle(owner))
            return std::string(fault);
        return std::nullopt;
    }

    [[nodiscard]] bool is_allowed(const Owner& owner) const
    {
        return condition == nullptr || condition(owner);
    }

    [[nodiscard]] std::string text(const Owner& owner) const
    {
        std::string out;
        if (is_set(owner))
            write(out, owner);
        return out;
    }

    [[nodiscard]] bool is_written(const Owner& owner) const
    {
        return is_set(owner) && is_allowed(owner) &&
               !(omit_default && text(owner) == text(Owner{}));
    }
};

template <class Owner>
using Rows = std::vector<Row<Owner>>;

template <class>
inline constexpr bool is_optional = false;
template <class Value>
inline constexpr bool is_optional<std::optional<Value>> = true;

/// A key of the part of an `Owner` that `access` returns.
template <class Owner, class Value, class Access>
Row<Owner> row(std::string_view key, const Type<Value>& type, Access access,
               std::string_view meaning)
{
    using Member = std::decay_t<std::invoke_result_t<Access, Owner&>>;
    return {
        .key = key,
        .meaning = meaning,
        .takes = type.takes,
        .read = [read = type.read, access](
                    const Field& field, Owner& owner) { std::invoke(access, owner) = read(field); },
        .write =
            [write = type.write, access](std::string& out, const Owner& owner) {
                if constexpr (is_optional<Member>)
                    write(out, *std::invoke(access, owner));
                else
                    write(out, std::invoke(access, owner));
            },
        .is_set =
            [access](const Owner& owner) {
                [[maybe_unused]] const Member& member = std::invoke(access, owner);
                if constexpr (is_optional<Member>)
                    return member.has_value();
                else
                    return true;
            },
        .check = [check = type.check, access, key](const Owner& owner) -> Fault {
            const Member& member = std::invoke(access, owner);
            if constexpr (is_optional<Member>)
                return member ? check(key, *member) : std::nullopt;
            else
                return check(key, member);
        },
        .omit_default = std::is_same_v<Member, bool>};
}

/// A key of a member: `&Sphere::radius`.
template <class Owner, class Member, class Value>
Row<Owner> row(std::string_view key, const Type<Value>& type, Member Owner::*member,
               std::string_view meaning)
{
    return row<Owner, Value, Member Owner::*>(key, type, member, meaning);
}

/// scale, rotate, translate, matrix. Each is applied after the transformations before it.
[[nodiscard]] Rows<Mat4> transform_rows();

/// The fault of an object's transform.
[[nodiscard]] Fault fault_of_transform(const Mat4& transform);

/// The rotation about a unit axis, by Rodrigues' formula. A quarter turn takes x to y about z, y to
/// z about x, and z to x about y. Multiples of a quarter turn are exact.
[[nodiscard]] Mat4 axis_rotation(const Vec3& axis, double degrees);

/// The keys of a block that is read into an `Owner`, in the order in which they are read and
/// written.
template <class Owner>
const Rows<Owner> rows;

template <class Owner>
[[nodiscard]] Keys keys()
{
    Keys result;
    for (const Row<Owner>& row : rows<Owner>)
        result.push_back(row.key);
    return result;
}

/// The keys that this owner can have.
template <class Owner>
[[nodiscard]] Keys keys_of(const Owner& owner)
{
    Keys result;
    for (const Row<Owner>& row : rows<Owner>)
        if (row.is_allowed(owner))
            result.push_back(row.key);
    return result;
}

/// The keys that may occur several times in a block.
template <class Owner>
[[nodiscard]] Keys repeatable_keys_of(const Owner&)
{
    Keys result;
    for (const Row<Owner>& row : rows<Owner>)
        if (row.repeatable)
            result.push_back(row.key);
    return result;
}

/// Reads the block's keys into the owner. Throws SceneError for a wrong, a misplaced or a missing
/// key.
template <class Owner>
void read_rows(const Block& block, Owner& owner)
{
    for (const Row<Owner>& row : rows<Owner>) {
        const auto field = block.find(row.key);
        if (row.repeatable) {
            for (const Field& each : block.fields())
                if (each.entry.key.text == row.key)
                    row.read(each, owner);
        } else if (field) {
            row.read(*field, owner);
        }
        const bool allowed = row.is_allowed(owner);
        if (field && !allowed && row.is_idle != nullptr)
            field->refuse(field->entry.key.at, std::string(row.fault));
        if (field && !allowed)
            field->fail(std::string(row.fault));
        if (!field && allowed && !row.example.empty())
            block.fail_missing(row.key, row.example);
    }
}

/// The fault of an owner, and its key.
struct KeyFault {
    std::string_view key;
    std::string message;
};
using OwnerFault = std::optional<KeyFault>;

/// Throws SceneError at the fault's key if the block has it, otherwise at the block.
[[noreturn]] inline void refuse(const Block& block, const KeyFault& fault)
{
    const auto field = block.find(fault.key);
    const Field& at = field ? *field : block.field();
    at.refuse(at.entry.key.at, fault.message);
}

/// The fault of the owner's first key with one.
template <class Owner>
[[nodiscard]] OwnerFault fault_in_rows(const Owner& owner)
{
    for (const Row<Owner>& row : rows<Owner>)
        if (Fault fault = row.fault_in(owner))
            return KeyFault{row.key, *std::move(fault)};
    return std::nullopt;
}

/// Writes each key with is_written(), between `before` and `after`. Returns their number.
template <class Owner>
std::size_t write_rows(std::string& out, const Owner& owner, std::string_view before = " ",
                       std::string_view equals = "=", std::string_view after = "")
{
    std::size_t written = 0;
    for (const Row<Owner>& row : rows<Owner>)
        if (row.is_written(owner)) {
            out.append(before).append(row.key).append(equals);
            row.write(out, owner);
            out += after;
            ++written;
        }
    return written;
}

/// The text of a scene, and its number of keys.
struct SceneText {
    std::string text;
    std::size_t keys = 0;
};

/// The text of a scene, which may have faults. The text of a scene without faults reads back as the
/// same scene.
[[nodiscard]] SceneText write_unchecked(const Scene& scene);

/// The names of the tables that describe the language: "scene", "camera", …
[[nodiscard]] std::span<const std::string_view> key_table_names();

/// A table of docs/scene.md in Markdown, made from the rows. Empty for an unknown name.
[[nodiscard]] std::string key_table(std::string_view name);

}  // namespace packtrace::language
