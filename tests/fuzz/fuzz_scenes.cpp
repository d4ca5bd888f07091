// Random scenes with some numbers replaced by any value: every way to trace a scene passes the
// checks of packtrace soak.
#include "fuzzer.hpp"
#include "lab/soak/soak.hpp"
#include "lab/soak/soak_scene.hpp"
#include <packtrace/read_scene.hpp>

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace packtrace;

/// Takes values off the front of the bytes; gives zeros after their end.
class Reader {
public:
    explicit Reader(fuzz::Bytes bytes) : bytes_(bytes)
    {
    }
    template <class Value>
    [[nodiscard]] Value take()
    {
        Value value{};
        const std::size_t size = std::min(sizeof value, bytes_.size());
        std::memcpy(&value, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
        return value;
    }
    [[nodiscard]] bool empty() const
    {
        return bytes_.empty();
    }

private:
    fuzz::Bytes bytes_;
};

/// All numbers that place the objects.
std::vector<double*> numbers_of(Scene& scene)
{
    std::vector<double*> numbers;
    const auto add = [&](Vec3& v) { numbers.insert(numbers.end(), {&v.x, &v.y, &v.z}); };
    for (Object& object : scene.objects) {
        if (auto* const sphere = std::get_if<Sphere>(&object.surface)) {
            add(sphere->center);
            numbers.push_back(&sphere->radius);
        } else if (auto* const plane = std::get_if<Plane>(&object.surface)) {
            add(plane->point);
        } else if (auto* const quadric = std::get_if<Quadric>(&object.surface)) {
            for (double& coefficient : quadric->coefficients)
                numbers.push_back(&coefficient);
            if (quadric->z_range)
                numbers.insert(numbers.end(), {&quadric->z_range->low, &quadric->z_range->high});
        }
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                numbers.push_back(&object.transform[column][row]);
    }
    add(scene.camera.position);
    for (Light& light : scene.lights)
        add(light.vector);
    return numbers;
}

Scene scene_of(fuzz::Bytes bytes)
{
    Reader reader(bytes);
    lab::StressRandom random(reader.take<std::uint64_t>());
    Scene scene = lab::soak_scene(random);
    constexpr std::size_t most_objects = 6;
    scene.objects.resize(std::min(scene.objects.size(), most_objects));
    scene.width = 4;
    scene.height = 3;
    while (!reader.empty()) {
        const std::vector<double*> numbers = numbers_of(scene);
        const std::size_t which = reader.take<std::uint16_t>() % numbers.size();
        *numbers[which] = reader.take<double>();
    }
    return scene;
}

}  // namespace

PACKTRACE_FUZZER(scenes)
{
    std::string what;
    try {
        const Scene scene = lab::as_read(scene_of(bytes));
        if (const auto finding = lab::check_scene(scene, SelfHits::exact, 1))
            what = finding->what;
    } catch (const SceneError&) {
    } catch (const std::invalid_argument&) {
    }
    fuzz::require(what.empty(), what.c_str());
}
