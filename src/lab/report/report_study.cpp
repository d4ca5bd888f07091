#include "lab/report/report_study.hpp"

#include "core/check_number.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/harness/stopwatch.hpp"
#include "lab/report/error_class.hpp"
#include "render/check_options.hpp"
#include "scene/sample_pattern.hpp"
#include <packtrace/stop.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace packtrace {
namespace {

// Samples of a pixel whose trees represent the whole pixel.
constexpr int looked_at_samples = 16;

std::string file_name_of(const std::string& name)
{
    std::string result;
    for (const char c : name)
        if (c != ',')
            result += c == ' ' ? '_' : c;
    return result;
}

// The first run with a picture; null if there is none.
const ReportRun* same_picture(const StudyReport& report, std::size_t picture)
{
    for (const ReportRun& run : report.runs)
        if (run.picture == picture)
            return &run;
    return nullptr;
}

// A run with as many samples as the truth would seem to have no error.
void check_truth(const ReportOptions& options)
{
    check_number("truth_samples", options.truth_samples, 2, most_samples);
    int most = 0;
    for (const int samples : options.samples)
        most = std::max(most, samples);
    for (const auto& [samples, contrast] : options.adaptive)
        most = std::max(most, samples);
    if (options.truth_samples <= most)
        throw std::invalid_argument(
            "report: a truth of " + std::to_string(options.truth_samples) +
            " samples a pixel (truth_samples, --truth-spp) cannot judge runs of " +
            std::to_string(most) + " (samples, adaptive); give it more");
}

void stop_if_asked(const ReportOptions& options)
{
    if (options.stop.stop_requested())
        throw StopError("the report was stopped");
}

Truth truth_of(const Scene& scene, int samples, const ReportOptions& options)
{
    TruthRequest request{.samples = samples, .cache = options.cache, .stop = options.stop};
    if (options.progress)
        request.progress = [&](double share) { options.progress("truth", share); };
    return find_truth(scene, request);
}

}  // namespace

std::vector<StudyPlan> plan_studies(const Scene& scene, const ReportOptions& options)
{
    check_truth(options);
    check_number("repetitions", options.repetitions, 1, most_repetitions);
    check_number("classified", options.classified, 0, std::numeric_limits<int>::max());
    check_not_negative("threshold", options.threshold);
    const std::vector<Variant> variants = report_variants(scene, options);
    std::vector<StudyPlan> plans;
    for (const Study study : {Study::arithmetic, Study::depth, Study::weight, Study::sampling}) {
        StudyPlan plan{study, {}, study == Study::sampling ? options.truth_samples : 1};
        for (const Variant& variant : variants)
            if (variant.study == study)
                plan.variants.push_back(variant);
        plans.push_back(std::move(plan));
    }
    return plans;
}

Scene scene_of_truth(const Scene& scene)
{
    Scene whole = scene;
    whole.min_weight = 0.0;
    return whole;
}

// Classifies the errors of pixels by their ray trees.
class StudyErrors::Classifier {
public:
    Classifier(const Scene& scene, Study study)
        : classifier_(scene),
          sampling_(study == Study::sampling),
          truth_(reference_trees<double>(scene)),
          samples_(reference_sample_trees(scene, sample_pattern(looked_at_samples)))
    {
    }

    [[nodiscard]] ClassOfPixel for_tree(const TreeOfPixel& tree) const
    {
        if (sampling_)
            return [this](int x, int y) { return class_of_samples(x, y); };
        return
            [this, tree](int x, int y) { return classifier_.classify(truth_(x, y), tree(x, y)); };
    }

private:
    // The largest difference between the pixel's first sample and another one.
    [[nodiscard]] std::optional<ClassifiedError> class_of_samples(int x, int y) const
    {
        const std::vector<RayNode> trees = samples_(x, y);
        std::optional<ClassifiedError> worst;
        for (const RayNode& tree : trees) {
            const auto found = classifier_.classify(trees.front(), tree);
            if (found && (!worst || found->effect > worst->effect))
                worst = found;
        }
        return worst;
    }

