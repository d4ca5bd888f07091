#include "lab/stress/evaluate.hpp"

#include "scene/vectors.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace packtrace::lab {
namespace {

/// t may be wrong by this many times the error by rounding the inputs.
constexpr double condition_slack = 4.0;

/// The allowed error of a component of a normal.
constexpr double allowed_normal_error = 1e-6;

/// Two t differ if they are this many roundoffs apart, and two normals this many.
constexpr double t_roundoffs = 4.0;
constexpr double normal_roundoffs = 16.0;

bool finite(const Answer& answer)
{
    return std::isfinite(answer.t + answer.normal.x + answer.normal.y + answer.normal.z);
}

double distance_of(const Wide& t, const Answer& answer)
{
    return std::abs(static_cast<double>(Wide(answer.t) - t));
}

/// For an answer with the right object: whether it is the other hit rather than the expected one.
/// It is decided by t if the two t differ in the answer's precision, else by the normal.
bool is_other(const Expected& expected, const TrueHit& other, const Answer& answer, double roundoff)
{
    const double gap = std::abs(static_cast<double>(other.t - expected.t));
    if (gap > t_roundoffs * roundoff * std::abs(static_cast<double>(expected.t)))
        return distance_of(other.t, answer) < distance_of(expected.t, answer);
    const Vec3 normal = narrow(other.normal);
    return largest_component(normal - expected.normal) > normal_roundoffs * roundoff &&
           largest_component(answer.normal - normal) <
               largest_component(answer.normal - expected.normal);
}

bool has_wrong_root(const Expected& expected, const Answer& answer, double roundoff)
{
    if (!finite(answer))
        return false;
    return std::any_of(expected.hits.begin(), expected.hits.end(), [&](const TrueHit& hit) {
        return hit.object == expected.object && hit.t != expected.t &&
               is_other(expected, hit, answer, roundoff);
    });
}

/// The verdict where the expected hit is not decided: right if a change of the inputs within the
/// band makes the answer right.
Verdict verdict_in_band(const Expected& expected, const Answer& answer, double band,
                        double roundoff)
{
    const auto& hits = expected.hits;
    const auto unsure = [&](const TrueHit& hit) {
        return std::min(hit.margin, margin_of_end(hit, roundoff)) < band;
    };
    const auto sure_before = [&](double t) {
        return std::any_of(hits.begin(), hits.end(), [&](const TrueHit& hit) {
            const double off = condition_slack * hit.condition * std::max(band, roundoff) / 2.0;
            return hit.exists && !unsure(hit) &&
                   static_cast<double>(hit.t) * (1.0 + off + 8.0 * roundoff) < t;
        });
    };
    if (answer.object < 0) {
        const bool sure = expected.certain || std::any_of(hits.begin(), hits.end(), [&](auto& hit) {
                              return hit.exists && !unsure(hit);
                          });
        return sure ? Verdict::lost : Verdict::right;
    }
    const bool possible = std::any_of(hits.begin(), hits.end(), [&](const TrueHit& hit) {
        return hit.object == answer.object && (hit.exists || unsure(hit));
    });
    if (!possible)
        return expected.object < 0 ? Verdict::false_hit : Verdict::wrong_object;
    return sure_before(answer.t) ? Verdict::wrong_object : Verdict::right;
}

}  // namespace

Verdict verdict_of(const Expected& expected, const Answer& answer, double band, double roundoff)
{
    if (!expected.decided(band))
        return verdict_in_band(expected, answer, band, roundoff);
    if (answer.object != expected.object) {
        if (answer.object < 0)
            return Verdict::lost;
        return expected.object < 0 ? Verdict::false_hit : Verdict::wrong_object;
    }
    const bool other = answer.object >= 0 && expected.root_decided(band) &&
                       has_wrong_root(expected, answer, roundoff);
    return other ? Verdict::wrong_root : Verdict::right;
}

void Errors::add(const Errors& other)
{
    for (const auto& [key, count] : error_counts)
        this->*count += other.*count;
    rho = std::max(rho, other.rho);
    distance = std::max(distance, other.distance);
    ulp.insert(ulp.end(), other.ulp.begin(), other.ulp.end());
    normal.insert(normal.end(), other.normal.begin(), other.normal.end());
}

