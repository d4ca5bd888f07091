// Error against run time: the runs, the measurements, the files.
#include "catch.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/report/plot_layout.hpp"
#include "lab/report/report_pictures.hpp"
#include "lab/report/report_study.hpp"
#include "lab/report/report_text.hpp"
#include "lab/truth/truth_cache.hpp"
#include "render_scene.hpp"
#include "scenes.hpp"
#include "temp_folder.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/report.hpp>
#include <packtrace/write_report.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace packtrace::test {
namespace {

ReportOptions short_options()
{
    return {.threads = {1},
            .isas = {choose_isa().name},
            .min_weights = {0.1, 0.0},
            .samples = {1, 4},
            .adaptive = {{4, 0.1}},
            .repetitions = 2,
            .truth_samples = 16,
            .classified = 8};
}

ReportScene small_scene()
{
    return {"small", four_spheres(48, 40)};
}

/// A run with a name, a time and an error.
ReportRun run_of(const std::string& name, double seconds, double rmse)
{
    ReportRun run;
    run.variant.name = name;
    run.median = seconds;
    run.error.rmse = rmse;
    return run;
}

/// A run with these times in seconds.
ReportRun timed_run(const std::string& name, const std::vector<double>& seconds, double rmse)
{
    ReportRun run = run_of(name, median_of(seconds), rmse);
    run.seconds = seconds;
    run.spread = relative_spread(seconds);
    return run;
}

/// Changes every value by less than a picture shows.
Truth other_picture(Truth truth)
{
    for (double& value : truth.image.rgb)
        value += 1e-9;
    return truth;
}

std::string names_of(const std::vector<const ReportRun*>& runs)
{
    std::string names;
    for (const ReportRun* run : runs)
        names += run->variant.name + ", ";
    return names;
}

/// A subject that renders the truth with every pixel off by `error`.
Subject constant_error(const Image<double>& truth, double error)
{
    Subject subject;
    subject.variant.name = "off by " + brief(error);
    subject.render = [] {};
    subject.rays = [] { return std::uint64_t{7}; };
    subject.cut = [] { return CutRays{}; };
    subject.picture = [truth, error] {
        Image<double> picture = truth;
        for (double& value : picture.rgb)
            value += error;
        return picture;
    };
    return subject;
}

}  // namespace

TEST_CASE("a report runs every kernel, precision, instruction set and number of threads",
          "[report]")
{
    const Scene scene = four_spheres(8, 8);
    const std::vector<Variant> variants = report_variants(scene, {});
    std::set<std::string> names;
    for (const Variant& variant : variants)
        CHECK(names.insert(variant.name).second);
    for (const std::string precision : {"single", "double"})
        for (const std::string threads : {", 1 thread", ", 2 threads"}) {
            CHECK(names.count("scalar " + precision + threads) == 1);
            for (const std::string& isa : supported_isas())
                CHECK(names.count("packets " + isa + " " + precision + threads) == 1);
        }
    for (const char* name : {"depth 0", "depth 1", "depth 2", "depth 3", "spp 1", "spp 4", "spp 16",
                             "spp 64", "adaptive 16 at 0.01"})
        CHECK(names.count(name) == 1);
    CHECK(names.count("depth 4") == 0);
    for (const char* mode : {"fast", "from 0.001", "general kernel"})
        CHECK(names.count("packets " + supported_isas().back() + " single " + mode +
                          ", 1 thread") == 1);
}

TEST_CASE("a report's errors are those of the pictures against the truth", "[report]")
{
    ReportScene scene = small_scene();
    // With 48 x 40 pixels, two rays run along tangents of a ball to the last digit, and rounding a
    // direction to single precision decides their hits.
    set_size(scene.scene, 47, 41);
    const SceneReport whole = report(scene, short_options());
    REQUIRE(whole.studies.size() == 4);
    const StudyReport& arithmetic = whole.studies.front();
    const RenderOptions scalar{.kernel = Kernel::scalar};
    const auto truth = convert<double>(render<long double>(scene.scene, scalar));
    CHECK((arithmetic.pictures.front().image.rgb == truth.rgb));
    for (const ReportRun& run : arithmetic.runs)
        if (run.variant.kernel == Kernel::packet && run.variant.precision == Precision::single) {
            const RenderOptions options{.isa = run.variant.isa,
                                        .accuracy = run.variant.accuracy,
                                        .self_hits = run.variant.self_hits};
            const auto picture = convert<double>(render<float>(scene.scene, options));
            CHECK(run.error.rmse == compare(picture, truth).rmse);
            CHECK((arithmetic.pictures[run.picture].image.rgb == picture.rgb));
            CHECK(run.rays > 47 * 41);
        }
    const ReportRun& full_depth = whole.studies[1].runs.back();
    CHECK(full_depth.variant.depth == 3);
    CHECK(full_depth.error.rmse < 1e-3);
    CHECK(whole.studies[1].runs.front().error.rmse > 0.01);
}

