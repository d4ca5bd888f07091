#include "bindings.hpp"
#include "hit_arrays.hpp"
#include "options.hpp"
#include "pictures.hpp"
#include "ray_blocks.hpp"
#include "ray_columns.hpp"
#include "render/ray_pieces.hpp"
#include "scene.hpp"
#include "two_ray_scenes.hpp"

#include <pybind11/stl.h>
#include <tbb/enumerable_thread_specific.h>

#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace packtrace::python {
namespace {

void check_count(const std::string& name, py::ssize_t count, std::size_t rays)
{
    if (static_cast<std::size_t>(count) != rays)
        throw py::value_error("there are " + std::to_string(count) + " " + name + " and " +
                              std::to_string(rays) + " rays; give one for each ray");
}

/// Columns of rays, and the threads' buffers for gathered columns.
template <class Real, std::size_t columns>
struct GatheredBlocks {
    ColumnBlocks<Real, columns> blocks;
    tbb::enumerable_thread_specific<std::vector<Real>> buffers = {};

    [[nodiscard]] std::array<const Real*, columns> at(std::size_t first, std::size_t count)
    {
        return blocks.block(first, count, buffers.local());
    }
};

using Numbers = py::array_t<std::int32_t, py::array::c_style>;
using Doubles = py::array_t<double, py::array::c_style>;

class NativeRayScene {
public:
    NativeRayScene(Scene scene, const RenderOptions& options)
        : scenes_(std::move(scene), options), is_scalar_(options.kernel == Kernel::scalar)
    {
    }

    void prepare(const py::dtype& dtype)
    {
        with_real(dtype, [&](auto real) { static_cast<void>(ready<decltype(real)>()); });
    }

    void closest(const RayArrays& rays, const OptionalArray& start_point,
                 const std::optional<Numbers>& start_surface, HitArrays& hits)
    {
        with_real(rays.origins.dtype(), [&](auto real) {
            using Real = decltype(real);
            if (start_point)
                closest_from<Real>(rays, *start_point, *start_surface, hits.view<Real>());
            else
                closest_of<Real>(rays, hits.view<Real>());
        });
    }

    void occluded(const RayArrays& rays, py::array mask)
    {
        auto* const to = static_cast<std::uint8_t*>(mask.mutable_data());
        with_real(rays.origins.dtype(), [&](auto real) {
            using Real = decltype(real);
            const HeldScene<Real> scene = ready<Real>();
            for_rays<Real>(rays, [&](const RaysView<Real>& view, std::size_t first) {
                scene->occluded(view, to + first);
            });
        });
    }

    void lit(const py::array& points, const std::optional<Numbers>& surface, std::size_t light,
             py::array mask)
    {
        auto* const to = static_cast<std::uint8_t*>(mask.mutable_data());
        const std::int32_t* const number = surface ? surface->data() : nullptr;
        with_real(points.dtype(), [&](auto real) {
            using Real = decltype(real);
            const HeldScene<Real> scene = ready<Real>();
            scene->lit({}, light, to);  // rejects a wrong light, even if there are no points
            GatheredBlocks<Real, 3> places{ColumnBlocks<Real, 3>(
                {column_of(points, 0), column_of(points, 1), column_of(points, 2)})};
            for_each_piece(static_cast<std::size_t>(points.shape(0)), places.blocks.block_size(),
                           usual_speed(), scenes_.threads(),
                           [&](std::size_t first, std::size_t count) {
                               const auto at = places.at(first, count);
                               scene->lit({{at[0], at[1], at[2]}, part_of(number, first), count},
                                          light, to + first);
                           });
        });
    }

    py::tuple all_hits(const RayArrays& rays)
    {
        return with_real(rays.origins.dtype(),
                         [&](auto real) { return all_hits_of<decltype(real)>(rays); });
    }

