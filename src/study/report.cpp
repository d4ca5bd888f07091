#include <packtrace/report.hpp>

#include "study/report_study.hpp"

namespace packtrace {
namespace {

Truth truth_of(const ReportScene& scene, Study study, const ReportOptions& options)
{
    TruthRequest request;
    request.text = scene.text;
    request.samples = study == Study::sampling ? options.truth_samples : 1;
    request.cache = options.cache;
    if (options.progress)
        request.progress = [&](double share) { options.progress("truth", share); };
    return find_truth(scene.scene, request);
}

}  // namespace

SceneReport report(const ReportScene& scene, const ReportOptions& options)
{
    SceneReport result;
    result.name = scene.name;
    result.width = scene.scene.width;
    result.height = scene.scene.height;
    const std::vector<Variant> variants = report_variants(scene.scene, options);
    for (const Study study : {Study::arithmetic, Study::depth, Study::sampling}) {
        std::vector<Subject> subjects;
        for (const Variant& variant : variants)
            if (variant.study == study)
                subjects.push_back(subject_of(scene.scene, variant));
        const Truth truth = truth_of(scene, study, options);
        result.studies.push_back(run_study(scene.scene, study, truth, subjects, options));
    }
    return result;
}

}  // namespace packtrace
