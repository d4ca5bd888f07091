// Paths that are traced in registers bring what those in streams bring, bit for bit.
#include <cstdlib>
#include <cstring>

#include <packtrace/build.hpp>

#include "catch.hpp"
#include "dispatch/kernels.hpp"
#include "lower/leave_out.hpp"
#include "lower/packed_scene.hpp"
#include "render/tile_renderer.hpp"
#include "render_scene.hpp"
#include "scenes.hpp"
#include "scene_files.hpp"

namespace packtrace::test {
namespace {

/// Scenes of a few spheres, grounds and planes, with whatever may upset a bound: bodies that overlap
/// or touch, eyes and lights within them, sizes and distances of many magnitudes.
class FewObjects {
public:
    explicit FewObjects(unsigned seed) : random_(seed)
    {
        const Illumination kinds[] = {Illumination::scratch, Illumination::general,
                                      Illumination::whitted};
        scene = make_scene(kinds[below(3)]);
        set_size(scene, 9 + below(40), 5 + below(30));
        scene.max_depth = below(6);
        scene.background = random_.inside(Vec3(0.0), Vec3(0.5));
        add_objects();
        add_lights();
        add_camera();
    }

    Scene scene;

private:
    int below(int count)
    {
        return static_cast<int>(random_.between(0.0, count));
    }
    bool chance(double share)
    {
        return random_.between(0.0, 1.0) < share;
    }
    Vec3 vector(double size)
    {
        return random_.inside(Vec3(-size), Vec3(size));
    }
    /// From 10^-most to 10^most.
    double magnitude(double most)
    {
        return std::pow(10.0, random_.between(-most, most));
    }

    Material material()
    {
        Material any = make_material(scene.illumination);
        any.color = random_.inside(Vec3(0.0), Vec3(1.0));
        const double mirror = chance(0.7) ? random_.between(0.1, 0.9) : 0.0;
        if (auto* scratch = std::get_if<ScratchMaterial>(&any.model)) {
            scratch->specular = chance(0.7) ? random_.between(1, 1000) : -1.0;
            scratch->reflective = mirror;
        } else if (auto* whitted = std::get_if<WhittedMaterial>(&any.model)) {
            whitted->ambient = Rgb(0.5);
            whitted->diffuse = Rgb(0.6);
            whitted->specular = Rgb(mirror);
            whitted->shininess = random_.between(1, 200);
        } else if (auto* general = std::get_if<GeneralMaterial>(&any.model)) {
            general->ambient = 0.5 * any.color;
            general->diffuse = any.color;
            any.color = Rgb(1.0);
            general->reflect = chance(0.5) ? Rgb(mirror) : mirror * random_.inside(Vec3(0.0), Vec3(1.0));
            general->highlight = Rgb(chance(0.5) ? 0.5 : 0.0);
            general->shininess = random_.between(1, 200);
        }
        return any;
    }

    void add(Surface surface)
    {
        Object object = make_object(std::move(surface), material());
        if (std::holds_alternative<Plane>(object.surface) && chance(0.4) &&
            scene.illumination != Illumination::general)
            object.material.checker = Checker{random_.inside(Vec3(0.0), Vec3(1.0)),
                                              random_.between(0.1, 2)};
        object.casts_shadow = !chance(0.1);
        scene.objects.push_back(std::move(object));
    }

    void add_objects()
    {
        const double spread = chance(0.2) ? magnitude(4) : 1.0;
        const Vec3 middle = chance(0.15) ? vector(1e4) : Vec3(0, 0, 6);
        middle_ = middle;
        for (int i = below(9); i > 0; --i)
            add(sphere(middle + vector(3.0 * spread),
                       spread * (chance(0.2) ? magnitude(3) : random_.between(0.1, 2))));
        for (int i = chance(0.6) ? 1 + below(2) : 0; i > 0; --i) {
            const double radius = std::pow(10.0, random_.between(2, 7));
            const Vec3 up = glm::normalize(vector(0.5) + Vec3(0, 1, 0));
            add(sphere(middle - (radius + random_.between(0.0, 2.0)) * up, radius));
        }
        for (int i = chance(0.4) ? 1 + below(6) : 0; i > 0; --i)
            add(plane(middle + vector(4.0), vector(1.0) + Vec3(0.01)));
        // Contacts: spheres that touch the first one to the last digit, and the same place twice.
        if (!scene.objects.empty() && chance(0.4)) {
            const auto* first = std::get_if<Sphere>(&scene.objects.front().surface);
            if (first != nullptr)
                add(sphere(first->center + Vec3(0, 2 * first->radius, 0), first->radius));
        }
        if (scene.objects.empty() || chance(0.1))
            add(sphere(middle, 1.0));
    }

    void add_lights()
    {
        if (chance(0.8))
            scene.lights.push_back(ambient_light(Rgb(0.2)));
        for (int i = below(4); i > 0; --i) {
            const Rgb intensity = random_.inside(Vec3(0.0), Vec3(0.6));
            const double far = chance(0.2) ? magnitude(5) : 4.0;
            Light light = chance(0.5) ? point_light(middle_ + vector(far), intensity)
                                      : directional_light(vector(far) + Vec3(1e-3), intensity);
            light.casts_shadow = !chance(0.1);
            scene.lights.push_back(light);
        }
    }

