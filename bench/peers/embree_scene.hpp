#pragma once

#include "user_sphere.hpp"
#include <packtrace/scene.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace packtrace::peers {

/// How Embree gets the spheres: as its own primitives, or as user geometry with callbacks.
enum class Geometry { sphere, user };
[[nodiscard]] const char* name_of(Geometry geometry);

/// The spheres of a scene as records for Embree. Throws std::runtime_error for other objects.
[[nodiscard]] std::vector<SphereRecord> sphere_records(const Scene& scene);

/// A committed scene of Embree, with the time and memory of its build. `spheres` must outlive it.
class EmbreeScene {
public:
    /// Builds on `threads` threads; 0 for all. Throws std::runtime_error if Embree fails.
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
    /// Embree's largest and present memory by its own account, with its copy of spheres.
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