    ErrorClassifier classifier_;
    bool sampling_;
    TreeOfPixel truth_;
    TreesOfPixel samples_;
};

StudyErrors::StudyErrors(const Scene& scene_of_truth, Study study, const Truth& truth,
                         const ReportOptions& options)
    : study_(study),
      truth_(truth),
      options_(options),
      classifier_(std::make_unique<Classifier>(scene_of_truth, study))
{
}

StudyErrors::~StudyErrors() = default;

StudyLook StudyErrors::render(const Subject& subject)
{
    StudyLook look;
    look.run.variant = subject.variant;
    subject.render();
    look.run.rays = subject.rays();
    look.run.cut = subject.cut();
    look.picture = subject.picture();
    return look;
}

void StudyErrors::measure(const Subject& subject, StudyLook& look) const
{
    look.run.error = compare(look.picture, truth_.image, {.threshold = options_.threshold});
    if (study_ == Study::sampling || subject.tree)
        find_shares(look.run, truth_.image, look.picture, options_,
                    classifier_->for_tree(subject.tree));
}

StudyReport study_report(Study study, const Truth& truth)
{
    StudyReport report;
    report.study = study;
    report.truth = truth.what;
    report.truth_seconds = truth.seconds;
    report.truth_cached = truth.cached;
    report.pictures.push_back({"truth", "truth", truth.image});
    return report;
}

void add_run(StudyReport& report, StudyLook look,
             const std::function<void(StudyLook& look)>& measure)
{
    const auto known =
        std::find_if(report.pictures.begin(), report.pictures.end(),
                     [&](const auto& other) { return other.image.rgb == look.picture.rgb; });
    look.run.picture = static_cast<std::size_t>(known - report.pictures.begin());
    if (const ReportRun* twin = same_picture(report, look.run.picture)) {
        look.run.error = twin->error;
        look.run.shares = twin->shares;
        look.run.looked_at = twin->looked_at;
        look.run.looked_at_off = twin->looked_at_off;
    } else {
        measure(look);
    }
    const std::string& name = look.run.variant.name;
    if (known == report.pictures.end())
        report.pictures.push_back({file_name_of(name), name, std::move(look.picture)});
    report.runs.push_back(std::move(look.run));
}

std::vector<std::vector<double>> times_of(const std::vector<Subject>& subjects,
                                          const ReportOptions& options)
{
    const auto total =
        static_cast<double>(options.repetitions) * static_cast<double>(subjects.size());
    double done = 0.0;
    return time_in_turns(subjects.size(), options.repetitions, [&](std::size_t i) {
        stop_if_asked(options);
        if (options.progress)
            options.progress("timing", done++ / total);
        return seconds_of(subjects[i].variant.threads, subjects[i].render);
    });
}

void set_times(StudyReport& report, std::vector<std::vector<double>> seconds)
{
    for (std::size_t i = 0; i < report.runs.size(); ++i) {
        ReportRun& run = report.runs[i];
        run.seconds = std::move(seconds[i]);
        run.median = median_of(run.seconds);
        run.spread = relative_spread(run.seconds);
    }
    mark_pareto(report.runs);
}

StudyReport run_study(const Scene& scene_of_truth, Study study, const Truth& truth,
                      const std::vector<Subject>& subjects, const ReportOptions& options)
{
    StudyReport report = study_report(study, truth);
    const StudyErrors errors(scene_of_truth, study, truth, options);
    // The first frame gives the picture, and allocates memory that later ones reuse.
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        stop_if_asked(options);
        add_run(report, StudyErrors::render(subjects[i]),
                [&](StudyLook& look) { errors.measure(subjects[i], look); });
        if (options.progress)
            options.progress("comparing",
                             static_cast<double>(i + 1) / static_cast<double>(subjects.size()));
    }
    set_times(report, times_of(subjects, options));
    return report;
}

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
