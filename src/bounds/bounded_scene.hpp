#pragma once

#include "bounds/line_hits.hpp"
#include "scene/moved_shape.hpp"
#include <packtrace/intersect.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace packtrace::bounds {

/// The part of a line where hits count: t_min < t < t_max.
struct Range {
    double t_min = 0.0;
    double t_max = 0.0;
};

/// The surfaces of a scene, for bounds of hits with them.
class BoundedScene {
public:
    explicit BoundedScene(const Scene& scene);

    [[nodiscard]] std::size_t object_count() const
    {
        return index_.size();
    }

    /// Whether an object's surface and place are those of `now`.
    [[nodiscard]] bool holds(std::int32_t object, const Object& now) const;

    /// Takes over the surfaces and places of some objects, each named once.
    void replace(const Scene& scene, std::span<const MovedShape> moved);

    /// Bounds of the first hit of a line with an object.
    [[nodiscard]] HitBounds first_hit(std::int32_t object, const Line& line,
                                      const Range& range) const;

    /// Bounds of several hits with an object, whose t are given in rising order.
    void all_hits(std::int32_t object, const Line& line, const Range& range,
                  std::span<const double> t, std::span<HitBounds> bounds) const;

private:
    /// Most objects of large scenes are unplaced spheres, which take little room.
    struct Placed {
        Surface surface;
        Mat4 transform;
    };

    /// False where the object needs another entry than it has.
    bool replace_in_place(const Scene& scene, const MovedShape& shape);
    [[nodiscard]] std::vector<HitInterval> hits_of(std::int32_t object, const Line& line) const;

    std::vector<std::int32_t> index_;  ///< in `spheres_`, or the complement of one in `placed_`
    std::vector<Sphere> spheres_;
    std::vector<Placed> placed_;
};

}  // namespace packtrace::bounds
