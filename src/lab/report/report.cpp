#include <packtrace/report.hpp>

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

}  // namespace

SceneReport report(const ReportScene& scene, const ReportOptions& options)
{
    const std::vector<StudyPlan> plans = plan_studies(scene.scene, options);
    SceneReport result;
    result.name = scene.name;
    result.width = scene.scene.width;
    result.height = scene.scene.height;
    const Scene whole = scene_of_truth(scene.scene);
    const Truth one = truth_of(whole, 1, options);
    const Truth many = truth_of(whole, options.truth_samples, options);
    for (const StudyPlan& plan : plans) {
        std::vector<Subject> subjects;
        for (const Variant& variant : plan.variants)
            subjects.push_back(subject_of(scene.scene, variant));
        const Truth& truth = plan.truth_samples > 1 ? many : one;
        result.studies.push_back(run_study(whole, plan.study, truth, subjects, options));
    }
    return result;
}

}  // namespace packtrace
