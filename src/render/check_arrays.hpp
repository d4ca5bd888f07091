#pragma once

#include <packtrace/rays.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>

// These functions throw std::invalid_argument if an array that is read or written is null. Without
// rays all arrays may be null.
namespace packtrace {

inline void check_array(const void* array, const char* name, std::size_t count)
{
    if (array == nullptr && count > 0)
        throw std::invalid_argument(std::string(name) + " is null; give an array of " +
                                    std::to_string(count));
}

template <class Real>
void check_vector(const Real* const (&vector)[3], const char* name, std::size_t count)
{
    for (const Real* component : vector)
        check_array(component, name, count);
}

template <class Real>
void check_rays(const RaysView<Real>& rays)
{
    check_array(rays.org_x, "org_x", rays.count);
    check_array(rays.org_y, "org_y", rays.count);
    check_array(rays.org_z, "org_z", rays.count);
    check_array(rays.dir_x, "dir_x", rays.count);
    check_array(rays.dir_y, "dir_y", rays.count);
    check_array(rays.dir_z, "dir_z", rays.count);
    check_array(rays.t_min, "t_min", rays.count);
    check_array(rays.t_max, "t_max", rays.count);
}

template <class Real>
void check_starts(const StartsView<Real>& starts, std::size_t count)
{
    check_vector(starts.point, "point of starts", count);
    check_array(starts.surface, "surface of starts", count);
}

/// A vector has arrays for all components or for none. Points and starts need the normals.
template <class Real>
void check_hits(const HitsView<Real>& hits, std::size_t count)
{
    check_array(hits.t, "t of hits", count);
    check_array(hits.object, "object of hits", count);
    const auto is_wanted = [](const char* name, const Real* x, const Real* y, const Real* z) {
        if ((x == nullptr) != (y == nullptr) || (x == nullptr) != (z == nullptr))
            throw std::invalid_argument(std::string(name) +
                                        " has arrays for some of x, y and z; give all or none");
        return x != nullptr;
    };
    const bool has_normals = is_wanted("normal", hits.normal_x, hits.normal_y, hits.normal_z);
    const auto check_place = [&](const char* name, const Real* const(&place)[3]) {
        if (is_wanted(name, place[0], place[1], place[2]) && !has_normals)
            throw std::invalid_argument(std::string(name) +
                                        " comes with normals alone; give arrays for them, too");
    };
    check_place("point", hits.point);
    check_place("outer_start", hits.outer_start);
    check_place("inner_start", hits.inner_start);
}

}  // namespace packtrace
