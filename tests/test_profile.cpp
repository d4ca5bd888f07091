// How a frame's time is divided.
#include "catch.hpp"
#include "lab/harness/statistics.hpp"
#include "lab/profile/profile_steps.hpp"
#include "lab/profile/stage_times.hpp"
#include "run_program.hpp"
#include "scenes.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/profile.hpp>
#include <packtrace/read_scene.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace packtrace::test {
namespace {

Profile small_profile(ProfileOptions options = {})
{
    options.repetitions = 3;
    return profile<float>(read_text(four_spheres_file), four_spheres(128, 96), options);
}

FrameCounts rays_of(const Scene& scene)
{
    Image<float> image;
    return Renderer<float>(scene).render(image);
}

const ProfileWhatIf& row_of(const Profile& profile, const std::string& name)
{
    for (const ProfileWhatIf& row : profile.what_if)
        if (row.name == name)
            return row;
    FAIL("no row " + name);
    return profile.what_if.front();
}

/// The profile of an idle machine: all parts add up to their sums, and no time varies.
Profile idle_profile()
{
    Profile result;
    result.frame = 0.010;
    result.frame_spread = 0.02;
    result.whole = 0.020;
    result.stages = {{"scene load", 0.002}, {"frame", 0.010}, {"encoding as PNG", 0.0081}};
    result.generations = {{0, {}, 0.007, 0.0002, {}}, {1, {}, 0.003, 0.0003, {}}};
    result.what_if = {{"without shadows", 0.006, false, 0.004, 0.0003, {}}};
    result.kernels.observed = 0.012;
    result.kernels.clocked = 0.0122;
    result.kernels.stages = {{0, "camera", "spheres", 0.008}, {0, "hits", "pixels", 0.004}};
    return result;
}

std::string only_line(const Profile& profile)
{
    const std::vector<std::string> lines = busy_lines(profile);
    REQUIRE(lines.size() == 1);
    return lines.front();
}

}  // namespace

TEST_CASE("a profile shows the costs of a process's first frame", "[profile]")
{
    const Profile result = small_profile();
    REQUIRE(result.first_frame.size() == 4);
    CHECK(result.first_frame[0].name == "threads started");
    for (const FirstFrameStep& step : result.first_frame)
        CHECK(step.seconds > 0.0);
    // A picture of 3 MB that no process has touched before.
    const ProfileOptions once{.repetitions = 1};
    const Profile cold = profile<float>(read_text(four_spheres_file), four_spheres(512, 512), once);
    CHECK(cold.first_frame[2].page_faults > cold.first_frame[3].page_faults);
}

TEST_CASE("a profile's generations contain all rays of the frame, each once", "[profile]")
{
    const Profile result = small_profile();
    const FrameCounts all = rays_of(four_spheres(128, 96));
    CHECK(result.rays.total() == all.total());
    REQUIRE(result.generations.size() == 4);
    FrameCounts sum;
    for (const ProfileGeneration& generation : result.generations) {
        sum.camera += generation.rays.camera;
        sum.shadow += generation.rays.shadow;
        sum.reflected += generation.rays.reflected;
        CHECK((generation.rays.camera == 0) == (generation.depth > 0));
        CHECK((generation.rays.reflected == 0) == (generation.depth == 0));
    }
    CHECK(sum.camera == all.camera);
    CHECK(sum.shadow == all.shadow);
    CHECK(sum.reflected == all.reflected);
    Scene flat = four_spheres(128, 96);
    flat.max_depth = 0;
    CHECK(result.generations.front().rays.shadow == rays_of(flat).shadow);
}

TEST_CASE("a profile's stages follow each other within the total time", "[profile]")
{
    // Medians of several repetitions need not add up: each may come from another repetition.
    const ProfileOptions once{.repetitions = 1};
    const Profile result =
        profile<float>(read_text(four_spheres_file), four_spheres(128, 96), once);
    REQUIRE(result.stages.size() == 5);
    double sum = 0.0;
    for (const ProfileStage& stage : result.stages) {
        CHECK(stage.seconds > 0.0);
        sum += stage.seconds;
    }
    CHECK(sum <= result.whole * (1.0 + 1e-9));
}

