#include "lab/report/report_study.hpp"

#include <algorithm>
#include <utility>

#include "lab/harness/statistics.hpp"
#include "lab/harness/stopwatch.hpp"
#include "lab/report/error_shares.hpp"
#include "lab/report/report_choice.hpp"
#include "scene/sample_pattern.hpp"

namespace packtrace {
namespace {

// Samples of a pixel whose trees stand for all it shows.
constexpr int looked_at_samples = 16;

std::string file_name_of(const std::string& name)
{
    std::string result;
    for (const char c : name)
        if (c != ',')
            result += c == ' ' ? '_' : c;
    return result;
}

void take_times(const std::vector<Subject>& subjects, const ReportOptions& options,
                std::vector<ReportRun>& runs)
{
    const auto total =
        static_cast<double>(options.repetitions) * static_cast<double>(subjects.size());
    double done = 0.0;
    auto seconds = time_in_turns(subjects.size(), options.repetitions, [&](std::size_t i) {
        if (options.progress)
            options.progress("timing", done++ / total);
        return seconds_of(subjects[i].variant.threads, subjects[i].render);
    });
    for (std::size_t i = 0; i < runs.size(); ++i) {
        runs[i].seconds = std::move(seconds[i]);
        runs[i].median = median_of(runs[i].seconds);
        runs[i].spread = relative_spread(runs[i].seconds);
    }
}

// The trees of a pixel, each asked for once.
class StudyClassifier {
public:
    StudyClassifier(const Scene& scene, Study study)
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
    // What sets the pixel's samples apart most from its first.
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

// The index of the picture among those there are, or that of a new one.
std::size_t keep_picture(StudyReport& report, const std::string& name, Image<double>&& image)
{
    for (std::size_t i = 0; i < report.pictures.size(); ++i)
        if (report.pictures[i].image.rgb == image.rgb)
            return i;
    report.pictures.push_back({file_name_of(name), name, std::move(image)});
    return report.pictures.size() - 1;
}

// Runs of equal pictures and trees are off for the same reasons.
const ReportRun* same_picture(const StudyReport& report, std::size_t picture)
{
    for (const ReportRun& run : report.runs)
        if (run.picture == picture)
            return &run;
    return nullptr;
}

void measure_error(StudyReport& report, ReportRun& run, const Subject& subject,
                   const StudyClassifier& classifier, const ReportOptions& options)
{
    run.picture = keep_picture(report, subject.variant.name, subject.picture());
    if (const ReportRun* twin = same_picture(report, run.picture)) {
        run.error = twin->error;
        run.shares = twin->shares;
        run.looked_at = twin->looked_at;
        run.looked_at_off = twin->looked_at_off;
        return;
    }
    const Image<double>& picture = report.pictures[run.picture].image;
    const Image<double>& truth = report.pictures.front().image;
    CompareOptions compared;
    compared.threshold = options.threshold;
    run.error = compare(picture, truth, compared);
    if (report.study == Study::sampling || subject.tree)
        find_shares(run, truth, picture, options, classifier.for_tree(subject.tree));
}

}  // namespace

StudyReport run_study(const Scene& scene, Study study, const Truth& truth,
                      const std::vector<Subject>& subjects, const ReportOptions& options)
{
    StudyReport report;
    report.study = study;
    report.truth = truth.what;
    report.truth_seconds = truth.seconds;
    report.truth_cached = truth.cached;
    report.pictures.push_back({"truth", "truth", truth.image});

    // A first frame pays for the memory that later ones reuse, and gives the picture.
    std::vector<ReportRun> runs(subjects.size());
    const StudyClassifier classifier(scene, study);
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        runs[i].variant = subjects[i].variant;
        subjects[i].render();
        runs[i].rays = subjects[i].rays();
        runs[i].cut = subjects[i].cut();
        measure_error(report, runs[i], subjects[i], classifier, options);
        report.runs.push_back(runs[i]);
        if (options.progress)
            options.progress("comparing",
                             static_cast<double>(i + 1) / static_cast<double>(subjects.size()));
    }
    take_times(subjects, options, report.runs);
    mark_pareto(report.runs);
    return report;
}

}  // namespace packtrace