    void bounds(const RayArrays& rays, const Numbers& objects, py::array to)
    {
        static_assert(sizeof(HitBounds) == 2 * sizeof(double));
        check_objects(objects, -1, "object");
        auto* const found = static_cast<HitBounds*>(to.mutable_data());
        const std::int32_t* const object = objects.data();
        with_real(rays.origins.dtype(), [&](auto real) {
            using Real = decltype(real);
            const HeldScene<Real> scene = ready<Real>();
            for_rays<Real>(
                rays,
                [&](const RaysView<Real>& view, std::size_t first) {
                    scene->bound_closest_hits(view, object + first, found + first);
                },
                Speed::slow);
        });
    }

    py::tuple update(py::handle scene)
    {
        Scene native = scene_of(scene);
        SceneUpdate done;
        {
            const py::gil_scoped_release release;
            done = scenes_.update(std::move(native));
        }
        return py::make_tuple(done.rebuilt, done.cost);
    }

    /// `transforms` is (n, 4, 4), rows first.
    py::tuple transform(const Numbers& objects, const Doubles& transforms)
    {
        check_objects(objects, 0, "objects");
        std::vector<Mat4> matrices(static_cast<std::size_t>(objects.size()));
        for (std::size_t i = 0; i < matrices.size(); ++i)
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 4; ++column)
                    matrices[i][column][row] =
                        transforms.at(static_cast<py::ssize_t>(i), row, column);
        SceneUpdate done;
        {
            const py::gil_scoped_release release;
            done = scenes_.transform({objects.data(), matrices.size()}, matrices);
        }
        return py::make_tuple(done.rebuilt, done.cost);
    }

private:
    /// Holds the lock, so that no object moves.
    template <class Real>
    struct HeldScene {
        std::shared_lock<std::shared_mutex> lock;
        const RayScene<Real>* scene;

        const RayScene<Real>* operator->() const
        {
            return scene;
        }
    };

    template <class Real>
    [[nodiscard]] HeldScene<Real> ready()
    {
        const py::gil_scoped_release release;
        auto lock = scenes_.hold();
        return {std::move(lock), &scenes_.of<Real>()};
    }

    /// The scalar kernel tests each ray with all objects.
    [[nodiscard]] Speed usual_speed() const
    {
        return is_scalar_ ? Speed::slow : Speed::fast;
    }

    /// Calls `work(view, first)` for pieces of rays.
    template <class Real, class Work>
    void for_rays(const RayArrays& rays, const Work& work)
    {
        for_rays<Real>(rays, work, usual_speed());
    }

    template <class Real, class Work>
    void for_rays(const RayArrays& rays, const Work& work, Speed speed)
    {
        GatheredBlocks<Real, 8> gathered{ColumnBlocks<Real, 8>(rays.columns())};
        for_each_piece(rays.count(), gathered.blocks.block_size(), speed, scenes_.threads(),
                       [&](std::size_t first, std::size_t count) {
                           work(rays_view(gathered.at(first, count), count), first);
                       });
    }

    template <class Real>
    void finish(const RaysView<Real>& rays, const HitsView<Real>& hits) const
    {
        if (is_scalar_)
            complete_scalar(rays, hits);
    }

    template <class Real>
    void closest_of(const RayArrays& rays, const HitsView<Real>& hits)
    {
        const HeldScene<Real> scene = ready<Real>();
        for_rays<Real>(rays, [&](const RaysView<Real>& view, std::size_t first) {
            const HitsView<Real> block = part_of(hits, first);
            scene->closest_hits(view, block);
            finish(view, block);
        });
    }

    /// The closest hits of rays that leave earlier hits.
    template <class Real>
    void closest_from(const RayArrays& rays, const py::array& point, const Numbers& surface,
                      const HitsView<Real>& hits)
    {
        check_count("points of starts", point.shape(0), rays.count());
        check_count("surfaces of starts", surface.size(), rays.count());
        const HeldScene<Real> scene = ready<Real>();
        GatheredBlocks<Real, 3> points{
            ColumnBlocks<Real, 3>({column_of(point, 0), column_of(point, 1), column_of(point, 2)})};
        const std::int32_t* const numbers = surface.data();
        GatheredBlocks<Real, 8> gathered{ColumnBlocks<Real, 8>(rays.columns())};
        const std::size_t block =
            std::min(points.blocks.block_size(), gathered.blocks.block_size());
        for_each_piece(rays.count(), block, usual_speed(), scenes_.threads(),
                       [&](std::size_t first, std::size_t count) {
                           const auto at = points.at(first, count);
                           const StartsView<Real> starts{{at[0], at[1], at[2]}, numbers + first};
                           const RaysView<Real> view = rays_view(gathered.at(first, count), count);
                           const HitsView<Real> found = part_of(hits, first);
                           scene->closest_hits(view, starts, found);
                           finish(view, found);
                       });
    }

