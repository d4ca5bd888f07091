#include "lab/soak/soak.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/write_scene.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>

namespace packtrace::lab {
namespace {

/// At most this many changed scenes are tried, because a slow scene could take hours.
constexpr int most_tries = 3000;

/// Makes a scene smaller, change by change, and keeps the changes with which the finding still
/// shows.
class Shrinker {
public:
    Shrinker(SoakFinding& finding, Scene scene) : finding_(finding), scene_(std::move(scene))
    {
    }

    /// Tries all changes until none is kept.
    Scene run()
    {
        for (bool changed = true; changed && tries_ < most_tries;) {
            changed = remove_some(&Scene::objects, 1);
            changed |= remove_some(&Scene::lights, 0);
            changed |= simplify_whole();
            for (std::size_t i = 0; i < scene_.objects.size(); ++i)
                changed |= simplify_object(i);
            changed |= round_numbers();
        }
        return scene_;
    }

private:
    /// Whether the finding shows in a changed scene, which then is kept.
    bool keep(const Scene& changed)
    {
        if (tries_++ >= most_tries)
            return false;
        try {
            Scene scene = as_read(changed);
            std::string what = finding_.again(scene);
            if (what.empty())
                return false;
            finding_.what = std::move(what);
            scene_ = std::move(scene);
            return true;
        } catch (const std::exception&) {
            return false;
        }
    }

    /// Tries a change on a copy; `change` returns false if it changed nothing.
    template <class Change>
    bool attempt(const Change& change)
    {
        Scene changed = scene_;
        return change(changed) && keep(changed);
    }

    /// Removes runs of things, ever shorter ones; at least `least` things stay.
    template <class Things>
    bool remove_some(std::vector<Things> Scene::*list, std::size_t least)
    {
        bool removed = false;
        for (std::size_t run = (scene_.*list).size(); run > 0; run /= 2)
            for (std::size_t begin = 0; begin < (scene_.*list).size();) {
                const std::size_t end = std::min(begin + run, (scene_.*list).size());
                const bool possible = (scene_.*list).size() - (end - begin) >= least;
                const bool done =
                    possible && attempt([&](Scene& scene) {
                        auto& things = scene.*list;
                        things.erase(things.begin() + static_cast<std::ptrdiff_t>(begin),
                                     things.begin() + static_cast<std::ptrdiff_t>(end));
                        return true;
                    });
                removed |= done;
                begin = done ? begin : end;
            }
        return removed;
    }

    template <class Value>
    static bool put(Value& to, const Value& value)
    {
        const bool other = !(to == value);
        to = value;
        return other;
    }

    bool simplify_whole()
    {
        bool changed = false;
        changed |= attempt([](Scene& s) { return put(s.width, (s.width + 1) / 2); });
        changed |= attempt([](Scene& s) { return put(s.height, (s.height + 1) / 2); });
        changed |= attempt([](Scene& s) { return put(s.max_depth, 0); });
        changed |= attempt([](Scene& s) { return put(s.max_depth, std::max(0, s.max_depth - 1)); });
        changed |= attempt([](Scene& s) { return put(s.min_weight, 0.0); });
        changed |= attempt([](Scene& s) { return put(s.shadows, ShadowKind::none); });
        changed |= attempt([](Scene& s) { return put(s.shadows, ShadowKind::opaque); });
        changed |= attempt([](Scene& s) { return put(s.background, Rgb(0.0)); });
        changed |= attempt([](Scene& s) { return put(s.camera.pixel_sample, Vec2(0.5)); });
        changed |= attempt([](Scene& s) { return put(s.camera.rotation, Mat3(1.0)); });
        changed |= attempt([](Scene& s) { return put(s.camera.position, Vec3(0.0)); });
        return changed;
    }

    bool simplify_object(std::size_t i)
    {
        bool changed = false;
        changed |= attempt([&](Scene& s) { return put(s.objects[i].transform, Mat4(1.0)); });
        changed |= attempt([&](Scene& s) { return put(s.objects[i].casts_shadow, true); });
        changed |= attempt([&](Scene& s) {
            const bool had = s.objects[i].material.checker.has_value();
            s.objects[i].material.checker.reset();
            return had;
        });
        changed |= attempt([&](Scene& s) { return make_plain(s.objects[i].material); });
        changed |= attempt([&](Scene& s) {
            auto* const quadric = std::get_if<Quadric>(&s.objects[i].surface);
            return quadric != nullptr && put(quadric->capped, false);
        });
        changed |= attempt([&](Scene& s) {
            auto* const quadric = std::get_if<Quadric>(&s.objects[i].surface);
            const bool had = quadric != nullptr && quadric->z_range && !quadric->capped;
            if (had)
                quadric->z_range.reset();
            return had;
        });
        changed |= attempt([&](Scene& s) {
            auto* const polygon = std::get_if<Polygon>(&s.objects[i].surface);
            const bool had = polygon != nullptr && polygon->contours.size() > 1;
            if (had)
                polygon->contours.resize(1);
            return had;
        });
        return changed;
    }

    /// Makes it white, with the defaults of its model.
    static bool make_plain(Material& material)
    {
        const bool colored = put(material.color, Rgb(1.0));
        return std::visit(
            [&](auto& model) {
                const auto before = model;
                model = {};
                return colored || !same_bytes(before, model);
            },
            material.model);
    }

    template <class Model>
    static bool same_bytes(const Model& a, const Model& b)
    {
        const auto* const x = reinterpret_cast<const unsigned char*>(&a);
        const auto* const y = reinterpret_cast<const unsigned char*>(&b);
        return std::equal(x, x + sizeof a, y);
    }

    /// Rounds to three digits.
    static bool round_number(double& number)
    {
        char text[32];
        const auto end =
            std::to_chars(text, text + sizeof text, number, std::chars_format::scientific, 2).ptr;
        double rounded = number;
        std::from_chars(text, end, rounded);
        return put(number, rounded);
    }

    static bool round_vector(Vec3& v)
    {
        const bool x = round_number(v.x);
        const bool y = round_number(v.y);
        const bool z = round_number(v.z);
        return x || y || z;
    }

    bool round_numbers()
    {
        bool changed = attempt([](Scene& s) { return round_vector(s.camera.position); });
        changed |= attempt([](Scene& s) { return s.camera.fov && round_number(*s.camera.fov); });
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            changed |= attempt([&](Scene& s) { return round_vector(s.lights[i].vector); });
            changed |= attempt([&](Scene& s) { return put(s.lights[i].intensity, Rgb(1.0)); });
        }
        for (std::size_t i = 0; i < scene_.objects.size(); ++i)
            changed |= attempt([&](Scene& s) { return round_object(s.objects[i]); });
        return changed;
    }

    static bool round_object(Object& object)
    {
        bool changed = false;
        if (auto* const sphere = std::get_if<Sphere>(&object.surface)) {
            changed = round_vector(sphere->center);
            changed |= round_number(sphere->radius);
        }
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                changed |= round_number(object.transform[column][row]);
        return changed;
    }

    SoakFinding& finding_;
    Scene scene_;
    int tries_ = 0;
};

}  // namespace

Scene as_read(const Scene& scene)
{
    return parse_scene(scene_text(scene), "soak", {});
}

Scene shrink(SoakFinding& finding, Scene scene)
{
    return Shrinker(finding, std::move(scene)).run();
}

}  // namespace packtrace::lab
