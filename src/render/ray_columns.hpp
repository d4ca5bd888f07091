#pragma once

#include <packtrace/rays.hpp>
#include <packtrace/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

// The caller's own rays in arrays that grow, and arrays for their hits.
namespace packtrace {

/// The vector at index i of three columns.
template <class Real>
[[nodiscard]] Vec3 vector_at(const std::array<std::vector<Real>, 3>& columns, std::size_t i)
{
    return {columns[0][i], columns[1][i], columns[2][i]};
}

/// Rays by column: origin, direction, t_min, t_max.
template <class Real>
struct RayColumns {
    std::array<std::vector<Real>, 8> columns;

    [[nodiscard]] std::size_t size() const
    {
        return columns[0].size();
    }

    void add(const std::array<Real, 8>& ray)
    {
        for (std::size_t i = 0; i < columns.size(); ++i)
            columns[i].push_back(ray[i]);
    }

    /// Rounded to `Real`.
    void add(const Vec3& org, const Vec3& dir, double t_min = 0.0,
             double t_max = std::numeric_limits<double>::infinity())
    {
        const auto real = [](double value) { return static_cast<Real>(value); };
        add({real(org.x), real(org.y), real(org.z), real(dir.x), real(dir.y), real(dir.z),
             real(t_min), real(t_max)});
    }

    [[nodiscard]] RaysView<Real> view() const
    {
        return view(0, size());
    }

    [[nodiscard]] RaysView<Real> view(std::size_t first, std::size_t count) const
    {
        const auto at = [&](std::size_t i) { return columns[i].data() + first; };
        return {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), count};
    }
};

/// Closest hits by column.
template <class Real>
struct HitColumns {
    std::vector<Real> t;
    std::vector<std::int32_t> object;
    std::array<std::vector<Real>, 3> normal;

    explicit HitColumns(std::size_t count = 0)
    {
        resize(count);
    }

    void resize(std::size_t count)
    {
        t.resize(count);
        object.resize(count);
        for (auto& column : normal)
            column.resize(count);
    }

    [[nodiscard]] HitsView<Real> view()
    {
        return {t.data(), object.data(), normal[0].data(), normal[1].data(), normal[2].data()};
    }

    bool operator==(const HitColumns&) const = default;

    [[nodiscard]] SurfaceHit<Real> operator[](std::size_t i) const
    {
        return {t[i], object[i], {normal[0][i], normal[1][i], normal[2][i]}};
    }
};

/// Closest hits by column, with the arrays of HitsView for rays that leave the hits.
template <class Real>
struct LeftHitColumns : HitColumns<Real> {
    std::array<std::vector<Real>, 3> outer_start;
    std::array<std::vector<Real>, 3> inner_start;
    std::array<std::vector<Real>, 3> point;
    std::vector<std::int32_t> surface;

    explicit LeftHitColumns(std::size_t count) : HitColumns<Real>(count), surface(count)
    {
        for (auto* columns : {&outer_start, &inner_start, &point})
            for (auto& column : *columns)
                column.resize(count);
    }

    [[nodiscard]] HitsView<Real> view()
    {
        HitsView<Real> hits = HitColumns<Real>::view();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            hits.outer_start[axis] = outer_start[axis].data();
            hits.inner_start[axis] = inner_start[axis].data();
            hits.point[axis] = point[axis].data();
        }
        hits.surface = surface.data();
        return hits;
    }
};

/// The surfaces that rays start on, by column.
template <class Real>
struct StartColumns {
    std::array<std::vector<Real>, 3> point;
    std::vector<std::int32_t> surface;

    void add(const Vec3& place, std::int32_t number)
    {
        for (int axis = 0; axis < 3; ++axis)
            point[static_cast<std::size_t>(axis)].push_back(static_cast<Real>(place[axis]));
        surface.push_back(number);
    }

    [[nodiscard]] StartsView<Real> view(std::size_t first = 0) const
    {
        return {{point[0].data() + first, point[1].data() + first, point[2].data() + first},
                surface.data() + first};
    }
};

}  // namespace packtrace
