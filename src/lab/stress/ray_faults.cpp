#include "lab/stress/ray_faults.hpp"

#include <algorithm>
#include <cstdio>

namespace packtrace::lab {
namespace {

std::string text_of(const Vec3& v)
{
    char text[96];
    std::snprintf(text, sizeof text, "(%.17g,%.17g,%.17g)", v.x, v.y, v.z);
    return text;
}

std::string hit_text(std::int32_t object, double t, const Vec3& normal)
{
    char text[64];
    std::snprintf(text, sizeof text, "object %d at t = %.17g, normal ", object, t);
    return object < 0 ? "a miss" : text + text_of(normal);
}

}  // namespace

bool same_answers(const StressRun& a, const StressRun& b)
{
    return std::equal(a.answers.begin(), a.answers.end(), b.answers.begin(), b.answers.end(),
                      [](const Answer& x, const Answer& y) {
                          return x.object == y.object && x.t == y.t &&
                                 (x.object < 0 || x.normal == y.normal);
                      });
}

const char* fault_of(const Errors& one)
{
    if (one.wrong() > 0)
        return one.lost > 0           ? "lost"
               : one.false_hits > 0   ? "false hit"
               : one.wrong_object > 0 ? "wrong object"
                                      : "wrong root";
    if (one.occluded > 0)
        return "any-hit answer wrong";
    if (one.order > 0)
        return "another object first in the list of all hits";
    if (one.not_closed > 0)
        return "does not leave once";
    if (one.not_finite + one.no_normal > 0)
        return "no number, or no normal";
    if (one.wrong_side > 0)
        return "normal on the wrong side";
    if (one.t_beyond > 0)
        return "t off";
    return one.normal_beyond > 0 ? "normal off" : "";
}

std::string example_text(const StressGroup& group, std::size_t scene, std::size_t ray,
                         const Answer& answer, const char* fault)
{
    const StressRay& r = group.rays[ray];
    const Expected& e = group.expected[ray];
    return std::string(fault) + ": scene " + std::to_string(scene) + ", ray " +
           std::to_string(ray) + " " + text_of(r.org) + " -> " + text_of(r.dir) + ": expected " +
           hit_text(e.object, static_cast<double>(e.t), e.normal) + "; got " +
           hit_text(answer.object, answer.t, answer.normal);
}

void evaluate_ray(Evaluation& evaluation, const StressGroup& group, const StressRun& run,
                  std::size_t i)
{
    const Expected& expected = group.expected[i];
    evaluation.add(group.rays[i], expected, run.answers[i]);
    if (run.occluded.empty())
        return;
    evaluation.add_occluded(expected, run.occluded[i] != 0);
    evaluation.add_first_of_all(expected, run.first[i], run.answers[i].object);
    evaluation.add_crossings(expected, run.crossings[i]);
}

std::string csv_of(const StressRay& ray)
{
    char text[256];
    std::snprintf(text, sizeof text, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", ray.org.x,
                  ray.org.y, ray.org.z, ray.dir.x, ray.dir.y, ray.dir.z, ray.t_min, ray.t_max);
    return text;
}

}  // namespace packtrace::lab
