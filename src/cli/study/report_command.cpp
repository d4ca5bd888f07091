#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include <packtrace/write_report.hpp>

#include "cli/command.hpp"
#include "cli/options/scene_input.hpp"
#include "cli/options/thread_limit.hpp"
#include "cli/output/progress_bar.hpp"
#include "cli/study/report_arguments.hpp"

namespace packtrace::cli {
namespace {

std::vector<ReportScene> read_scenes(const ReportArguments& arguments)
{
    std::vector<ReportScene> scenes;
    std::set<std::string> taken;
    for (const std::string& file : arguments.scenes) {
        SceneInput input = read_scene_input(file);
        ReportScene scene{free_scene_name(report_folder_name(input.stem), taken),
                          std::move(input.scene)};
        apply(arguments.picture, scene.scene);
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

// A bar for each step of the work.
class StepBar {
public:
    explicit StepBar(Verbosity verbosity) : verbosity_(verbosity)
    {
    }
    void update(const std::string& step, double share)
    {
        const std::lock_guard lock(mutex_);
        if (step != step_) {
            bar_.reset();
            bar_ = std::make_unique<ProgressBar>(verbosity_);
            step_ = step;
        }
        bar_->update(share);
    }

private:
    Verbosity verbosity_;
    std::mutex mutex_;
    std::string step_;
    std::unique_ptr<ProgressBar> bar_;
};

SceneReport report_scene(const ReportScene& scene, ReportOptions options,
                         const ReportArguments& arguments)
{
    StepBar bar(arguments.quiet ? Verbosity::quiet : Verbosity::normal);
    options.progress = [&bar](const std::string& step, double share) { bar.update(step, share); };
    return report(scene, options);
}

void run_report(const ReportArguments& arguments)
{
    const ReportOptions options = report_options(arguments);
    const std::vector<ReportScene> scenes = read_scenes(arguments);
    // Before the work, so that a wrong name doesn't cost it.
    check_report_target(arguments);
    // The runs have arenas of their own sizes.
    const ThreadLimit limit(report_threads(options));
    std::vector<SceneReport> reports;
    for (const ReportScene& scene : scenes) {
        reports.push_back(report_scene(scene, options, arguments));
        print_judgement(reports.back(), options);
    }
    write_whole_report(reports, options, arguments);
}

}  // namespace

void add_report(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "report", "Render scenes in many ways; report each way's error against its run time");
    const auto arguments = std::make_shared<ReportArguments>();
    add_report_options(*command, *arguments);
    command->callback([arguments, command] {
        arguments->command = report_command("packtrace", *command, *arguments);
        run_report(*arguments);
    });
}

}  // namespace packtrace::cli
