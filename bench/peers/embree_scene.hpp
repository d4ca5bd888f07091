#pragma once

#include "user_sphere.hpp"
#include <packtrace/scene.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace packtrace::peers {

/// How Embree is told of the spheres.
enum class Geometry { sphere, user };
[[nodiscard]] const char* name_of(Geometry geometry);

/// The spheres of a scene as Embree takes them. Throws std::runtime_error for other objects.
[[nodiscard]] std::vector<SphereRecord> sphere_records(const Scene& scene);

/// A committed scene of Embree's and how it was built. `spheres` must outlive it.
class EmbreeScene {
public:
    /// Threads of the build; 0 for all. Throws std::runtime_error when Embree refuses.
    EmbreeScene(const std::vector<SphereRecord>& spheres, Geometry geometry, int threads = 0);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    [[nodiscard]] RTCScene get() const
    {
        return scene_;
    }
    [[nodiscard]] double build_seconds() const
    {
        return build_seconds_;
    }
    /// What Embree's own account of memory rose to, and holds now; its copy of spheres included.
    [[nodiscard]] std::ptrdiff_t peak_bytes() const;
    [[nodiscard]] std::ptrdiff_t bytes() const;

private:
    struct Memory;
    void attach(const std::vector<SphereRecord>& spheres, Geometry geometry);

    std::unique_ptr<Memory> memory_;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    double build_seconds_ = 0.0;
};

}  // namespace packtrace::peers
