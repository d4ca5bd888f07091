// Rays by the C++ library, on arrays that rays.py has: what the race calls through ctypes. Times
// are taken here, so that calling costs nothing.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>

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

template <class Real>
void* new_scene(const char* text)
{
    return std::make_unique<RayScene<Real>>(packtrace::parse_scene(text, "race")).release();
}

}  // namespace

extern "C" {

// Eight columns of rays; t, and normals or null, of hits.
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
}
