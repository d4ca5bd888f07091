#include "study/judge.hpp"

#include <algorithm>
#include <cmath>

namespace packtrace::study {
namespace {

/// The meeting of the answer's object whose t is nearest to the answer's, among those that
/// exist or might.
const Meeting* meant(std::span<const Meeting> meetings, const Answer& answer, const auto& unsure)
{
    const Meeting* best = nullptr;
    const Wide t = answer.t;
    for (const Meeting& meeting : meetings) {
        if (meeting.object != answer.object || !(meeting.exists || unsure(meeting)))
            continue;
        if (best == nullptr || abs(meeting.t - t) < abs(best->t - t))
            best = &meeting;
    }
    return best;
}

/// Whether a meeting's being one is inside the band. The ends of a range are always told apart in
/// the precision of t.
auto unsure_within(double band, double band_of_ends)
{
    return [=](const Meeting& m) { return m.margin < band || m.end_margin < band_of_ends; };
}

bool finite(const Answer& answer)
{
    return std::isfinite(answer.t + answer.normal.x + answer.normal.y + answer.normal.z);
}

}  // namespace

void Errors::add(const Errors& other)
{
    rays += other.rays;
    hits += other.hits;
    undecidable += other.undecidable;
    wrong += other.wrong;
    wrong_in_band += other.wrong_in_band;
    not_finite += other.not_finite;
    rho = std::max(rho, other.rho);
    distance = std::max(distance, other.distance);
    normal = std::max(normal, other.normal);
    relative = std::max(relative, other.relative);
    beyond = std::max(beyond, other.beyond);
    ulp.insert(ulp.end(), other.ulp.begin(), other.ulp.end());
}

/// Whether the answer is the first meeting, for inputs that may be off by the band.
bool Judge::right(std::span<const Meeting> meetings, const Answer& answer, double roundoff) const
{
    const auto unsure = unsure_within(undecidable_band * roundoff, undecidable_band * roundoff_);
    const double slack = condition_slack * roundoff;
    if (answer.object >= 0 && meant(meetings, answer, unsure) == nullptr)
        return false;
    return std::none_of(meetings.begin(), meetings.end(), [&](const Meeting& meeting) {
        if (!meeting.exists || unsure(meeting))
            return false;
        if (answer.object < 0)
            return true;
        const double allowed = slack * meeting.condition + 8.0 * roundoff_;
        return static_cast<double>(meeting.t) * (1.0 + allowed) < answer.t;
    });
}

void Judge::judge(const StressRay& ray, std::span<const Meeting> meetings, const Answer& answer)
{
    const double band = undecidable_band * roundoff_;
    ++errors_.rays;
    const auto unsure = unsure_within(band, band);
    const bool undecidable = std::any_of(meetings.begin(), meetings.end(), unsure);
    errors_.undecidable += undecidable;
    if (!right(meetings, answer, roundoff_))
        ++errors_.wrong;
    else if (undecidable && !right(meetings, answer, std::min(roundoff_, 0x1p-53)))
        ++errors_.wrong_in_band;
    if (answer.object < 0)
        return;
    ++errors_.hits;
    if (!finite(answer)) {
        ++errors_.not_finite;
        return;
    }
    const Meeting* meeting = meant(meetings, answer, unsure);
    if (meeting != nullptr && meeting->exists && !unsure(*meeting))
        measure(ray, *meeting, answer);
}

void Judge::measure(const StressRay& ray, const Meeting& meeting, const Answer& answer)
{
    const double t = static_cast<double>(meeting.t);
    const double error = std::abs(static_cast<double>(Wide(answer.t) - meeting.t));
    const double ulp = error / std::ldexp(2.0 * roundoff_, std::ilogb(t));
    errors_.ulp.push_back(static_cast<float>(ulp));
    errors_.rho = std::max(errors_.rho, error / (t * meeting.condition * roundoff_));
    if (meeting.condition < 1e3)
        errors_.relative = std::max(errors_.relative, error / t);
    if (meeting.condition < 1e8)
        errors_.beyond = std::max(errors_.beyond, ulp);

    const WideVec P = wide(ray.org) + Wide(answer.t) * wide(ray.dir);
    const auto& surface =
        *std::find_if(surfaces_.begin(), surfaces_.end(),
                      [&](const WideSurface& one) { return one.object == answer.object; });
    errors_.distance =
        std::max(errors_.distance, distance_to(surface, P) / (roundoff_ * largest(P)));
    const WideVec off = wide(answer.normal) - meeting.normal;
    errors_.normal = std::max(errors_.normal, largest(off));
}

}  // namespace packtrace::study
