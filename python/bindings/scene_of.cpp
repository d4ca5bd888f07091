#include "scene.hpp"
#include "scene/vectors.hpp"
#include "words.hpp"
#include <packtrace/build.hpp>

#include <unordered_map>
#include <utility>

namespace packtrace::python {
namespace {

std::string type_of(py::handle value)
{
    return py::str(py::type::handle_of(value).attr("__name__"));
}

/// "lights[0]"
std::string at_index(const std::string& list, std::size_t index)
{
    return list + "[" + std::to_string(index) + "]";
}

Rgb color_field(py::handle object, const char* key)
{
    return color_of(object.attr(key), key);
}

template <class Enum>
Enum word_field(py::handle object, const char* key)
{
    return word_value<Enum>(object.attr(key), key);
}

Sphere sphere_of(py::handle sphere)
{
    return {field<Vec3>(sphere, "center"), field<double>(sphere, "radius")};
}

/// Does not normalise a unit normal, so that a scene that was read keeps its digits.
Plane plane_of(py::handle value)
{
    const auto normal = field<Vec3>(value, "normal");
    Plane result = plane(field<Vec3>(value, "point"), normal);
    if (language::is_unit(normal)) {
        result.normal = normal;
        plane_axes(result);
    }
    return result;
}

Quadric quadric_of(py::handle value)
{
    const auto kind = word_field<QuadricKind>(value, "kind");
    Quadric result = quadric(kind);
    const py::object coefficients = value.attr("coefficients");
    if (kind == QuadricKind::general)
        from_python(coefficients, "coefficients", result.coefficients);
    else if (!coefficients.is_none())
        throw_wrong("coefficients", coefficients,
                    "None, as the kind '" + std::string(word_of(kind)) +
                        "' has its own, or kind='general'");
    if (const py::object range = value.attr("z_range"); !range.is_none()) {
        const auto ends = value_of<Vec2>(range, "z_range");
        result.z_range = ZRange{ends.x, ends.y};
    }
    result.capped = field<bool>(value, "capped");
    return result;
}

Polygon polygon_of(py::handle value)
{
    Polygon polygon;
    for (const py::object& contour : elements_of(value.attr("contours"), "contours")) {
        const std::string name = at_index("contours", polygon.contours.size());
        std::vector<Vec3>& corners = polygon.contours.emplace_back();
        for (const py::object& corner : elements_of(contour, name))
            corners.push_back(value_of<Vec3>(corner, at_index(name, corners.size())));
    }
    return polygon;
}

ScratchMaterial scratch_of(py::handle value)
{
    return {field<double>(value, "specular"), field<double>(value, "reflective")};
}

SketchMaterial sketch_of(py::handle value)
{
    return {color_field(value, "ambient"),     color_field(value, "diffuse"),
            color_field(value, "specular"),    color_field(value, "refractive"),
            field<double>(value, "shininess"), field<double>(value, "ior")};
}

WhittedMaterial whitted_of(py::handle value)
{
    return {color_field(value, "ambient"),     color_field(value, "diffuse"),
            color_field(value, "specular"),    color_field(value, "transmissive"),
            field<double>(value, "shininess"), field<double>(value, "ior")};
}

ShaderMaterial shader_of(py::handle value)
{
    return {field<std::array<double, 4>>(value, "reflectance")};
}

GeneralMaterial general_of(py::handle value)
{
    return {color_field(value, "ambient"),   color_field(value, "diffuse"),
            color_field(value, "highlight"), color_field(value, "reflect"),
            color_field(value, "transmit"),  field<double>(value, "shininess"),
            field<double>(value, "ior")};
}

Light light_of(py::handle value)
{
    return {word_field<LightType>(value, "type"), color_field(value, "intensity"),
            field<Vec3>(value, "vector"), field<bool>(value, "casts_shadow")};
}

/// Calls `convert`. Its errors get the prefix `what`, unless that is empty.
template <class Convert>
auto about(const std::string& what, const Convert& convert)
{
    const std::string subject = what.empty() ? what : what + ": ";
    try {
        return convert();
    } catch (const py::value_error& error) {
        throw py::value_error(subject + error.what());
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_AttributeError))
            throw;
        throw py::value_error(subject + py::str(error.value()).cast<std::string>());
    }
}

class FromPython {
public:
    [[nodiscard]] Scene scene(py::handle value)
    {
        if (!is_a(value, "Scene"))
            throw_wrong("scene", value, "a packtrace.Scene");
        const auto illumination = word_field<Illumination>(value, "illumination");
        Scene result = make_scene(illumination);
        default_material_ = make_material(illumination);
        result.width = field<int>(value, "width");
        result.height = field<int>(value, "height");
        result.background = color_field(value, "background");
        if (const py::object depth = value.attr("max_depth"); !depth.is_none())
            from_python(depth, "max_depth", result.max_depth);
        result.min_weight = field<double>(value, "min_weight");
        result.depth_limit = word_field<DepthLimit>(value, "depth_limit");
        result.shadows = word_field<ShadowKind>(value, "shadows");
        about("camera", [&] { camera(value.attr("camera"), result.camera); });
        objects(value, result.objects);
        for (const py::object& light : elements_of(value.attr("lights"), "lights"))
            result.lights.push_back(about(at_index("lights", result.lights.size()), [&] {
                if (!is_a(light, "Light"))
                    wrong_class(light, "a Light");
                return light_of(light);
            }));
        if (const py::object moves = value.attr("animation"); !moves.is_none())
            result.animation = animation(moves);
        return result;
    }

private:
    [[nodiscard]] bool is_a(py::handle value, const char* name)
    {
        py::object& type = classes_[name];
        if (!type)
            type = module_.attr(name);
        return py::isinstance(value, type);
    }