TEST_CASE("the truth of sampling is the mean of many samples in each pixel", "[report]")
{
    const ReportScene scene = small_scene();
    const StudyReport sampling = report(scene, short_options()).studies.back();
    const RenderOptions many{.kernel = Kernel::scalar, .samples = 16};
    CHECK((sampling.pictures.front().image.rgb == render<double>(scene.scene, many).rgb));
    CHECK(sampling.truth == "scalar reference, double, 16 samples a pixel");
    CHECK(sampling.runs[1].error.rmse < sampling.runs[0].error.rmse);
}

TEST_CASE("a truth with no more samples than its runs have is refused", "[report]")
{
    ReportOptions options = short_options();
    options.truth_samples = 4;
    CHECK_THROWS_WITH(
        report(small_scene(), options),
        "report: a truth of 4 samples a pixel (truth_samples, --truth-spp) cannot judge runs of 4 "
        "(samples, adaptive); give it more");
}

TEST_CASE("each run is timed as often as asked, and its median is among these times", "[report]")
{
    for (const StudyReport& study : report(small_scene(), short_options()).studies)
        for (const ReportRun& run : study.runs) {
            REQUIRE(run.seconds.size() == 2);
            CHECK(run.seconds[0] > 0.0);
            CHECK(run.median >= std::min(run.seconds[0], run.seconds[1]));
            CHECK(run.median <= std::max(run.seconds[0], run.seconds[1]));
        }
}

TEST_CASE("quantiles lie between neighbours", "[report]")
{
    CHECK(quantile({3, 1, 2}, 0.5) == 2.0);
    CHECK(quantile({4, 1, 2, 3}, 0.5) == 2.5);
    CHECK(quantile({5}, 0.25) == 5.0);
    CHECK(quantile({0, 10}, 0.25) == 2.5);
    CHECK(relative_spread({1, 2, 3, 4, 5}) == Approx(2.0 / 3.0));
}

TEST_CASE("a report shows known errors unchanged", "[report]")
{
    const Scene scene = four_spheres(16, 16);
    const Truth truth = find_truth(scene, {});
    const ReportOptions options{.repetitions = 3};
    const StudyReport report =
        run_study(scene, Study::arithmetic, truth,
                  {constant_error(truth.image, 0.0), constant_error(truth.image, 0.25),
                   constant_error(truth.image, 0.25), constant_error(truth.image, 1e-3)},
                  options);
    CHECK(report.runs[0].error.rmse == 0.0);
    CHECK(report.runs[1].error.rmse == Approx(0.25));
    CHECK(report.runs[1].error.pixels_off == 256);
    CHECK(report.runs[3].error.pixels_off == 0);
    CHECK(report.runs[3].error.max_abs == Approx(1e-3));
    CHECK(report.runs[0].rays == 7);
    // The truth, one picture for the two equal ones, and the last.
    CHECK(report.pictures.size() == 3);
    CHECK(report.runs[0].picture == 0);
    CHECK(report.runs[1].picture == report.runs[2].picture);
}

TEST_CASE("the judgement names the cheapest and the most exact run", "[report]")
{
    StudyReport study;
    study.runs = {run_of("coarse", 0.001, 0.1), run_of("middle", 0.010, 0.01),
                  run_of("slow", 0.020, 0.01), run_of("fine", 0.100, 1e-6)};
    REQUIRE(cheapest_within(study, 0.05).run != nullptr);
    CHECK(cheapest_within(study, 0.05).run->variant.name == "middle");
    CHECK(cheapest_within(study, 0.05).undecided.empty());
    CHECK(cheapest_within(study, 1e-3).run->variant.name == "fine");
    CHECK(cheapest_within(study, 1e-9).run == nullptr);
    CHECK(most_exact_within(study, 0.05).run->variant.name == "middle");
    CHECK(most_exact_within(study, 1.0).run->variant.name == "fine");
    CHECK(most_exact_within(study, 1e-6).run == nullptr);
    const auto lines = judgement(study, {.max_error = 1e-9, .max_time = 0.05});
    CHECK(lines[0] == "Cheapest with an RMSE of at most 1e-09: none reaches it.");
    CHECK(lines[1] == "Most exact within 50 ms: middle (10 ms, RMSE 0.01).");
}