    void add_camera()
    {
        Camera& camera = scene.camera;
        camera.fov = random_.between(1, 120);
        camera.position = middle_ + (chance(0.2) ? vector(1.0) : vector(9.0));
        if (chance(0.15))
            camera.position += vector(1.0) * magnitude(4);
        camera.rotation = look_at(camera.position, middle_ + vector(2.0), Vec3(0.1, 1, 0.02));
        camera.pixel_sample = {random_.between(0, 1), random_.between(0, 1)};
    }

    SceneRandom random_;
    Vec3 middle_{0.0};
};

bool in_registers(const Scene& scene, const std::string& isa)
{
    LoweredScene lowered = lower(scene);
    leave_out(lowered);
    const auto& table = precision<float>(kernels_of(isa));
    const PackedScene<float> packed(lowered, frame_traversal(lowered, Traversal::automatic,
                                                             table.lanes));
    return fused_for(table, lowered.features, packed.view()) != nullptr;
}

struct Frame {
    Image<float> image;
    abi::RayCounts counts;
};

/// By tiles, which is how frames are made; in streams of the general kernel if asked for.
Frame render_tiles(const Scene& scene, const std::string& isa, bool streams, int samples = 1)
{
    RenderOptions options;
    options.force_general = streams;
    options.samples = samples;
    const TileRenderer<float> tiles(scene, lower(scene), kernels_of(isa), options);
    Frame frame{Image<float>(scene.width, scene.height), {}};
    for (int y = 0; y < scene.height; y += abi::tile_size)
        for (int x = 0; x < scene.width; x += abi::tile_size)
            frame.counts += samples > 1 ? tiles.render_mean(frame.image, x, y)
                                        : tiles.render_once(frame.image, x, y);
    return frame;
}

bool same_bits(const Image<float>& a, const Image<float>& b)
{
    return std::memcmp(a.rgb.data(), b.rgb.data(), a.rgb.size() * sizeof(float)) == 0;
}

/// More than the usual number, where the environment asks for it.
unsigned scene_count(unsigned usual)
{
    const char* const asked = std::getenv("PACKTRACE_FUSED_SCENES");
    return asked != nullptr ? static_cast<unsigned>(std::atoi(asked)) : usual;
}

Scene note_scene()
{
    return read_scene(std::string(PACKTRACE_SOURCE_DIR) + "/scenes/four_spheres.scene");
}

}  // namespace

TEST_CASE("paths in registers give the bits of streams", "[fused]")
{
    unsigned traced = 0;
    for (unsigned seed = 1; seed <= scene_count(150); ++seed) {
        const Scene scene = FewObjects(seed).scene;
        for (const std::string& isa : supported_isas()) {
            traced += in_registers(scene, isa);
            CAPTURE(seed, isa);
            CHECK(same_bits(render_tiles(scene, isa, false).image,
                            render_tiles(scene, isa, true).image));
        }
    }
    CHECK(traced >= scene_count(150) * supported_isas().size() / 2);
}

TEST_CASE("paths in registers take the same rays as streams", "[fused]")
{
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        const abi::RayCounts streams = render_tiles(note_scene(), isa, true).counts;
        const abi::RayCounts registers = render_tiles(note_scene(), isa, false).counts;
        CHECK(registers.camera == streams.camera);
        CHECK(registers.shadow == streams.shadow);
        CHECK(registers.reflected == streams.reflected);
        CHECK(registers.refracted == streams.refracted);
    }
}

TEST_CASE("several samples a pixel go through registers, too", "[fused]")
{
    Scene scene = note_scene();
    set_size(scene, 70, 45);
    for (const std::string& isa : supported_isas()) {
        CAPTURE(isa);
        CHECK(same_bits(render_tiles(scene, isa, false, 4).image,
                        render_tiles(scene, isa, true, 4).image));
    }
    RenderOptions options;
    options.samples = 8;
    options.adaptive = 0.05;
    const Image<float> registers = render<float>(scene, options);
    options.force_general = true;
    CHECK(same_bits(registers, render<float>(scene, options)));
}

TEST_CASE("what registers have no room for goes through streams", "[fused]")
{
    const std::string isa = choose_isa().name;
    Scene scene = note_scene();
    CHECK(in_registers(scene, isa));
    SECTION("a quadric")
    {
        scene.objects.push_back(make_object(cylinder()));
        CHECK_FALSE(in_registers(scene, isa));
    }
    SECTION("many objects")
    {
        for (int i = 0; i < 40; ++i)
            scene.objects.push_back(make_object(sphere(Vec3(i, 5, 9), 0.3)));
        CHECK_FALSE(in_registers(scene, isa));
    }
    SECTION("weights that are cut")
    {
        scene.min_weight = 0.1;
        CHECK_FALSE(in_registers(scene, isa));
    }
}

}  // namespace packtrace::test