    [[noreturn]] static void wrong_class(py::handle value, const std::string& use)
    {
        throw py::value_error("is of the class " + type_of(value) + "; use " + use);
    }

    void camera(py::handle value, Camera& to)
    {
        if (!is_a(value, "Camera"))
            wrong_class(value, "a Camera");
        to.position = field<Vec3>(value, "position");
        to.rotation = field<Mat3>(value, "rotation");
        to.viewport = field<Vec2>(value, "viewport");
        to.distance = field<double>(value, "distance");
        to.fov = optional_of<double>(value.attr("fov"), "fov");
        if (const py::object sample = value.attr("pixel_sample"); !sample.is_none())
            from_python(sample, "pixel_sample", to.pixel_sample);
    }

    void objects(py::handle scene, std::vector<Object>& to)
    {
        const auto fields = scene.attr("__dict__").cast<py::dict>();
        if (!fields.contains("objects") && fields.contains("_native_objects")) {
            to = *fields["_native_objects"].cast<const NativeObjects&>().objects;
            return;
        }
        const std::vector<py::object> values = elements_of(scene.attr("objects"), "objects");
        to.reserve(values.size());
        for (const py::object& value : values)
            to.push_back(object(value, to.size()));
    }

    [[nodiscard]] Object object(py::handle value, std::size_t number)
    {
        return about(at_index("objects", number), [&] {
            if (!is_a(value, "Object"))
                wrong_class(value, "an Object, such as Object(Sphere((0, 0, 5), 1))");
            Object result;
            result.name = field<std::string>(value, "name");
            return about(result.name.empty() ? "" : "'" + result.name + "'", [&] {
                result.surface = surface(value.attr("surface"));
                if (const py::object given = value.attr("transform"); !given.is(identity_))
                    from_python(given, "transform", result.transform);
                result.material = material(value.attr("material"));
                result.casts_shadow = field<bool>(value, "casts_shadow");
                return result;
            });
        });
    }

    [[nodiscard]] Surface surface(py::handle value)
    {
        if (is_a(value, "Sphere"))
            return sphere_of(value);
        if (is_a(value, "Plane"))
            return plane_of(value);
        if (is_a(value, "Quadric"))
            return quadric_of(value);
        if (is_a(value, "Polygon"))
            return polygon_of(value);
        throw_wrong("surface", value, "a Sphere, Plane, Quadric or Polygon");
    }

    /// Converts each material once, because objects share materials.
    [[nodiscard]] const Material& material(py::handle value)
    {
        if (value.is_none())
            return default_material_;
        const auto [entry, is_new] = materials_.try_emplace(value.ptr());
        if (is_new)
            entry->second = {py::reinterpret_borrow<py::object>(value),
                             about("material", [&] { return new_material(value); })};
        return entry->second.material;
    }

    [[nodiscard]] Material new_material(py::handle value)
    {
        Material result;
        if (is_a(value, "ScratchMaterial"))
            result.model = scratch_of(value);
        else if (is_a(value, "SketchMaterial"))
            result.model = sketch_of(value);
        else if (is_a(value, "WhittedMaterial"))
            result.model = whitted_of(value);
        else if (is_a(value, "ShaderMaterial"))
            result.model = shader_of(value);
        else if (is_a(value, "GeneralMaterial"))
            result.model = general_of(value);
        else
            wrong_class(value,
                        "the one that fits the illumination, such as "
                        "ScratchMaterial");
        result.name = field<std::string>(value, "name");
        result.color = color_field(value, "color");
        if (const py::object checker = value.attr("checker"); !checker.is_none())
            result.checker = Checker{color_field(checker, "other"), field<double>(checker, "size")};
        return result;
    }

    [[nodiscard]] Animation animation(py::handle value)
    {
        Animation result;
        std::vector<py::object> keys;
        about("animation", [&] {
            if (!is_a(value, "Animation"))
                wrong_class(value, "an Animation");
            result.frames = field<int>(value, "frames");
            if (const py::object orbit = value.attr("orbit"); !orbit.is_none())
                result.orbit = Orbit{field<Vec3>(orbit, "center"), field<Vec3>(orbit, "axis"),
                                     field<double>(orbit, "degrees")};
            keys = elements_of(value.attr("keys"), "keys");
        });
        for (const py::object& key : keys)
            result.keys.push_back(about(at_index("animation.keys", result.keys.size()), [&] {
                return CameraKey{field<int>(key, "frame"), field<Vec3>(key, "position"),
                                 field<Vec3>(key, "look_at"), field<Vec3>(key, "up")};
            }));
        return result;
    }

    /// Keeps the Python object alive. Otherwise, if a property returns a new material each time,
    /// Python could give the next one the same address.
    struct KeptMaterial {
        py::object kept;
        Material material;
    };

    py::module_ module_ = py::module_::import("packtrace.scene");
    py::object identity_ = module_.attr("IDENTITY");
    std::unordered_map<std::string, py::object> classes_;
    Material default_material_;
    std::unordered_map<PyObject*, KeptMaterial> materials_;
};

}  // namespace

Scene scene_of(py::handle scene)
{
    return FromPython().scene(scene);
}

}  // namespace packtrace::python