TEST_CASE("what-if rows are frames without the rays of what they lack", "[profile]")
{
    const Profile result = small_profile({.samples = 4});
    CHECK(result.rays.shadow > 0);
    CHECK(result.rays.reflected > 0);
    CHECK(row_of(result, "without shadows").rays.shadow == 0);
    CHECK(row_of(result, "without shadows").rays.reflected == result.rays.reflected);
    CHECK(row_of(result, "without reflections and refractions").rays.reflected == 0);
    CHECK(row_of(result, "without lights but ambient ones").rays.shadow == 0);
    // Because of highlights, a light that shines from behind also needs shadow rays.
    CHECK(row_of(result, "without highlights").rays.shadow <= result.rays.shadow);
    CHECK(row_of(result, "without highlights").rays.reflected == result.rays.reflected);
    const ProfileWhatIf once = row_of(result, "without anti-aliasing");
    CHECK(4 * once.rays.camera == result.rays.camera);
    CHECK(once.rays.total() < result.rays.total() / 2);
    for (const ProfileWhatIf& row : result.what_if)
        CHECK(row.seconds > 0.0);
}

TEST_CASE("rays of whole tiles fill all lanes, and rays after each mirror fill fewer", "[profile]")
{
    const auto filled = [](const Scene& scene, const std::string& isa) {
        std::vector<double> shares;
        const ProfileOptions options{.isa = isa, .repetitions = 1};
        for (const auto& generation :
             profile<float>(read_text(four_spheres_file), scene, options).generations)
            shares.push_back(generation.lanes_filled.value_or(0.0));
        return shares;
    };
    const Scene whole = four_spheres(64, 64);
    for (const IsaInfo& isa : list_isas()) {
        if (!isa.supported)
            continue;
        const std::vector<double> shares = filled(whole, isa.name);
        CAPTURE(isa.name);
        CHECK(shares[0] == 1.0);
        if (isa.lanes_single == 1)
            CHECK(shares[3] == 1.0);
        else
            CHECK(shares[1] > shares[3]);
        for (const double share : shares) {
            CHECK(share > 0.0);
            CHECK(share <= 1.0);
        }
        // A single pixel fills one lane of a packet.
        Scene wall;
        set_size(wall, 1, 1);
        add_plane(wall, {0, 0, 3}, {0, 0, -1}, scratch({1, 1, 1}, -1, 0));
        CHECK(filled(wall, isa.name)[0] == 1.0 / isa.lanes_single);
    }
    Scene glass = read_scene(PACKTRACE_SOURCE_DIR "/scenes/nested_glass.scene");
    set_size(glass, 16, 16);
    const ProfileOptions once{.repetitions = 1};
    const std::string text = read_text(PACKTRACE_SOURCE_DIR "/scenes/nested_glass.scene");
    for (const ProfileGeneration& generation : profile<float>(text, glass, once).generations) {
        CHECK((generation.rays.total() == 0) == !generation.lanes_filled.has_value());
        CHECK(generation.lanes_filled.value_or(1.0) > 0.0);
        CHECK(generation.lanes_filled.value_or(1.0) <= 1.0);
    }
}

TEST_CASE("a profile of adaptive sampling has everything but generations", "[profile]")
{
    const Scene scene = four_spheres(24, 24);
    const ProfileOptions options{.samples = 4, .adaptive = 0.1, .repetitions = 1};
    const Profile result = profile<float>(read_text(four_spheres_file), scene, options);
    CHECK(result.generations.empty());
    REQUIRE(!result.what_if.empty());
    CHECK(result.what_if.front().name == "without highlights");
    CHECK(result.rays.camera >= 24 * 24);
}

TEST_CASE("the time of a part is the median of pairs, and never negative", "[profile]")
{
    CHECK(time_difference({10, 20, 30}, {9, 18, 31}).seconds == 1.0);
    CHECK(time_difference({10, 20, 30}, {9, 18, 31}).spread == 1.5);
    // Busy spells during the part's measurements only.
    const TimeDifference busy = time_difference({1, 1, 1, 1}, {9, 0.5, 7, 8});
    CHECK(busy.seconds == 0.0);
    CHECK(busy.spread > 1.0);
}

TEST_CASE("no time of a profile is negative, however few repetitions", "[profile]")
{
    const ProfileOptions options{.repetitions = 1};
    for (int turn = 0; turn < 5; ++turn) {
        const Profile result =
            profile<float>(read_text(four_spheres_file), four_spheres(32, 24), options);
        for (const ProfileGeneration& generation : result.generations)
            CHECK(generation.seconds >= 0.0);
        for (const ProfileWhatIf& row : result.what_if)
            CHECK(row.difference >= 0.0);
        CHECK(row_of(result, "with all that was left out").does_more);
        CHECK_FALSE(row_of(result, "without shadows").does_more);
    }
}

