#pragma once

#include "lab/harness/report_variants.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/truth/truth.hpp"
#include <packtrace/report.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace packtrace {

/// One study of a scene: its variants, and the samples per pixel of its truth.
struct StudyPlan {
    Study study = Study::arithmetic;
    std::vector<Variant> variants;
    int truth_samples = 1;
};

/// All studies of a report, in order. Throws std::invalid_argument if the truth does not have more
/// samples than its runs.
[[nodiscard]] std::vector<StudyPlan> plan_studies(const Scene& scene, const ReportOptions& options);

/// The scene of the truth: without a min_weight, so that all rays are traced.
[[nodiscard]] Scene scene_of_truth(const Scene& scene);

/// A run without its times, and its picture.
struct StudyLook {
    ReportRun run;
    Image<double> picture;
};

/// Compares pictures with one study's truth. `truth` and `options` must outlive this.
class StudyErrors {
public:
    StudyErrors(const Scene& scene_of_truth, Study study, const Truth& truth,
                const ReportOptions& options);
    ~StudyErrors();

    /// Renders a frame of the subject; the error is not set.
    [[nodiscard]] static StudyLook render(const Subject& subject);
    /// Sets the error and the reasons for it.
    void measure(const Subject& subject, StudyLook& look) const;

private:
    class Classifier;

    Study study_;
    const Truth& truth_;
    const ReportOptions& options_;
    std::unique_ptr<Classifier> classifier_;
};

/// A report of one study, without runs.
[[nodiscard]] StudyReport study_report(Study study, const Truth& truth);

/// Adds a run. Runs with equal pictures share the error of the first; `measure` is called only for
/// a new picture.
void add_run(StudyReport& report, StudyLook look,
             const std::function<void(StudyLook& look)>& measure);

/// Seconds of each subject, by repetition, measured by turns. Each subject must have rendered a
/// frame before.
[[nodiscard]] std::vector<std::vector<double>> times_of(const std::vector<Subject>& subjects,
                                                        const ReportOptions& options);

/// Sets the times of a report's runs, and which runs are on the Pareto front.
void set_times(StudyReport& report, std::vector<std::vector<double>> seconds);

/// All of these steps.
[[nodiscard]] StudyReport run_study(const Scene& scene_of_truth, Study study, const Truth& truth,
                                    const std::vector<Subject>& subjects,
                                    const ReportOptions& options);

// report_choice.cpp: which runs to choose. Times differ only if their middle halves do not overlap.

/// The middle half of a run's times, in seconds; the median if there are no single times.
[[nodiscard]] Interval middle_times(const ReportRun& run);

/// Whether the middle halves of both runs' times do not overlap, and that of `run` is the lower.
/// False for a run with one time.
[[nodiscard]] bool surely_faster(const ReportRun& run, const ReportRun& other);

/// Sets each run's standing: on the Pareto front, beaten, or undecided.
void mark_pareto(std::vector<ReportRun>& runs);

}  // namespace packtrace
