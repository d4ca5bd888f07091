#pragma once

#include "lab/harness/report_variants.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/truth/truth.hpp"
#include <packtrace/report.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace packtrace {

/// One study of a scene: the ways it is rendered, and the samples a pixel of its truth.
struct StudyPlan {
    Study study = Study::arithmetic;
    std::vector<Variant> variants;
    int truth_samples = 1;
};

/// All studies of a report, in their order. Throws std::invalid_argument for a truth of no more
/// samples than its runs.
[[nodiscard]] std::vector<StudyPlan> plan_studies(const Scene& scene, const ReportOptions& options);

/// The scene that truths are pictures of: they trace all rays.
[[nodiscard]] Scene scene_of_truth(const Scene& scene);

/// A run without its times.
struct StudyLook {
    ReportRun run;
    Image<double> picture;
};

/// Holds pictures against one study's truth. Both outlive it.
class StudyErrors {
public:
    StudyErrors(const Scene& scene_of_truth, Study study, const Truth& truth,
                const ReportOptions& options);
    ~StudyErrors();

    /// A frame of the subject, with its rays, but not its error.
    [[nodiscard]] static StudyLook render(const Subject& subject);
    /// Adds the error, and where it sits.
    void measure(const Subject& subject, StudyLook& look) const;

private:
    class Classifier;

    Study study_;
    const Truth& truth_;
    const ReportOptions& options_;
    std::unique_ptr<Classifier> classifier_;
};

/// A report of one study, which has no runs yet.
[[nodiscard]] StudyReport study_report(Study study, const Truth& truth);

/// Adds a run. Runs of equal pictures share the error of the first; `measure` is called for a new
/// picture alone.
void add_run(StudyReport& report, StudyLook look,
             const std::function<void(StudyLook& look)>& measure);

/// Seconds of each subject, by repetition, taken in turns. Each has rendered a frame before.
[[nodiscard]] std::vector<std::vector<double>> times_of(const std::vector<Subject>& subjects,
                                                        const ReportOptions& options);

/// Gives the runs of a report their times, and says which to take.
void set_times(StudyReport& report, std::vector<std::vector<double>> seconds);

/// All of these steps, one after the other.
[[nodiscard]] StudyReport run_study(const Scene& scene_of_truth, Study study, const Truth& truth,
                                    const std::vector<Subject>& subjects,
                                    const ReportOptions& options);

// report_choice.cpp: which runs to take, by their times as far as these can be told apart.

/// The middle half of a run's times, seconds; its median where there are none.
[[nodiscard]] Interval middle_times(const ReportRun& run);

/// Whether the middle halves of their times do not overlap, and that of `run` is the lower; of one
/// time each that can't be told.
[[nodiscard]] bool surely_faster(const ReportRun& run, const ReportRun& other);

/// Sets each run's standing among the others.
void mark_pareto(std::vector<ReportRun>& runs);

}  // namespace packtrace