    template <class Real>
    py::tuple all_hits_of(const RayArrays& rays)
    {
        const HeldScene<Real> scene = ready<Real>();
        const std::size_t count = rays.count();
        py::array_t<std::int64_t> offsets(static_cast<py::ssize_t>(count + 1));
        std::int64_t* const offset = offsets.mutable_data();
        offset[0] = 0;
        // One element per piece, whose first ray is a multiple of `longest`.
        const std::size_t longest = longest_piece(usual_speed());
        std::vector<std::vector<SurfaceHit<Real>>> found(count / longest + 1);
        for_rays<Real>(rays, [&](const RaysView<Real>& view, std::size_t first) {
            auto& hits = found[first / longest];
            scene->all_hits(view, [&](std::size_t ray, std::span<const SurfaceHit<Real>> of_ray) {
                hits.insert(hits.end(), of_ray.begin(), of_ray.end());
                offset[first + ray + 1] = static_cast<std::int64_t>(of_ray.size());
            });
        });
        std::partial_sum(offset, offset + count + 1, offset);
        return joined(found, std::move(offsets));
    }

    /// Throws if an index is below `least` or no object has it. `name` is the name of the array.
    void check_objects(const Numbers& objects, std::int32_t least, const std::string& name) const
    {
        const auto count = static_cast<std::int64_t>(scenes_.object_count());
        for (py::ssize_t i = 0; i < objects.size(); ++i)
            if (objects.data()[i] < least || objects.data()[i] >= count)
                throw py::value_error(name + "[" + std::to_string(i) + "] is " +
                                      std::to_string(objects.data()[i]) + "; use " +
                                      std::to_string(least) + " to " + std::to_string(count - 1));
    }

    TwoRayScenes scenes_;
    bool is_scalar_;
};

}  // namespace

void bind_rays(py::module_& module)
{
    using Native = NativeRayScene;
    using Array = const py::array&;
    py::class_<Native>(module, "RayScene")
        .def(py::init([](py::handle scene, const py::kwargs& arguments) {
            const RenderOptions options = kernel_options(arguments);
            Scene native = scene_of(scene);
            const py::gil_scoped_release release;
            return std::make_unique<Native>(std::move(native), options);
        }))
        .def("prepare", &Native::prepare)
        .def("update", &Native::update)
        .def("transform", &Native::transform)
        .def(
            "closest",
            [](Native& self, Array origins, Array directions, Array t_min, Array t_max,
               const OptionalArray& start_point, const std::optional<Numbers>& start_surface,
               Array t, Array object, const OptionalArray& normal, const OptionalArray& point,
               const OptionalArray& outer_start, const OptionalArray& inner_start,
               const OptionalArray& surface) {
                HitArrays hits{t, object, normal, point, outer_start, inner_start, surface};
                self.closest({origins, directions, t_min, t_max}, start_point, start_surface, hits);
            })
        .def("occluded",
             [](Native& self, Array origins, Array directions, Array t_min, Array t_max,
                Array mask) {
                 self.occluded({origins, directions, t_min, t_max}, mask);
             })
        .def("lit", [](Native& self, Array points, const std::optional<Numbers>& surface,
                       std::size_t light, Array mask) { self.lit(points, surface, light, mask); })
        .def("all_hits",
             [](Native& self, Array origins, Array directions, Array t_min, Array t_max) {
                 return self.all_hits({origins, directions, t_min, t_max});
             })
        .def("bounds", [](Native& self, Array origins, Array directions, Array t_min, Array t_max,
                          const Numbers& objects, Array to) {
            self.bounds({origins, directions, t_min, t_max}, objects, to);
        });
}

}  // namespace packtrace::python