TEST_CASE("runs whose spreads overlap are undecided", "[report]")
{
    StudyReport study;
    study.runs = {
        timed_run("quick", {1.0, 1.1, 1.2}, 0.01), timed_run("as quick", {1.1, 1.2, 1.3}, 0.01),
        timed_run("slow", {3.0, 3.1, 3.2}, 0.01), timed_run("exact", {1.05, 1.5, 4.0}, 1e-6)};
    const RunChoice cheapest = cheapest_within(study, 0.05);
    REQUIRE(cheapest.run != nullptr);
    CHECK(cheapest.run->variant.name == "quick");
    CHECK(names_of(cheapest.undecided) == "as quick, ");
    CHECK(names_of(cheapest_within(study, 1e-5).undecided).empty());
    const ReportOptions options{.max_error = 0.05, .max_time = 2.0};
    CHECK(
        judgement(study, options)[0] ==
        "Cheapest with an RMSE of at most 0.05: undecided, as the spreads of their times overlap, "
        "between quick (1.1e+03 ms, RMSE 0.01); as quick (1.2e+03 ms, RMSE 0.01).");
    // Its times are on both sides of two seconds.
    CHECK(judgement(study, options)[1] ==
          "Most exact within 2e+03 ms: quick (1.1e+03 ms, RMSE 0.01); perhaps, as their times "
          "spread over that limit, exact (1.5e+03 ms, RMSE 1e-06).");
    CHECK(most_exact_within(study, 5.0).run->variant.name == "exact");
}

TEST_CASE("the Pareto front has the runs that no other run surely beats", "[report]")
{
    std::vector<ReportRun> runs = {
        timed_run("quick", {1.0, 1.1, 1.2}, 0.1), timed_run("middle", {2.0, 2.1, 2.2}, 0.01),
        timed_run("much as middle", {2.1, 2.2, 2.3}, 0.01),
        timed_run("slow", {5.0, 5.1, 5.2}, 0.01),
        timed_run("better and perhaps as quick", {5.1, 5.2, 5.3}, 0.001)};
    mark_pareto(runs);
    CHECK(runs[0].pareto == Pareto::on_front);
    CHECK(runs[1].pareto == Pareto::undecided);
    CHECK(runs[2].pareto == Pareto::undecided);
    CHECK(runs[3].pareto == Pareto::beaten);
    CHECK(runs[4].pareto == Pareto::on_front);
    // Runs of equal error and overlapping times are undecided; so are less exact runs that may be
    // equally fast.
    runs = {timed_run("coarse", {1.0, 1.1, 1.2}, 0.1), timed_run("fine", {1.1, 1.2, 1.3}, 0.01)};
    mark_pareto(runs);
    CHECK(runs[0].pareto == Pareto::undecided);
    CHECK(runs[1].pareto == Pareto::on_front);
}

TEST_CASE("a report's runs are sorted by their times", "[report]")
{
    const StudyReport study = report(small_scene(), short_options()).studies.front();
    for (const ReportRun& run : study.runs)
        for (const ReportRun& other : study.runs)
            if (surely_faster(other, run) && other.error.rmse <= run.error.rmse)
                CHECK(run.pareto == Pareto::beaten);
    CHECK(std::any_of(study.runs.begin(), study.runs.end(),
                      [](const ReportRun& run) { return run.pareto != Pareto::beaten; }));
}

