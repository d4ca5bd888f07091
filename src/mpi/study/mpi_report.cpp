#include "cli/interrupts.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/study/report_command.hpp"
#include "core/seconds_since.hpp"
#include "lab/harness/stopwatch.hpp"
#include "lab/truth/truth.hpp"
#include "mpi/commands.hpp"
#include "mpi/study/study_wire.hpp"
#include <packtrace/write_report.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace packtrace::mpi {
namespace {

using ReportJobArguments = cli::ReportArguments;

/// A scene of the report, and its data on this rank.
struct SceneWork {
    ReportScene scene;
    Scene whole;  ///< the scene for truths
    std::vector<StudyPlan> plans;
    Truth one;   ///< with one sample per pixel
    Truth many;  ///< with ReportOptions::truth_samples per pixel

    [[nodiscard]] const Truth& truth_of(const StudyPlan& plan) const
    {
        return plan.truth_samples > 1 ? many : one;
    }
};

/// The stages of a report. All ranks must call each of them.
class ReportJob {
public:
    ReportJob(const World& world, const ReportJobArguments& arguments, const ReportOptions& options,
              std::vector<SceneWork>& works)
        : world_(world), arguments_(arguments), options_(options), works_(works)
    {
    }

    /// Computes the truths of each scene. Ranks share their rows.
    void find_truths();
    /// Makes all runs on rank 0, without their times. Returns the work of each rank.
    std::vector<RankReport> make_looks();
    /// Measures the times of rank 0's runs. One rank per node measures whole studies, while the
    /// node's other ranks sleep.
    void take_times();

    /// The reports. Complete on rank 0 only.
    [[nodiscard]] std::vector<SceneReport>& reports()
    {
        return reports_;
    }

private:
    /// A truth to compute.
    struct Asked {
        SceneWork& work;
        TruthRequest request;
        Truth& truth;
    };
    /// Some rows of a truth.
    struct Rows {
        std::size_t truth;
        int first;
        int count;
    };
    /// A run of a study of a scene.
    struct Run {
        std::size_t scene;
        std::size_t study;
        std::size_t variant;
    };

    [[nodiscard]] std::vector<Asked> asked_truths();
    void trace_truths(const std::vector<Asked>& asked, const std::vector<int>& missing);
    void send_truth(Truth& truth);
    void add_look(const Run& run, const Piece& piece);
    [[nodiscard]] std::vector<std::vector<double>> times_of_study(const SceneWork& work,
                                                                  const StudyPlan& plan) const;
    [[nodiscard]] cli::ProgressBar bar() const
    {
        return cli::ProgressBar(arguments_.quiet || !world_.is_first() ? cli::Verbosity::quiet
                                                                       : cli::Verbosity::normal);
    }

