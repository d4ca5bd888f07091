// Rays through the C++ library, on arrays of rays.py, which calls these functions through ctypes.
// Times are measured here, without the calls.
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace {

using packtrace::RayScene;

template <class Real>
double seconds_of(const void* scene, const Real* const* columns, std::size_t count,
                  Real* const* hits, std::int32_t* object)
{
    const auto start = std::chrono::steady_clock::now();
    static_cast<const RayScene<Real>*>(scene)->closest_hits(
        {columns[0], columns[1], columns[2], columns[3], columns[4], columns[5], columns[6],
         columns[7], count},
        {hits[0], object, hits[1], hits[2], hits[3]});
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Vectors (n, 3) are copied into columns, a block at a time, by a plain loop as users would write.
template <class Real>
double seconds_of_vectors(const void* scene, const Real* origins, const Real* directions,
                          std::size_t count, Real* const* hits, std::int32_t* object)
{
    constexpr std::size_t block = 4096;
    const auto start = std::chrono::steady_clock::now();
    std::vector<Real> columns(8 * block, Real(0));
    Real* const at = columns.data();
    std::fill_n(at + 7 * block, block, std::numeric_limits<Real>::infinity());
    for (std::size_t first = 0; first < count; first += block) {
        const std::size_t rays = std::min(block, count - first);
        for (std::size_t i = 0; i < rays; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                at[axis * block + i] = origins[3 * (first + i) + axis];
                at[(3 + axis) * block + i] = directions[3 * (first + i) + axis];
            }
        packtrace::HitsView<Real> to{hits[0] + first, object + first};
        if (hits[1] != nullptr)
            to = {hits[0] + first, object + first, hits[1] + first, hits[2] + first,
                  hits[3] + first};
        static_cast<const RayScene<Real>*>(scene)->closest_hits(
            {at, at + block, at + 2 * block, at + 3 * block, at + 4 * block, at + 5 * block,
             at + 6 * block, at + 7 * block, rays},
            to);
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Real>
void* new_scene(const char* text)
{
    return std::make_unique<RayScene<Real>>(packtrace::parse_scene(text, "race")).release();
}

}  // namespace

extern "C" {

// Rays are eight columns. Hits are t and the components of normals, which may be null.
[[gnu::visibility("default")]] void* scene_float(const char* text)
{
    return new_scene<float>(text);
}

[[gnu::visibility("default")]] void* scene_double(const char* text)
{
    return new_scene<double>(text);
}

[[gnu::visibility("default")]] double closest_float(const void* scene, const float* const* columns,
                                                    std::size_t count, float* const* hits,
                                                    std::int32_t* object)
{
    return seconds_of<float>(scene, columns, count, hits, object);
}

[[gnu::visibility("default")]] double closest_double(const void* scene,
                                                     const double* const* columns,
                                                     std::size_t count, double* const* hits,
                                                     std::int32_t* object)
{
    return seconds_of<double>(scene, columns, count, hits, object);
}

[[gnu::visibility("default")]] double vectors_float(const void* scene, const float* origins,
                                                    const float* directions, std::size_t count,
                                                    float* const* hits, std::int32_t* object)
{
    return seconds_of_vectors<float>(scene, origins, directions, count, hits, object);
}

[[gnu::visibility("default")]] double vectors_double(const void* scene, const double* origins,
                                                     const double* directions, std::size_t count,
                                                     double* const* hits, std::int32_t* object)
{
    return seconds_of_vectors<double>(scene, origins, directions, count, hits, object);
}
}