TEST_CASE("labels of a plot overlap neither each other nor points", "[report]")
{
    const PixelBox area{80, 40, 700, 500};
    std::mt19937 random(5);
    // All along a line, as runs of one error are; then in a cluster.
    for (const double height : {1.0, 60.0}) {
        std::vector<LabelledPoint> points;
        for (int i = 0; i < 26; ++i)
            points.push_back({100.0 + 0.6 * static_cast<double>(random() % 1000),
                              250.0 + 0.001 * height * static_cast<double>(random() % 1000),
                              "avx512 general x1"});
        const std::vector<PixelBox> places = place_labels(points, area, 6.4, 14.0);
        REQUIRE(places.size() == points.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            CHECK(places[i].left >= area.left);
            CHECK(places[i].right <= area.right);
            CHECK(places[i].top >= area.top);
            CHECK(places[i].bottom <= area.bottom);
            for (std::size_t k = 0; k < places.size(); ++k) {
                CHECK((i == k || !overlap(places[i], places[k])));
                const PixelBox dot{points[k].x - 3, points[k].y - 3, points[k].x + 3,
                                   points[k].y + 3};
                CHECK_FALSE(overlap(places[i], dot));
            }
        }
    }
    // A label avoids its own error bar and those of others.
    const std::vector<PixelBox> barred =
        place_labels({{200, 200, "x1", 150, 400}, {300, 210, "x2"}}, area, 6.4, 14.0);
    for (const PixelBox& place : barred)
        CHECK_FALSE(overlap(place, {150, 198, 400, 202}));
    // A lone label is beside its point.
    const PixelBox alone = place_labels({{200, 200, "x1"}}, area, 6.4, 14.0).front();
    CHECK(alone.left > 200);
    CHECK(alone.left < 212);
    CHECK(alone.top == 193);
}

TEST_CASE("axes include all values between readable ticks", "[report]")
{
    const PlotAxis times = fine_axis({0.27, 0.41});
    CHECK(times.low < 0.27);
    CHECK(times.high > 0.41);
    CHECK(times.tics.size() >= 1);
    CHECK(fine_axis({5.0}).low < 5.0);
    CHECK(fine_axis({5.0}).high > 5.0);
    CHECK(fine_axis({0.01, 1e4}).tics.size() <= 10);
    const PlotAxis errors = decade_axis({0.0, 3e-7, 0.02});
    CHECK(errors.tics.front().name == "0");
    CHECK(errors.low < 1e-7);
    CHECK(errors.high >= 0.02);
    CHECK(decade_axis({0.0}).tics.size() >= 2);
    CHECK(decade_axis({1e-300, 1.0}).tics.size() <= 10);
    const double infinity = std::numeric_limits<double>::infinity();
    PlotAxis broken = decade_axis({3e-7, infinity});
    CHECK(broken.high >= 3e-7);
    CHECK(broken.high < 1.0);
    CHECK(broken.tics.back().name == "inf");
    broken.first_pixel = 500;
    broken.last_pixel = 100;
    CHECK(broken.pixel(infinity) == Approx(100));
    CHECK(decade_axis({infinity}).tics.size() >= 2);
    PlotAxis pixels = errors;
    pixels.first_pixel = 500;
    pixels.last_pixel = 100;
    CHECK(pixels.pixel(pixels.high) == Approx(100));
    CHECK(pixels.value(pixels.pixel(1e-3)) == Approx(1e-3));
    CHECK(pixels.pixel(0.0) == Approx(500));
}

TEST_CASE("menus name pictures in readable words", "[report]")
{
    StudyReport study;
    study.pictures = {{"truth", "truth", Image<double>(1, 1)},
                      {"a_1_thread", "a, 1 thread", Image<double>(1, 1)},
                      {"b", "b", Image<double>(1, 1)}};
    for (const auto& [name, picture] :
         {std::pair("a, 1 thread", 1), std::pair("a, 2 threads", 1), std::pair("b", 2)}) {
        study.runs.push_back(run_of(name, 1.0, 0.0));
        study.runs.back().picture = static_cast<std::size_t>(picture);
    }
    CHECK(picture_label(study, 0) == "truth");
    CHECK(picture_label(study, 1) == "a, 1 thread and 1 alike");
    CHECK(picture_label(study, 2) == "b");
    study.runs.back().picture = 0;
    CHECK(picture_label(study, 0) == "truth, as 1 run has it");
}

