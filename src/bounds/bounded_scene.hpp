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

/// The surfaces of a scene, to prove bounds of their hits.
class BoundedScene {
public:
    explicit BoundedScene(const Scene& scene);

    [[nodiscard]] std::size_t object_count() const
    {
        return index_.size();
    }

    /// Whether an object's surface and transform are those of `now`.
    [[nodiscard]] bool holds(std::int32_t object, const Object& now) const;

    /// Replaces the surfaces and transforms of some objects, each named once.
    void replace(const Scene& scene, std::span<const MovedShape> moved);

    /// Bounds of the first hit of a line with an object.
    [[nodiscard]] HitBounds first_hit(std::int32_t object, const Line& line,
                                      const Range& range) const;

    /// Bounds of several hits with an object. `t` holds their values in rising order.
    void all_hits(std::int32_t object, const Line& line, const Range& range,
                  std::span<const double> t, std::span<HitBounds> bounds) const;

private:
    /// An object that is no unplaced sphere. Unplaced spheres, of which most large scenes consist,
    /// take less memory in `spheres_`.
    struct Placed {
        Surface surface;
        Mat4 transform;
    };

    /// False where the object needs an entry in the other list.
    bool replace_in_place(const Scene& scene, const MovedShape& shape);
    [[nodiscard]] std::vector<HitInterval> hits_of(std::int32_t object, const Line& line) const;

    std::vector<std::int32_t> index_;  ///< in `spheres_`; ~index in `placed_`
    std::vector<Sphere> spheres_;
    std::vector<Placed> placed_;
};

}  // namespace packtrace::bounds