TEST_CASE("the counter's rate is that of most readings, though some were late", "[profile]")
{
    // A tick is a nanosecond; pieces of 20 us.
    std::vector<ClockReading> readings;
    for (std::uint64_t i = 1; i <= 40; ++i)
        readings.push_back({20'000 * i, 2e-5 * static_cast<double>(i)});
    CHECK(seconds_of_tick(readings) == Approx(1e-9));
    // Another program ran for longer than the whole measurement before the first reading.
    readings.front().seconds += 0.01;
    CHECK(seconds_of_tick(readings) == Approx(1e-9));
    for (const std::size_t late : {3u, 11u, 18u, 25u, 36u, 39u})
        readings[late].seconds += 0.004;
    CHECK(seconds_of_tick(readings) == Approx(1e-9));
    CHECK(seconds_of_tick({{10, 1.0}, {20, 2.0}}) == Approx(0.1));
}

TEST_CASE("a profile names what a busy machine prevented, and nothing on an idle machine",
          "[profile]")
{
    CHECK(busy_lines(idle_profile()).empty());
    Profile busy = idle_profile();
    busy.frame_spread = 4.529;
    CHECK(only_line(busy) == "the frame: its times vary by 453 % of their median");
    busy = idle_profile();
    busy.generations[1].spread = 0.0011;
    busy.what_if[0].spread = 0.02;
    CHECK(only_line(busy) ==
          "what these rows differ by: depth 1, without shadows; from turn to turn that varies by "
          "more than 10 % of a frame");
    busy = idle_profile();
    busy.stages[1].seconds = 0.003;
    CHECK(only_line(busy) == "the stages: they sum to 66 % of the whole way");
    busy = idle_profile();
    busy.kernels.stages = {{0, "camera", "spheres", 0.29 * busy.kernels.clocked}};
    CHECK(only_line(busy) == "the stages in the kernels: they sum to 29 % of the clocked frame");
    busy = idle_profile();
    busy.kernels.observed = 0.02;
    CHECK(only_line(busy) == "what the clock adds: frames with it take 61 % of those without");
    // No measurements at all.
    busy = idle_profile();
    busy.whole = 0.0;
    CHECK_FALSE(busy_lines(busy).empty());
}

TEST_CASE("traced tiles cover the picture once, and those of a thread do not overlap", "[profile]")
{
    const Scene scene = four_spheres(100, 50);
    const std::vector<TileSpan> tiles = trace_tiles<float>(scene, {.threads = 2});
    CHECK(tiles.size() == 7 * 4);
    std::set<std::pair<int, int>> places;
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        places.insert({tiles[i].x, tiles[i].y});
        rays += tiles[i].rays;
        CHECK(tiles[i].thread >= 0);
        CHECK(tiles[i].thread < 2);
        for (std::size_t k = i + 1; k < tiles.size(); ++k)
            if (tiles[k].thread == tiles[i].thread)
                CHECK(tiles[k].start >= tiles[i].start + tiles[i].seconds - 1e-9);
    }
    CHECK(places.size() == tiles.size());
    CHECK(rays == rays_of(scene).total());
}

TEST_CASE("pixels that light reaches cost more than those that see nothing", "[profile]")
{
    // Ground in the lower half of the picture.
    Scene scene;
    set_size(scene, 32, 32);
    add_plane(scene, {0, -1, 0}, {0, 1, 0}, scratch({1, 1, 1}, 100, 0));
    for (int i = 0; i < 100; ++i)
        scene.lights.push_back({LightType::point, Rgb(0.01), {0.1 * i, 5, 3}});
    const std::vector<double> costs = pixel_costs<float>(scene, {});
    REQUIRE(costs.size() == 32 * 32);
    CHECK(*std::min_element(costs.begin(), costs.end()) > 0.0);
    // Medians of costs that differ a hundredfold: interrupted pixels can't hide the difference.
    const auto half = costs.begin() + 16 * 32;
    CHECK(median_of({half, costs.end()}) > 2.0 * median_of({costs.begin(), half}));
}

TEST_CASE("the picture of costs has a legend below it", "[profile]")
{
    std::vector<double> costs(64 * 8, 1e-8);
    costs[0] = 5e-8;
    for (int i = 1; i < 10; ++i)
        costs[static_cast<std::size_t>(i)] = 5e-8;
    const Image<float> picture = cost_picture(costs, 64, 8);
    CHECK(picture.width == 64);
    CHECK(picture.height > 16);
    CHECK(picture.pixel(0, 0)[0] == 1.0f);
    CHECK(picture.pixel(40, 4)[2] == 0.0f);
    // The bar goes from black to white; below it are digits.
    int lit = 0;
    for (int y = picture.height - 8; y < picture.height; ++y)
        for (int x = 0; x < 64; ++x)
            lit += picture.pixel(x, y)[0] == 1.0f;
    CHECK(lit > 30);
}

TEST_CASE("profile prints tables and JSON, and writes a heat map and a trace",
          "[profile][profile_cli]")
{
    const TempFolder folder;
    const std::string map = (folder / "map.png").string();
    const std::string trace = (folder / "trace.json").string();
    const std::vector<std::string> words{"profile", four_spheres_file, "--size",
                                         "64x48",   "--repetitions",   "2"};
    auto more = words;
    more.insert(more.end(), {"--heatmap", map, "--trace", trace});
    const ProgramResult text = run_packtrace(more);
    CAPTURE(text.err);
    REQUIRE(text.exit_code == 0);
    for (const char* part :
         {"64 x 48, ", "scene load", "lowering", "encoding as PNG", "depth 3", "without highlights",
          "without shadows", "ns/ray", "lanes filled", "inside the kernels, on one thread",
          "stage in the kernels", "highlight powers", "rays to their hits", "Mrays/s", "live lanes",
          "coherent", "single/ray", "anchored spheres"})
        CHECK_THAT(text.out, ContainsSubstring(part));
    CHECK(std::filesystem::file_size(map) > 100);
    auto doubles = more;
    doubles.insert(doubles.end(), {"--precision", "double"});
    CHECK(run_packtrace(doubles).exit_code == 0);
    const auto events = nlohmann::json::parse(read_text(trace))["traceEvents"];
    CHECK(events.size() == 4 * 3);
    CHECK(events[0]["ph"] == "X");
    CHECK(events[0]["dur"] > 0.0);

    more = words;
    more.insert(more.end(), {"--json", "--precision", "double", "--depth", "1"});
    const auto json = nlohmann::json::parse(run_packtrace(more).out);
    CHECK(json["packtrace_profile"] == 1);
    CHECK(json["generations"].size() == 2);
    CHECK(json["rays"]["camera"] == 64 * 48);
    CHECK(json["lanes"] == choose_isa().lanes_double);
    CHECK(json["too_busy"].is_array());
    const auto& kernels = json["kernels"];
    CHECK(kernels["observed_s"] > 0.0);
    CHECK(kernels["clocked_s"] > 0.0);
    double sum = 0.0;
    for (const auto& stage : kernels["stages"])
        sum += stage["seconds"].get<double>();
    CHECK(std::abs(sum - kernels["stages_sum_s"].get<double>()) < 1e-9);
    CHECK(kernels["rays"][0]["rays"] == "camera");
    CHECK(kernels["rays"][0]["count"] == 64 * 48);
    CHECK(kernels["lanes"][0]["work"] == "closest hits");
    CHECK(kernels["lanes"][0]["live"] <= 64 * 48);
    CHECK(kernels["tests"].size() >= 2);
}

TEST_CASE("profile counts the rays that exact accuracy traces again", "[profile][profile_cli]")
{
    const TempFolder folder;
    const std::string scene = (folder / "twins.scene").string();
    // Single precision can't decide which of the two is nearer.
    write_text(scene,
               "sphere {\ncenter = (0, 0, 5)\nradius = 1\n}\n"
               "sphere {\ncenter = (0, 0, 5.00000001)\nradius = 1\n}\n");
    const auto tests = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words{"profile",       scene, "--size", "64x48",
                                       "--repetitions", "2",   "--json"};
        words.insert(words.end(), options.begin(), options.end());
        const ProgramResult result = run_packtrace(words);
        CAPTURE(result.err);
        REQUIRE(result.exit_code == 0);
        const auto json = nlohmann::json::parse(result.out);
        std::uint64_t count = 0;
        for (const auto& row : json["kernels"]["tests"])
            count += row["together"].get<std::uint64_t>() + row["single"].get<std::uint64_t>();
        return count;
    };
    const std::uint64_t fast = tests({"--accuracy", "fast"});
    CHECK(tests({"--accuracy", "exact"}) > fast);
    CHECK(tests({"--accuracy", "exact", "--self-hits", "note"}) > fast);
}

TEST_CASE("profile refuses what it can't do", "[profile][profile_cli]")
{
    const TempFolder folder;
    const auto result = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words{"profile", four_spheres_file};
        words.insert(words.end(), options.begin(), options.end());
        return run_packtrace(words);
    };
    CHECK(result({"--repetitions", "0"}).exit_code == 2);
    CHECK(result({"--isa", "sse9"}).exit_code == 2);
    CHECK(result({"--adaptive", "0.1", "--spp", "1"}).exit_code == 2);
    const ProgramResult bad = result({"--heatmap", (folder / "no" / "a.png").string()});
    CHECK(bad.exit_code == 1);
    CHECK(std::count(bad.err.begin(), bad.err.end(), '\n') == 1);
    CHECK(result({"--trace", (folder / "no" / "a.json").string()}).exit_code == 1);
    CHECK(run_packtrace({"profile", "missing.scene"}).exit_code == 1);
}

}  // namespace packtrace::test
