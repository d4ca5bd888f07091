#include <packtrace/report.hpp>

#include <algorithm>
#include <stdexcept>

#include "lab/report/report_study.hpp"

namespace packtrace {
namespace {

Truth truth_of(const Scene& scene, int samples, const ReportOptions& options)
{
    TruthRequest request;
    request.samples = samples;
    request.cache = options.cache;
    if (options.progress)
        request.progress = [&](double share) { options.progress("truth", share); };
    return find_truth(scene, request);
}

// A run with the samples of the truth would seem to have no error.
void check_truth(const ReportOptions& options)
{
    int most = 0;
    for (const int samples : options.samples)
        most = std::max(most, samples);
    for (const auto& [samples, contrast] : options.adaptive)
        most = std::max(most, samples);
    if (options.truth_samples <= most)
        throw std::invalid_argument("report: a truth of " + std::to_string(options.truth_samples) +
                                    " samples a pixel cannot judge runs of " +
                                    std::to_string(most) + "; give it more");
}

}  // namespace

SceneReport report(const ReportScene& scene, const ReportOptions& options)
{
    check_truth(options);
    SceneReport result;
    result.name = scene.name;
    result.width = scene.scene.width;
    result.height = scene.scene.height;
    const std::vector<Variant> variants = report_variants(scene.scene, options);
    // A truth traces all rays.
    Scene whole = scene.scene;
    whole.min_weight = 0.0;
    const Truth one = truth_of(whole, 1, options);
    const Truth many = truth_of(whole, options.truth_samples, options);
    for (const Study study : {Study::arithmetic, Study::depth, Study::weight, Study::sampling}) {
        std::vector<Subject> subjects;
        for (const Variant& variant : variants)
            if (variant.study == study)
                subjects.push_back(subject_of(scene.scene, variant));
        const Truth& truth = study == Study::sampling ? many : one;
        result.studies.push_back(run_study(whole, study, truth, subjects, options));
    }
    return result;
}

}  // namespace packtrace