    const World& world_;
    const ReportJobArguments& arguments_;
    const ReportOptions& options_;
    std::vector<SceneWork>& works_;
    std::vector<SceneReport> reports_;
};

std::vector<ReportJob::Asked> ReportJob::asked_truths()
{
    std::vector<Asked> asked;
    for (SceneWork& work : works_) {
        TruthRequest request{.cache = options_.cache};
        asked.push_back({work, request, work.one});
        request.samples = options_.truth_samples;
        asked.push_back({work, request, work.many});
    }
    return asked;
}

void ReportJob::find_truths()
{
    const std::vector<Asked> asked = asked_truths();
    std::vector<int> missing;
    world_.together([&] {
        for (std::size_t i = 0; i < asked.size() && world_.is_first(); ++i)
            if (std::optional<Truth> kept = kept_truth(asked[i].work.whole, asked[i].request))
                asked[i].truth = std::move(*kept);
            else
                missing.push_back(static_cast<int>(i));
    });
    world_.broadcast(missing);
    trace_truths(asked, missing);
    for (const Asked& one : asked)
        send_truth(one.truth);
}

void ReportJob::trace_truths(const std::vector<Asked>& asked, const std::vector<int>& missing)
{
    constexpr int rows_at_once = 8;
    std::vector<Rows> pieces;
    for (const int truth : missing) {
        const int height = asked[static_cast<std::size_t>(truth)].work.whole.height;
        for (int first = 0; first < height; first += rows_at_once)
            pieces.push_back(
                {static_cast<std::size_t>(truth), first, std::min(rows_at_once, height - first)});
    }
    const auto make = [&](int number, RankReport&) {
        const Rows& rows = pieces[static_cast<std::size_t>(number)];
        const Asked& one = asked[rows.truth];
        Image<double> image;
        const double seconds = seconds_of(0, [&] {
            image = truth_rows(one.work.whole, one.request.samples, rows.first, rows.count);
        });
        return piece_of(seconds, image);
    };
    cli::ProgressBar progress = bar();
    const auto take = [&](const Piece& piece) {
        const Rows& rows = pieces[static_cast<std::size_t>(piece.number)];
        const Asked& one = asked[rows.truth];
        double seconds = 0.0;
        Image<double> image;
        WireReader wire(piece.bytes);
        wire(seconds, image);
        if (rows.first == 0)
            one.truth.image = Image<double>(one.work.whole.width, one.work.whole.height);
        std::copy(image.rgb.begin(), image.rgb.end(), one.truth.image.pixel(0, rows.first));
        one.truth.seconds += seconds;
        if (rows.first + rows.count == one.work.whole.height)
            keep_truth(one.work.whole, one.request, one.truth);
        progress.update((piece.number + 1.0) / static_cast<double>(pieces.size()));
    };
    const int count = static_cast<int>(pieces.size());
    Job job(world_, count, count);
    (void)job.run(make, take);
}

/// Sends a truth from rank 0 to all ranks.
void ReportJob::send_truth(Truth& truth)
{
    WireWriter message;
    if (world_.is_first())
        message(truth.what, truth.seconds, truth.cached, truth.image);
    world_.broadcast(message.bytes);
    if (world_.is_first())
        return;
    WireReader wire(message.bytes);
    wire(truth.what, truth.seconds, truth.cached, truth.image);
}

std::vector<RankReport> ReportJob::make_looks()
{
    std::vector<Run> runs;
    for (std::size_t scene = 0; scene < works_.size(); ++scene)
        for (std::size_t study = 0; study < works_[scene].plans.size(); ++study)
            for (std::size_t i = 0; i < works_[scene].plans[study].variants.size(); ++i)
                runs.push_back({scene, study, i});

    // The study that this rank works on.
    Run at{works_.size(), 0, 0};
    std::unique_ptr<StudyErrors> errors;
    const auto make = [&](int number, RankReport& report) {
        const Run& run = runs[static_cast<std::size_t>(number)];
        const SceneWork& work = works_[run.scene];
        const StudyPlan& plan = work.plans[run.study];
        if (run.scene != at.scene || run.study != at.study) {
            errors = std::make_unique<StudyErrors>(work.whole, plan.study, work.truth_of(plan),
                                                   options_);
            at = run;
        }
        const Subject subject = subject_of(work.scene.scene, plan.variants[run.variant]);
        StudyLook look = StudyErrors::render(subject);
        errors->measure(subject, look);
        report.rays += look.run.rays;
        return piece_of(look);
    };
    cli::ProgressBar progress = bar();
    const int count = static_cast<int>(runs.size());
    Job job(world_, count, count);
    return job.run(make, [&](const Piece& piece) {
        add_look(runs[static_cast<std::size_t>(piece.number)], piece);
        progress.update((piece.number + 1.0) / count);
    });
}

/// Runs arrive in order, so a scene's first run begins its report.
void ReportJob::add_look(const Run& run, const Piece& piece)
{
    const SceneWork& work = works_[run.scene];
    const StudyPlan& plan = work.plans[run.study];
    if (run.study == 0 && run.variant == 0)
        reports_.push_back({work.scene.name, work.scene.scene.width, work.scene.scene.height, {}});
    if (run.variant == 0)
        reports_.back().studies.push_back(study_report(plan.study, work.truth_of(plan)));
    StudyLook look;
    WireReader wire(piece.bytes);
    wire(look);
    look.run.variant = plan.variants[run.variant];
    add_run(reports_.back().studies.back(), std::move(look), [](StudyLook&) {});
}

std::vector<std::vector<double>> ReportJob::times_of_study(const SceneWork& work,
                                                           const StudyPlan& plan) const
{
    std::vector<Subject> subjects;
    for (const Variant& variant : plan.variants) {
        subjects.push_back(subject_of(work.scene.scene, variant));
        subjects.back().render();
    }
    return times_of(subjects, options_);
}

void ReportJob::take_times()
{
    // Studies are assigned beforehand, because MPI must not be called during measurements.
    const std::vector<int> leaders = world_.node_leaders();
    std::vector<std::size_t> owners;
    std::string own;
    world_.together([&] {
        WireWriter wire;
        std::size_t turn = 0;
        for (const SceneWork& work : works_)
            for (const StudyPlan& plan : work.plans) {
                const int owner = leaders[turn++ % leaders.size()];
                owners.push_back(static_cast<std::size_t>(owner));
                if (owner == world_.rank())
                    wire(times_of_study(work, plan));
            }
        own.assign(wire.bytes.begin(), wire.bytes.end());
    });
    const std::vector<std::string> all = world_.gather(own);
    if (!world_.is_first())
        return;
    std::vector<WireReader> wires(all.begin(), all.end());
    std::size_t turn = 0;
    for (SceneReport& scene : reports_)
        for (StudyReport& study : scene.studies) {
            std::vector<std::vector<double>> seconds;
            wires[owners[turn++]](seconds);
            set_times(study, std::move(seconds));
        }
}

std::vector<SceneWork> read_works(const World& world, const ReportJobArguments& arguments,
                                  const ReportOptions& options)
{
    world.together([&] {
        if (std::count(arguments.scenes.begin(), arguments.scenes.end(), "-") > 1)
            cli::fail_read_already();
    });
    std::vector<SceneWork> works;
    std::set<std::string> taken;
    for (const std::string& file : arguments.scenes) {
        SceneWork work;
        work.scene.scene = shared_scene(world, file);
        world.together([&] {
            work.scene.name =
                cli::free_scene_name(report_folder_name(shared_scene_stem(file)), taken);
            apply(arguments.picture, work.scene.scene);
            work.plans = plan_studies(work.scene.scene, options);
            work.whole = scene_of_truth(work.scene.scene);
        });
        works.push_back(std::move(work));
    }
    return works;
}

void run_report_on_ranks(const World& world, const ReportJobArguments& arguments)
{
    const auto start = std::chrono::steady_clock::now();
    ReportOptions options;
    world.together([&] { options = cli::report_options(arguments); });
    check_same_isas(world, options.isas);
    std::vector<SceneWork> works = read_works(world, arguments, options);
    // Check before the work, so that a wrong name costs no time.
    world.together([&] {
        if (world.is_first())
            cli::check_report_target(arguments);
    });
    if (world.is_first())
        cli::set_interrupt_line(
            "the job ended before the report was written; start it again (truths "
            "that were found are kept)");
    cli::limit_threads(cli::report_threads(options), 2);
    ReportJob job(world, arguments, options, works);
    job.find_truths();
    const std::vector<RankReport> reports = job.make_looks();
    job.take_times();
    world.together([&] {
        if (!world.is_first())
            return;
        for (const SceneReport& scene : job.reports())
            cli::print_judgement(scene, options);
        cli::write_whole_report(job.reports(), options, arguments);
    });
    cli::set_interrupt_line("");
    print_report(world, {.output = arguments.folder.string(),
                         .pieces = "runs",
                         .ranks = reports,
                         .seconds = seconds_since(start),
                         .quiet = arguments.quiet});
}

}  // namespace

void add_report(CLI::App& app, const World& world)
{
    CLI::App* command = app.add_subcommand(
        "report", "Render scenes in many ways on all ranks; report errors against run times");
    const auto arguments = std::make_shared<ReportJobArguments>();
    cli::add_report_options(*command, *arguments);
    command->callback([arguments, command, &world] {
        arguments->command = cli::report_command("packtrace-mpi", *command, *arguments);
        run_report_on_ranks(world, *arguments);
    });
}

}  // namespace packtrace::mpi