TEST_CASE("a heat map has a legend with the errors that its colours represent", "[report]")
{
    StudyReport study;
    study.pictures = {{"truth", "truth", Image<double>(64, 8)}, {"a", "a", Image<double>(64, 8)}};
    study.pictures[1].image.rgb[5] = 0.25;
    CHECK(largest_error(study, 1) == 0.25);
    const Image<float> plain = error_map(study, 1);
    const Image<float> whole = error_map_with_legend(study, 1);
    CHECK(plain.height == 8);
    CHECK(whole.width == 64);
    REQUIRE(whole.height > 16);
    CHECK(std::equal(plain.rgb.begin(), plain.rgb.end(), whole.rgb.begin()));
    // The bar begins black and ends white; digits are below it.
    CHECK(whole.pixel(0, 12)[0] == 0.0f);
    CHECK(whole.pixel(63, 12)[1] == 1.0f);
    int lit = 0;
    for (int y = whole.height - 8; y < whole.height; ++y)
        for (int x = 0; x < 64; ++x)
            lit += whole.pixel(x, y)[0] == 1.0f;
    CHECK(lit > 30);
}

TEST_CASE("a truth is cached, found again, and recomputed if it is damaged or wrong", "[report]")
{
    const TempFolder folder;
    const Scene scene = four_spheres(24, 20);
    TruthRequest request{.cache = folder / "cache"};
    const Truth made = find_truth(scene, request);
    CHECK_FALSE(made.cached);
    const Truth found = find_truth(scene, request);
    CHECK(found.cached);
    CHECK((found.image.rgb == made.image.rgb));
    CHECK(found.seconds == Approx(made.seconds).epsilon(1e-4));

    // Other scenes and settings have files of their own.
    TruthRequest other = request;
    other.samples = 2;
    CHECK_FALSE(find_truth(scene, other).cached);
    const auto is_kept_apart = [&](const auto& change) {
        Scene changed = scene;
        change(changed);
        return !find_truth(changed, request).cached && find_truth(scene, request).cached;
    };
    CHECK(is_kept_apart([](Scene& changed) { changed.max_depth = 0; }));
    CHECK(is_kept_apart([](Scene& changed) { changed.camera.position.x = 0.25; }));
    CHECK(is_kept_apart([](Scene& changed) { changed.lights.pop_back(); }));
    CHECK(is_kept_apart([](Scene& changed) { changed.background = Rgb(0.5); }));

    // The first file, truncated; then with pixels of another picture.
    std::filesystem::remove_all(request.cache);
    (void)find_truth(scene, request);
    const auto file = std::filesystem::directory_iterator(request.cache)->path();
    const std::string bytes = read_text(file);
    write_text(file, bytes.substr(0, bytes.size() - 8));
    CHECK_FALSE(find_truth(scene, request).cached);
    std::string flipped = bytes;
    flipped[flipped.size() - 3] ^= 1;
    write_text(file, flipped);
    CHECK_FALSE(find_truth(scene, request).cached);
    write_truth(file, truth_key(scene, 1).text(), other_picture(made));
    const Truth anew = find_truth(scene, request);
    CHECK_FALSE(anew.cached);
    CHECK((anew.image.rgb == made.image.rgb));
}

TEST_CASE("a stale truth in place of the requested one is detected by its key and recomputed",
          "[report]")
{
    const TempFolder folder;
    const Scene scene = four_spheres(24, 20);
    TruthRequest request{.cache = folder / "cache"};
    const Truth made = find_truth(scene, request);
    const auto file = std::filesystem::directory_iterator(request.cache)->path();
    const TruthKey key = truth_key(scene, request.samples);
    // The same picture: only the key says that it belongs to something else.
    const auto is_found_stale = [&](const auto& change) {
        TruthKey planted = key;
        change(planted);
        write_truth(file, planted.text(), made);
        const Truth anew = find_truth(scene, request);
        return !anew.cached && anew.image.rgb == made.image.rgb &&
               find_truth(scene, request).cached;
    };
    CHECK(is_found_stale([](TruthKey& planted) { planted.scene += "max_depth = 0\n"; }));
    CHECK(is_found_stale([](TruthKey& planted) { planted.version = "0.0.1"; }));
    CHECK(is_found_stale([](TruthKey& planted) { planted.sources[0] ^= 1; }));
    CHECK(is_found_stale([](TruthKey& planted) { planted.self_hits = "note"; }));
    CHECK(is_found_stale([](TruthKey& planted) { planted.samples = 2; }));
    CHECK(is_found_stale([](TruthKey& planted) { planted.precision = "double of 53 bits"; }));
    CHECK(is_found_stale([](TruthKey& planted) { planted.compiler += " -ffast-math"; }));
    CHECK(is_found_stale([](TruthKey& planted) { planted.machine = "another"; }));
}