void Evaluation::count(Verdict verdict)
{
    errors_.lost += verdict == Verdict::lost;
    errors_.false_hits += verdict == Verdict::false_hit;
    errors_.wrong_object += verdict == Verdict::wrong_object;
    errors_.wrong_root += verdict == Verdict::wrong_root;
}

void Evaluation::add(const StressRay& ray, const Expected& expected, const Answer& answer)
{
    ++errors_.rays;
    errors_.undecided += !expected.root_decided(double_band);
    const Verdict verdict = verdict_of(expected, answer, double_band, roundoff_);
    count(verdict);
    errors_.beyond_own_band +=
        verdict_of(expected, answer, undecided_band * roundoff_, roundoff_) != Verdict::right;
    if (answer.object < 0)
        return;
    ++errors_.hits;
    if (!finite(answer))
        ++errors_.not_finite;
    else if (verdict == Verdict::right && expected.root_decided(double_band))
        measure(ray, expected, answer);
}

void Evaluation::measure(const StressRay& ray, const Expected& expected, const Answer& answer)
{
    const double t = static_cast<double>(expected.t);
    const double error = distance_of(expected.t, answer);
    const double least = roundoff_ > 0x1p-40 ? 0x1p-149 : 0x1p-1074;
    const double ulp = std::max(least, std::ldexp(2.0 * roundoff_, std::ilogb(t)));
    errors_.ulp.push_back(static_cast<float>(error / ulp));
    if (expected.root_decided(undecided_band * roundoff_))
        errors_.rho = std::max(errors_.rho, error / (t * expected.condition * roundoff_));
    const double allowed = condition_slack * expected.condition * t * 0x1p-53;
    errors_.t_beyond += error > ulp + allowed;
    errors_.t_beyond_half += error > 0.51 * ulp + allowed;
    errors_.t_at_limit += error > ulp && error <= ulp + allowed;

    if (!(std::abs(glm::length(answer.normal) - 1.0) < 8.0 * roundoff_)) {
        ++errors_.no_normal;
        return;
    }
    if (expected.normal == Vec3(0.0))
        return;
    const double off = largest_component(answer.normal - expected.normal);
    errors_.normal.push_back(static_cast<float>(off));
    errors_.normal_beyond += off > allowed_normal_error;
    const double cosine = glm::dot(answer.normal, ray.dir) / glm::length(ray.dir);
    const double uncertainty = 4.0 * roundoff_ + double_band * expected.normal_spread;
    errors_.wrong_side += cosine * expected.cosine < 0.0 && std::abs(expected.cosine) > uncertainty;
}

void Evaluation::add_occluded(const Expected& expected, bool occluded)
{
    const bool sure = expected.decided(double_band) || (expected.certain && !occluded);
    errors_.occluded += sure && occluded != (expected.object >= 0);
}

void Evaluation::add_first_of_all(const Expected& expected, std::int32_t first,
                                  std::int32_t closest)
{
    errors_.order += expected.decided(double_band) && first != closest;
}

void Evaluation::add_crossings(const Expected& expected, std::size_t count)
{
    if (!expected.certain && !expected.even)
        return;
    const bool sure = std::none_of(expected.hits.begin(), expected.hits.end(),
                                   [](const TrueHit& hit) { return hit.margin < double_band; });
    const auto exist = static_cast<std::size_t>(std::count_if(
        expected.hits.begin(), expected.hits.end(), [](const TrueHit& hit) { return hit.exists; }));
    const std::size_t odd = expected.certain ? 1 : 0;
    errors_.not_closed += count % 2 != odd || (sure && count != exist);
}

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
    std::snprintf(text, sizeof text,
                  "ox,oy,oz,dx,dy,dz,t_min,t_max\n"
                  "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
                  ray.org.x, ray.org.y, ray.org.z, ray.dir.x, ray.dir.y, ray.dir.z, ray.t_min,
                  ray.t_max);
    return text;
}

}  // namespace packtrace::lab
