#include "lab/harness/names.hpp"
#include "lab/harness/ray_trees.hpp"
#include <packtrace/explain.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace packtrace {
namespace {

using Numbers = std::vector<double>;

Numbers numbers(const Vec3& v)
{
    return {v.x, v.y, v.z};
}

Numbers of_hit(const RayNode& ray, const Vec3& v)
{
    return ray.object >= 0 ? numbers(v) : Numbers{};
}

double length(const Numbers& v)
{
    double sum = 0.0;
    for (const double x : v)
        sum += x * x;
    return std::sqrt(sum);
}

// Equal infinities are close; NaN is close to nothing.
bool close(const Numbers& a, const Numbers& b, double tolerance)
{
    if (a == b)
        return true;
    Numbers between = a;
    for (std::size_t i = 0; i < a.size(); ++i)
        between[i] -= b[i];
    const double scale = std::max({1.0, length(a), length(b)});
    return std::isfinite(scale) && length(between) <= tolerance * scale;
}

bool brings(const RayNode* ray)
{
    return ray != nullptr && ray->brought != Rgb(0.0);
}

// The rows of two ray trees. A ray may be missing in one of them.
class Rows {
public:
    explicit Rows(double tolerance) : tolerance_(tolerance)
    {
    }

    void add_rays(const RayNode* first, const RayNode* second, const std::string& name, int depth)
    {
        name_ = name;
        depth_ = depth;
        first_ = first;
        second_ = second;
        add_ray();
        if (hits())
            add_hit();
        if (!hits() || brings(first) || brings(second))
            add("brought", [](const RayNode& ray) { return numbers(ray.brought); });
        for (const RayKind kind : {RayKind::mirrored, RayKind::refracted}) {
            const RayNode* a = child_of(first, kind);
            const RayNode* b = child_of(second, kind);
            if (a != nullptr || b != nullptr)
                add_rays(a, b, name + ", " + name_of(kind), depth + 1);
        }
    }

    std::vector<TreeRow> rows;

private:
    void add_ray()
    {
        add("origin", [](const RayNode& ray) { return numbers(ray.org); });
        add("direction", [](const RayNode& ray) { return numbers(ray.dir); });
        add("weight", [](const RayNode& ray) { return numbers(ray.weight); });
        add("object", [](const RayNode& ray) { return Numbers{static_cast<double>(ray.object)}; });
        if (first_ != nullptr && second_ != nullptr)
            rows.back().differs = first_->object != second_->object;
        add("t", [](const RayNode& ray) { return Numbers{ray.t}; });
    }

    void add_hit()
    {
        add("point", [](const RayNode& ray) { return of_hit(ray, ray.point); });
        add("normal", [](const RayNode& ray) { return of_hit(ray, ray.normal); });
        std::set<int> lights;
        for (const RayNode* ray : {first_, second_})
            if (ray != nullptr)
                for (const LightShare& light : ray->lights)
                    lights.insert(light.light);
        for (const int light : lights)
            add_light(light);
        add("local", [](const RayNode& ray) { return numbers(ray.local); });
    }

    // A share that only one tree computed is no difference.
    void add_light(int light)
    {
        const std::string name = "light " + std::to_string(light + 1);
        add(name + " share", [light](const RayNode& ray) {
            const LightShare* share = light_of(&ray, light);
            return share != nullptr && share->share ? numbers(*share->share) : Numbers{};
        });
        const bool both = light_of(first_, light) && light_of(second_, light);
        if (both && (rows.back().first.empty() || rows.back().second.empty()))
            rows.back().differs = false;
        add(name + " color", [light](const RayNode& ray) {
            const LightShare* share = light_of(&ray, light);
            return share != nullptr ? numbers(share->color) : Numbers{};
        });
    }

    [[nodiscard]] bool hits() const
    {
        return (first_ != nullptr && first_->object >= 0) ||
               (second_ != nullptr && second_->object >= 0);
    }

    template <class Get>
    void add(const std::string& field, const Get& get)
    {
        TreeRow row{name_, depth_, field, {}, {}, false};
        if (first_ != nullptr)
            row.first = get(*first_);
        if (second_ != nullptr)
            row.second = get(*second_);
        const bool both = row.first.size() == row.second.size();
        row.differs = !both || !close(row.first, row.second, tolerance_);
        rows.push_back(row);
    }

    double tolerance_;
    std::string name_;
    int depth_ = 0;
    const RayNode* first_ = nullptr;
    const RayNode* second_ = nullptr;
};

}  // namespace

std::vector<TreeRow> side_by_side(const RayNode& first, const RayNode& second, double tolerance)
{
    Rows rows(tolerance);
    rows.add_rays(&first, &second, name_of(first.kind), 0);
    return rows.rows;
}

}  // namespace packtrace