TEST_CASE("a cached truth with any one byte changed is recomputed", "[report]")
{
    const TempFolder folder;
    const Scene scene = four_spheres(8, 8);
    const std::string key = truth_key(scene, 1).text();
    const auto file = folder / "kept.truth";
    write_truth(file, key, find_truth(scene, {}));
    REQUIRE(read_truth(file, key));
    const std::string bytes = read_text(file);
    std::size_t unnoticed = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string changed = bytes;
        changed[i] ^= 1;
        write_text(file, changed);
        unnoticed += read_truth(file, key).has_value();
    }
    CHECK(unnoticed == 0);
}

TEST_CASE("the CSV has a row per run, each as long as the head", "[report]")
{
    const SceneReport scene = report(small_scene(), short_options());
    const std::string csv = report_csv({scene});
    std::size_t runs = 0;
    for (const StudyReport& study : scene.studies)
        runs += study.runs.size();
    CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == runs + 1);
    const auto fields = [](const std::string& line) {
        bool inside = false;
        int count = 1;
        for (const char c : line) {
            inside = inside != (c == '"');
            count += c == ',' && !inside;
        }
        return count;
    };
    for (std::size_t at = 0; at < csv.size(); at = csv.find('\n', at) + 1)
        CHECK(fields(csv.substr(at, csv.find('\n', at) - at)) == 27);
}

TEST_CASE("the JSON says what was run, how, and with what result", "[report]")
{
    const SceneReport scene = report(small_scene(), short_options());
    const auto json = nlohmann::json::parse(
        report_json({scene}, short_options(), {"some processor", 2, "a compiler", "abc", "cmd"}));
    CHECK(json["packtrace_report"] == 1);
    CHECK(json["conditions"]["processor"] == "some processor");
    CHECK(json["conditions"]["commit"] == "abc");
    CHECK(json["scenes"][0]["width"] == 48);
    for (const auto& study : json["scenes"][0]["studies"]) {
        CHECK(study["truth"]["what"].is_string());
        CHECK(study["judgement"].size() >= 2);
        for (const auto& run : study["runs"]) {
            CHECK(run["median_s"] > 0.0);
            CHECK(run["seconds"].size() == 2);
            CHECK(run["error"]["pixels"] == 48 * 40);
            const std::string pareto = run["pareto"];
            CHECK((pareto == "yes" || pareto == "no" || pareto == "undecided"));
            CHECK(run["isa"].is_null() == (run["kernel"] == "scalar"));
            CHECK(run["accuracy"].is_null() ==
                  (run["kernel"] == "scalar" || run["precision"] == "double"));
            CHECK((run["accuracy"] == "fast") ==
                  (run["name"].get<std::string>().find("fast") != std::string::npos));
            CHECK(run["adaptive"].is_null() ==
                  (run["name"].get<std::string>().find("adaptive") == std::string::npos));
            for (const auto& kind : run["error"]["classes"])
                CHECK(kind["pixels"] > 0);
        }
    }
}

TEST_CASE("a report's files are all that it names, and its page needs no other",
          "[report][report_plot]")
{
    const TempFolder folder;
    const SceneReport scene = report(small_scene(), short_options());
    write_report({scene}, short_options(), {"p", 1, "c", "x", "cmd"}, folder / "out");
    for (const char* name : {"report.md", "report.csv", "report.json", "report.html"})
        CHECK(std::filesystem::file_size(folder / "out" / name) > 0);
    const auto json = nlohmann::json::parse(read_text(folder / "out" / "report.json"));
    for (const auto& study : json["scenes"][0]["studies"]) {
        const std::string plot = read_text(folder / "out" / study["plot"].get<std::string>());
        CHECK_THAT(plot, ContainsSubstring("<svg"));
        CHECK_THAT(plot, ContainsSubstring("Pareto front of medians"));
        for (const auto& run : study["runs"])
            CHECK(std::filesystem::exists(folder / "out" / run["picture"].get<std::string>()));
    }
    const std::string page = read_text(folder / "out" / "report.html");
    for (const char* outside : {"src=\"http", "href=\"http", "@import"})
        CHECK(page.find(outside) == std::string::npos);
    for (const char* part : {"data:image/png;base64,", "<svg", "type=\"range\"", "gnuplot_plot_2"})
        CHECK_THAT(page, ContainsSubstring(part));
}

}  // namespace packtrace::test
