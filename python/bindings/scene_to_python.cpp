#include "scene.hpp"
#include "words.hpp"

#include <memory>
#include <utility>

namespace packtrace::python {
namespace {

using namespace py::literals;

class ToPython {
public:
    [[nodiscard]] py::object scene(Scene&& scene) const
    {
        py::object result =
            make("Scene", "width"_a = scene.width, "height"_a = scene.height,
                 "background"_a = to_python(scene.background),
                 "illumination"_a = word_of(scene.illumination), "max_depth"_a = scene.max_depth,
                 "min_weight"_a = scene.min_weight, "depth_limit"_a = word_of(scene.depth_limit),
                 "shadows"_a = word_of(scene.shadows), "camera"_a = camera(scene.camera),
                 "lights"_a = list(scene.lights), "animation"_a = optional(scene.animation));
        py::delattr(result, "objects");
        result.attr("_native_objects") =
            NativeObjects{std::make_shared<const std::vector<Object>>(std::move(scene.objects))};
        return result;
    }

    [[nodiscard]] py::object camera(const Camera& camera) const
    {
        return make("Camera", "position"_a = to_python(camera.position),
                    "rotation"_a = to_python(camera.rotation),
                    "viewport"_a = to_python(camera.viewport), "distance"_a = camera.distance,
                    "fov"_a = optional(camera.fov),
                    "pixel_sample"_a = to_python(camera.pixel_sample));
    }

    template <class T>
    [[nodiscard]] py::list list(const std::vector<T>& values) const
    {
        py::list result(values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            result[i] = one(values[i]);
        return result;
    }

private:
    template <class... Fields>
    [[nodiscard]] py::object make(const char* name, Fields&&... fields) const
    {
        return classes_.attr(name)(std::forward<Fields>(fields)...);
    }

    template <class T>
    [[nodiscard]] py::object optional(const std::optional<T>& value) const
    {
        return value ? one(*value) : py::none();
    }

    [[nodiscard]] py::object one(double value) const
    {
        return py::float_(value);
    }

    [[nodiscard]] py::object one(const ZRange& range) const
    {
        return py::make_tuple(range.low, range.high);
    }

    [[nodiscard]] py::object one(const Vec3& value) const
    {
        return to_python(value);
    }

    [[nodiscard]] py::object one(const std::vector<Vec3>& contour) const
    {
        return list(contour);
    }

    [[nodiscard]] py::object one(const Checker& checker) const
    {
        return make("Checker", "other"_a = to_python(checker.other), "size"_a = checker.size);
    }

    [[nodiscard]] py::object one(const Light& light) const
    {
        return make("Light", "type"_a = word_of(light.type),
                    "intensity"_a = to_python(light.intensity),
                    "vector"_a = to_python(light.vector), "casts_shadow"_a = light.casts_shadow);
    }

    [[nodiscard]] py::object one(const Orbit& orbit) const
    {
        return make("Orbit", "center"_a = to_python(orbit.center), "axis"_a = to_python(orbit.axis),
                    "degrees"_a = orbit.degrees);
    }

    [[nodiscard]] py::object one(const CameraKey& key) const
    {
        return make("CameraKey", "frame"_a = key.frame, "position"_a = to_python(key.position),
                    "look_at"_a = to_python(key.look_at), "up"_a = to_python(key.up));
    }

    [[nodiscard]] py::object one(const Animation& animation) const
    {
        return make("Animation", "frames"_a = animation.frames,
                    "orbit"_a = optional(animation.orbit), "keys"_a = list(animation.keys));
    }

    [[nodiscard]] py::object one(const Object& object) const
    {
        return make("Object", "surface"_a = surface(object.surface),
                    "material"_a = material(object.material), "name"_a = to_python(object.name),
                    "transform"_a = object.transform == Mat4(1.0) ? py::object(identity_)
                                                                  : to_python(object.transform),
                    "casts_shadow"_a = object.casts_shadow);
    }

    [[nodiscard]] py::object surface(const Surface& surface) const
    {
        return std::visit([this](const auto& alternative) { return shape(alternative); }, surface);
    }

    [[nodiscard]] py::object shape(const Sphere& sphere) const
    {
        return make("Sphere", "center"_a = to_python(sphere.center), "radius"_a = sphere.radius);
    }

    [[nodiscard]] py::object shape(const Plane& plane) const
    {
        return make("Plane", "point"_a = to_python(plane.point),
                    "normal"_a = to_python(plane.normal));
    }

    [[nodiscard]] py::object shape(const Quadric& quadric) const
    {
        const bool general = quadric.kind == QuadricKind::general;
        return make(
            "Quadric", "kind"_a = word_of(quadric.kind),
            "coefficients"_a = general ? py::object(to_python(quadric.coefficients)) : py::none(),
            "z_range"_a = optional(quadric.z_range), "capped"_a = quadric.capped);
    }

    [[nodiscard]] py::object shape(const Polygon& polygon) const
    {
        return make("Polygon", "contours"_a = list(polygon.contours));
    }

    [[nodiscard]] py::object material(const Material& material) const
    {
        py::object result =
            std::visit([this](const auto& model) { return of_model(model); }, material.model);
        result.attr("color") = to_python(material.color);
        result.attr("checker") = optional(material.checker);
        result.attr("name") = to_python(material.name);
        return result;
    }

    [[nodiscard]] py::object of_model(const ScratchMaterial& model) const
    {
        return make("ScratchMaterial", "specular"_a = model.specular,
                    "reflective"_a = model.reflective);
    }

    [[nodiscard]] py::object of_model(const SketchMaterial& model) const
    {
        return make("SketchMaterial", "ambient"_a = to_python(model.ambient),
                    "diffuse"_a = to_python(model.diffuse),
                    "specular"_a = to_python(model.specular),
                    "refractive"_a = to_python(model.refractive), "shininess"_a = model.shininess,
                    "ior"_a = model.ior);
    }

    [[nodiscard]] py::object of_model(const WhittedMaterial& model) const
    {
        return make("WhittedMaterial", "ambient"_a = to_python(model.ambient),
                    "diffuse"_a = to_python(model.diffuse),
                    "specular"_a = to_python(model.specular),
                    "transmissive"_a = to_python(model.transmissive),
                    "shininess"_a = model.shininess, "ior"_a = model.ior);
    }

    [[nodiscard]] py::object of_model(const ShaderMaterial& model) const
    {
        return make("ShaderMaterial", "reflectance"_a = to_python(model.reflectance));
    }

    [[nodiscard]] py::object of_model(const GeneralMaterial& model) const
    {
        return make(
            "GeneralMaterial", "ambient"_a = to_python(model.ambient),
            "diffuse"_a = to_python(model.diffuse), "highlight"_a = to_python(model.highlight),
            "reflect"_a = to_python(model.reflect), "transmit"_a = to_python(model.transmit),
            "shininess"_a = model.shininess, "ior"_a = model.ior);
    }

    py::module_ classes_ = py::module_::import("packtrace.scene");
    py::object identity_ = classes_.attr("IDENTITY");
};

}  // namespace

py::object to_python(Scene scene)
{
    return ToPython().scene(std::move(scene));
}

py::object to_python(const Camera& camera)
{
    return ToPython().camera(camera);
}

py::list to_python(const std::vector<Object>& objects)
{
    return ToPython().list(objects);
}

}  // namespace packtrace::python
