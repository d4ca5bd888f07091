#include "embree_scene.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace packtrace::peers {

struct EmbreeScene::Memory {
    std::atomic<std::ptrdiff_t> now{0};
    std::atomic<std::ptrdiff_t> peak{0};

    void add(std::ptrdiff_t bytes)
    {
        const std::ptrdiff_t sum = now += bytes;
        std::ptrdiff_t highest = peak;
        while (sum > highest && !peak.compare_exchange_weak(highest, sum)) {
        }
    }
};

namespace {

void bounds_of_sphere(const RTCBoundsFunctionArguments* args)
{
    const auto& sphere = static_cast<const SphereRecord*>(args->geometryUserPtr)[args->primID];
    // The float sum may round inwards.
    const auto low = [&](int axis) {
        return std::nextafter(sphere.center[axis] - sphere.radius,
                              -std::numeric_limits<float>::infinity());
    };
    const auto high = [&](int axis) {
        return std::nextafter(sphere.center[axis] + sphere.radius,
                              std::numeric_limits<float>::infinity());
    };
    *args->bounds_o = {low(0), low(1), low(2), 0.0F, high(0), high(1), high(2), 0.0F};
}

RTCGeometry sphere_geometry(RTCDevice device, const std::vector<SphereRecord>& spheres)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    void* buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                           sizeof(SphereRecord), spheres.size());
    std::copy(spheres.begin(), spheres.end(), static_cast<SphereRecord*>(buffer));
    return geometry;
}

RTCGeometry user_geometry(RTCDevice device, const std::vector<SphereRecord>& spheres)
{
    const UserSphere callbacks =
        __builtin_cpu_supports("avx512vl") ? user_sphere_avx512() : user_sphere_avx2();
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(spheres.size()));
    rtcSetGeometryUserData(geometry, const_cast<SphereRecord*>(spheres.data()));
    rtcSetGeometryBoundsFunction(
        geometry, [](const RTCBoundsFunctionArguments* args) { bounds_of_sphere(args); }, nullptr);
    rtcSetGeometryIntersectFunction(geometry, callbacks.intersect);
    rtcSetGeometryOccludedFunction(geometry, callbacks.occluded);
    return geometry;
}

}  // namespace

const char* name_of(Geometry geometry)
{
    return geometry == Geometry::sphere ? "sphere" : "user";
}

std::vector<SphereRecord> sphere_records(const Scene& scene)
{
    std::vector<SphereRecord> records;
    for (const Object& object : scene.objects) {
        const auto* sphere = std::get_if<Sphere>(&object.surface);
        if (sphere == nullptr || object.transform != Mat4(1.0))
            throw std::runtime_error(object.name + " is no plain sphere, which Embree is raced on");
        records.push_back(
            {{static_cast<float>(sphere->center.x), static_cast<float>(sphere->center.y),
              static_cast<float>(sphere->center.z)},
             static_cast<float>(sphere->radius)});
    }
    return records;
}

EmbreeScene::EmbreeScene(const std::vector<SphereRecord>& spheres, Geometry geometry, int threads)
    : memory_(std::make_unique<Memory>())
{
    device_ = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
    if (device_ == nullptr)
        throw std::runtime_error("Embree has no device here");
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* memory, ssize_t bytes, bool) {
            static_cast<Memory*>(memory)->add(bytes);
            return true;
        },
        memory_.get());
    attach(spheres, geometry);
}

void EmbreeScene::attach(const std::vector<SphereRecord>& spheres, Geometry geometry)
{
    scene_ = rtcNewScene(device_);
    const auto start = std::chrono::steady_clock::now();
    RTCGeometry made = geometry == Geometry::sphere ? sphere_geometry(device_, spheres)
                                                    : user_geometry(device_, spheres);
    rtcCommitGeometry(made);
    rtcAttachGeometry(scene_, made);
    rtcReleaseGeometry(made);
    rtcCommitScene(scene_);
    build_seconds_ =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
        throw std::runtime_error("Embree can't build the scene");
}

EmbreeScene::~EmbreeScene()
{
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::ptrdiff_t EmbreeScene::peak_bytes() const
{
    return memory_->peak;
}

std::ptrdiff_t EmbreeScene::bytes() const
{
    return memory_->now;
}

}  // namespace packtrace::peers
