// leaks WORK: repeats some work of the library, each time with another failing allocation. Exits
// with 1 if memory is lost or if no allocation ever fails.
#include "fail_malloc.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/intersect.hpp>
#include <packtrace/read_scene.hpp>
#include <packtrace/render.hpp>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace {

using namespace packtrace;

const char* const kinds = R"(
    sphere { center = (0, 2, 6)  radius = 1  reflective = 0.3 }
    plane { point = (0, -1, 0)  normal = (0, 1, 0)  reflective = 0.2 }
    ellipsoid { scale = (1, 0.5, 2)  translate = (2, 0, 7)  casts_shadow = false }
    polygon { vertices = (-3, 0, 8), (-1, 0, 8), (-1, 2, 8), (-3, 2, 8) }
    light { type = point  position = (0, 9, -4)  intensity = 0.6 }
    light { type = directional  direction = (1, 4, -2)  intensity = 0.2 }
)";

RenderOptions one_thread(Traversal traversal)
{
    return {.traversal = traversal, .threads = 1};
}

Scene spheres()
{
    return generate_random_spheres({.count = 300, .radius = 0.02, .reflective = 0.3});
}

void picture()
{
    Scene scene = parse_scene(kinds, "kinds", {});
    scene.width = 24;
    scene.height = 18;
    (void)render<float>(scene, one_thread(Traversal::list));
    (void)render<double>(scene, one_thread(Traversal::list));
}

void tree()
{
    Scene scene = spheres();
    scene.width = 24;
    scene.height = 18;
    (void)render<float>(scene, one_thread(Traversal::tree));
}

/// Arrays of rays through a grid of points at z = 5.
struct Rays {
    std::vector<float> zero, across, ahead, end;

    explicit Rays(std::size_t count)
        : zero(count), across(count), ahead(count, 5.0f), end(count, 1e9f)
    {
        for (std::size_t i = 0; i < count; ++i)
            across[i] = static_cast<float>(i) / static_cast<float>(count) - 0.5f;
    }
    [[nodiscard]] RaysView<float> view() const
    {
        return {zero.data(),  zero.data(), zero.data(), across.data(), across.data(),
                ahead.data(), zero.data(), end.data(),  zero.size()};
    }
};

void queries()
{
    const RayScene<float> scene(parse_scene(kinds, "kinds", {}), one_thread(Traversal::list));
    const Rays rays(200);
    std::vector<float> t(rays.zero.size());
    std::vector<std::int32_t> object(t.size());
    std::vector<std::uint8_t> mask(t.size());
    std::vector<HitBounds> bounds(t.size());
    HitsView<float> hits;
    hits.t = t.data();
    hits.object = object.data();
    scene.closest_hits(rays.view(), hits);
    scene.occluded(rays.view(), mask.data());
    scene.bound_closest_hits(rays.view(), object.data(), bounds.data());
    scene.all_hits(rays.view(), [](std::size_t, auto) {});
}

void lights()
{
    const RayScene<float> scene(spheres(), one_thread(Traversal::tree));
    const Rays rays(3000);
    std::vector<std::uint8_t> mask(rays.zero.size());
    for (int call = 0; call < 3; ++call)
        scene.lit({{rays.across.data(), rays.zero.data(), rays.ahead.data()}, nullptr, mask.size()},
                  1, mask.data());
}

void update()
{
    Scene moved = spheres();
    RayScene<float> scene(moved, one_thread(Traversal::tree));
    for (int step = 1; step < 4; ++step) {
        for (Object& object : moved.objects)
            object.transform[3].x += 0.01 * step;
        (void)scene.update(moved);
    }
}

using Work = void (*)();

Work work_named(const char* name)
{
    struct Named {
        const char* name;
        Work work;
    };
    for (const Named& named :
         {Named{"picture", picture}, Named{"tree", tree}, Named{"queries", queries},
          Named{"lights", lights}, Named{"update", update}})
        if (std::strcmp(name, named.name) == 0)
            return named.work;
    return nullptr;
}

/// The number of live blocks after complete work: caches for later calls, and all blocks that were
/// lost.
long live_after(Work work)
{
    work();
    work();
    return live_blocks();
}

/// Whether the work ended because memory ran out.
bool runs_out(Work work, long allocation)
{
    fail_malloc_at(allocation);
    try {
        work();
    } catch (const std::bad_alloc&) {
        fail_malloc_at(0);
        return true;
    }
    return false;
}

}  // namespace

int main(int count, char** words)
{
    const Work work = count == 2 ? work_named(words[1]) : nullptr;
    if (work == nullptr)
        return 2;
    long live = live_after(work);
    long lost = 0;
    long ended = 0;
    long allocation = 1;
    for (;; ++allocation) {
        const long before = live_blocks();
        ended += runs_out(work, allocation) ? 1 : 0;
        if (!fail_malloc_at(0))
            break;
        if (live_blocks() == before)
            continue;
        const long now = live_after(work);
        if (now > live) {
            std::printf("allocation %ld: %ld blocks lost\n", allocation, now - live);
            lost += now - live;
        }
        live = now;
    }
    std::printf("%ld allocations failed, %ld of them ended the work, %ld blocks lost\n",
                allocation - 1, ended, lost);
    return lost == 0 && ended > 0 ? 0 : 1;
}
