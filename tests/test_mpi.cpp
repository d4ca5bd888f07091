// packtrace-mpi writes the bytes of one process for any number of ranks, and survives ranks that
// die.
#include "../bench/cluster/job_model.hpp"
#include "catch.hpp"
#include "fork_child.hpp"
#include "job_inputs.hpp"
#include "killed_program.hpp"
#include "mpi/hand_out.hpp"
#include "mpi/rank_setup.hpp"
#include "mpi/wire.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <sys/stat.h>
#include <thread>
#include <vector>

namespace packtrace::test {
namespace {

using Words = std::vector<std::string>;
using mpi::Mixing;
using mpi::PieceWindow;

#ifdef PACKTRACE_MPI

/// mpirun of a program with this number of ranks, which may exceed the number of processors.
Words mpirun(int ranks, const std::string& program = PACKTRACE_MPI)
{
    // All ranks are on this machine. Open MPI 5 warns of networks that do not reach it.
    return {"env",
            "OMPI_MCA_btl_tcp_if_include=lo",
            PACKTRACE_MPIEXEC,
            "--allow-run-as-root",
            "--oversubscribe",
            "--bind-to",
            "none",
            "-n",
            std::to_string(ranks),
            program};
}

ProgramResult run_ranks(int ranks, const Words& words)
{
    Words all = mpirun(ranks);
    all.insert(all.end(), words.begin(), words.end());
    return run_command(all);
}

/// As run_ranks(), but the ranks write standard output to a file. mpirun of Open MPI 5 prints the
/// end of a piece of standard output on standard error if output there follows.
ProgramResult run_ranks_to_file(int ranks, const Words& words)
{
    const TempFolder folder;
    const std::string out = folder / "ranks";
    Words all = mpirun(ranks, "sh");
    all.insert(all.end(), {"-c", "exec \"$0\" \"$@\" >>" + shell_quoted(out), PACKTRACE_MPI});
    all.insert(all.end(), words.begin(), words.end());
    ProgramResult result = run_command(all);
    result.out = read_text(out);
    return result;
}

/// The lines of packtrace-mpi itself: mpirun adds lines about exit codes.
Words own_lines(const std::string& text)
{
    Words lines;
    bool ours = true;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = text.substr(at, end - at);
        at = end + 1;
        if (line.starts_with("-----"))
            ours = !ours;
        else if (ours && !line.empty())
            lines.push_back(line);
    }
    return lines;
}

constexpr int ranks_tested[] = {1, 2, 3, 5};

/// The system's record of a process after its name, starting with its state; empty if there is no
/// such process.
std::string stat_of(const std::string& process)
{
    try {
        const std::string stat = read_text("/proc/" + process + "/stat");
        const std::size_t end = stat.rfind(')');
        return end == std::string::npos || stat.size() < end + 5 ? "" : stat.substr(end + 2);
    } catch (const std::exception&) {
        return "";
    }
}

/// Whether a process has ended, even if nobody has waited for it.
bool has_ended(pid_t process)
{
    const std::string stat = stat_of(std::to_string(process));
    return stat.empty() || stat.front() == 'Z';
}

/// Child processes: for mpirun, the ranks.
std::vector<pid_t> children_of(pid_t parent)
{
    std::vector<pid_t> children;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos)
            continue;
        const std::string stat = stat_of(name);
        if (!stat.empty() && std::atoi(stat.c_str() + 2) == parent)
            children.push_back(std::atoi(name.c_str()));
    }
    std::sort(children.begin(), children.end());
    return children;
}

/// Chooses the rank of a job that is killed now, by its process; 0 for none yet.
using ChooseVictim = std::function<pid_t(const std::vector<pid_t>& children)>;

/// Starts a job and kills one of its ranks by SIGKILL. Returns the job's exit code; -1 if the job
/// ended before.
int kill_rank(int ranks, const Words& words, const std::filesystem::path& errors,
              const ChooseVictim& choose)
{
    Words all = mpirun(ranks);
    all.insert(all.end(), words.begin(), words.end());
    const pid_t job = fork_child([&] {
        const int nowhere = open("/dev/null", O_RDWR);
        const int err = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(nowhere, 0);
        dup2(nowhere, 1);
        dup2(err, 2);
        become(all);
    });
    int status = 0;
    bool killed = false;
    auto alive = std::chrono::steady_clock::now();
    while (waitpid(job, &status, WNOHANG) == 0) {
        const std::vector<pid_t> children = children_of(job);
        if (!killed && children.size() == static_cast<std::size_t>(ranks))
            if (const pid_t victim = choose(children); victim != 0)
                killed = kill(victim, SIGKILL) == 0;
        const auto now = std::chrono::steady_clock::now();
        if (!std::all_of(children.begin(), children.end(), has_ended))
            alive = now;
        // Open MPI's launcher may deadlock at its end (in PMIx_server_finalize).
        if (killed && now - alive > std::chrono::seconds(30))
            kill(job, SIGKILL);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (!killed)
        return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Kills the rank with this number once `when` holds.
int kill_rank(int ranks, const Words& words, std::size_t victim,
              const std::filesystem::path& errors, const std::function<bool()>& when)
{
    return kill_rank(ranks, words, errors, [&](const std::vector<pid_t>& children) {
        return when() ? children[victim % children.size()] : 0;
    });
}

/// Starts a job of one rank and sends it SIGTERM once `when` holds. Returns its standard error.
std::string errors_of_ended(const Words& words, const std::filesystem::path& errors,
                            const std::function<bool()>& when)
{
    Words all{"sh", "-c", "exec \"$0\" \"$@\" 2>" + shell_quoted(errors.string()), PACKTRACE_MPI};
    all.insert(all.end(), words.begin(), words.end());
    const int status = kill_program(all, SIGTERM, when);
    CHECK(WIFSIGNALED(status));
    return read_text(errors);
}

/// Removes values that differ from run to run, at all depths: times and values derived from times.
void without_times(nlohmann::ordered_json& json)
{
    if (json.is_object())
        for (const char* const key : {"ns_per_ray", "pareto", "seconds", "median_s", "spread",
                                      "cached", "command", "judgement", "cheapest_within_max_error",
                                      "most_exact_within_max_time", "load_before", "load_after"})
            json.erase(key);
    if (json.is_structured())
        for (auto& part : json)
            without_times(part);
}

/// The PNG files below a folder by name, each with its bytes.
std::map<std::string, std::string> pictures_of(const std::filesystem::path& folder)
{
    std::map<std::string, std::string> pictures;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".png")
            pictures[entry.path().lexically_relative(folder)] = read_text(entry.path());
    return pictures;
}

std::string mpi_scene(const std::string& name)
{
    return PACKTRACE_SOURCE_DIR "/scenes/" + name + ".scene";
}

/// The words that render a tall picture with --resume, which keeps finished bands.
Words render_high(const std::filesystem::path& picture)
{
    return {"render", mpi_scene("mirror_room"),
            "--size", "800x8000",
            "-q",     "-o",
            picture,  "--threads",
            "1",      "--resume"};
}

#endif

}  // namespace

TEST_CASE("pieces are written in order and handed out only within the window", "[mpi]")
{
    PieceWindow window(10, 3);
    CHECK(window.admits(2));
    CHECK_FALSE(window.admits(3));
    window.arrive(1);
    window.arrive(2);
    CHECK_FALSE(window.ready());
    CHECK_FALSE(window.admits(1));
    window.arrive(0);
    CHECK(window.ready());
    window.leave();
    CHECK(window.admits(3));
    for (int i = 3; i < 10; ++i) {
        REQUIRE(window.admits(i));
        window.arrive(i);
        window.leave();
    }
    CHECK(window.ready());
    window.leave();
    window.leave();
    CHECK(window.empty());
    CHECK(PieceWindow(0, 3).empty());
    // Rank 0 holds a bounded part of a large picture.
    CHECK(static_cast<std::size_t>(mpi::window_of(4096, std::size_t{12} << 20)) <=
          mpi::window_bytes / (std::size_t{12} << 20));
}

TEST_CASE("ranks of another version or without FMA are detected", "[mpi]")
{
    const std::string one = mpi::RankSetup{"1.0", true}.text();
    const std::string plain = mpi::RankSetup{"1.0", false}.text();
    const std::string two = mpi::RankSetup{"2.0", true}.text();
    CHECK(mpi::why_not_together({one, one, one}, Mixing::refused).empty());
    CHECK(mpi::why_not_together({plain, plain}, Mixing::refused).empty());
    CHECK_THAT(mpi::why_not_together({one, one, plain}, Mixing::refused),
               ContainsSubstring("rank 2 and rank 0 differ in fused multiply-add"));
    CHECK(mpi::why_not_together({one, plain}, Mixing::allowed).empty());
    CHECK_THAT(mpi::why_not_together({one, two}, Mixing::allowed),
               ContainsSubstring("rank 1 is version 2.0 and rank 0 is version 1.0"));
}

TEST_CASE("ranks may have their own instruction sets and threads, but no other different arguments",
          "[mpi]")
{
    const auto shared = [](const Words& words) { return mpi::shared_arguments(words); };
    const std::string first = shared({"render", "a.scene", "-o", "a.png"});
    CHECK(shared({"render", "--isa", "sse42", "a.scene", "-o", "a.png", "--threads=3"}) == first);
    CHECK(shared({"render", "a.scene", "-o", "a.png", "--width", "4"}) == first);
    CHECK(mpi::why_arguments_differ({first, first, first}).empty());
    CHECK_THAT(mpi::why_arguments_differ(
                   {first, first, shared({"render", "a.scene", "-o", "a.png", "--spp", "4"})}),
               ContainsSubstring("rank 2 and rank 0 have different arguments"));
}

TEST_CASE("ranks with different instruction sets do not share a study", "[mpi]")
{
    CHECK(mpi::why_rows_differ({"sse42, avx2", "sse42, avx2"}).empty());
    CHECK_THAT(mpi::why_rows_differ({"sse42, avx2", "sse42, avx2", "sse42"}),
               ContainsSubstring("rank 2 runs sse42 and rank 0 runs sse42, avx2"));
}

TEST_CASE("messages carry values of all kinds", "[mpi]")
{
    const std::vector<std::string> words{"a", "", "three"};
    const std::vector<double> numbers{1.5, -0.0};
    const bool flag = true;
    mpi::WireWriter writer;
    writer(words, numbers, flag);
    std::vector<std::string> read_words;
    std::vector<double> read_numbers;
    bool read_flag = false;
    mpi::WireReader reader(writer.bytes);
    reader(read_words, read_numbers, read_flag);
    CHECK(read_words == words);
    CHECK(read_numbers == numbers);
    CHECK(read_flag);
    // Every truncated message is detected.
    for (std::size_t size = 0; size < writer.bytes.size(); ++size) {
        const Bytes part(writer.bytes.begin(),
                         writer.bytes.begin() + static_cast<std::ptrdiff_t>(size));
        mpi::WireReader cut(part);
        CHECK_THROWS_AS(cut(read_words, read_numbers, read_flag), std::runtime_error);
    }
}

TEST_CASE("the model of a job keeps all parts busy that it can", "[mpi]")
{
    const auto seconds = [](bench::ModelJob job) {
        const bench::ModelRun run = bench::JobModel(job).run();
        CHECK(run.working == Approx(job.pieces * job.work(0)).margin(1e-6));
        // No job is faster than its busiest part.
        CHECK(run.seconds >= run.working / job.ranks - 1e-9);
        CHECK(run.seconds >= run.writer_busy - 1e-9);
        CHECK(run.seconds >= run.link_busy - 1e-9);
        CHECK(run.seconds >= run.counter_busy - 1e-9);
        return run.seconds;
    };
    bench::ModelJob job;
    job.pieces = 1000;
    job.work = [](int) { return 0.01; };
    job.piece_bytes = 1e6;
    job.bytes_per_second = 1e12;
    CHECK(seconds(job) == Approx(10.0).margin(1e-3));
    for (const int ranks : {2, 4, 8, 100}) {
        CAPTURE(ranks);
        job.ranks = ranks;
        CHECK(seconds(job) == Approx(10.0 / ranks).margin(1e-2));
    }
    // One bottleneck that all ranks wait for: the writer, the link, the counter.
    bench::ModelJob slow = job;
    slow.write = 0.001;
    CHECK(seconds(slow) == Approx(1.0).margin(0.02));
    slow = job;
    slow.bytes_per_second = 1e9;
    CHECK(seconds(slow) == Approx(1.0).margin(0.03));
    slow = job;
    slow.counter = 0.002;
    CHECK(seconds(slow) == Approx(2.0).margin(0.3));
    // Frames stay on the rank that renders them. No rank renders half a frame.
    job.piece_bytes = 0.0;
    job.ranks = 600;
    CHECK(seconds(job) == Approx(0.02).margin(1e-6));
    job.ranks = 4096;
    CHECK(seconds(job) == Approx(0.01).margin(1e-6));
}

#ifdef PACKTRACE_MPI

TEST_CASE("a picture has the bytes of one process for any number of ranks", "[mpi]")
{
    struct Case {
        std::string scene, ending;
        Words more;
    };
    const std::vector<Case> cases = {
        {mpi_scene("four_spheres"), ".png", {"--gamma", "2.2"}},
        {mpi_scene("whitted"), ".pfm", {"--precision", "double", "--depth", "1"}},
        {four_spheres_file, ".hdr", {"--adaptive", "0.5", "--spp", "2", "--depth", "1"}},
        {"generate random --count 300", ".png", {"--accuracy", "fast"}},
    };
    for (const Case& one : cases) {
        const TempFolder folder;
        std::string scene = one.scene;
        if (scene.starts_with("generate")) {
            scene = folder / "made.scene";
            REQUIRE(
                run_packtrace({"generate", "random", "--count", "300", "-o", scene}).exit_code ==
                0);
        }
        Words words{"render", scene, "--size", "500x1300", "-q", "-o", folder / ("w" + one.ending)};
        words.insert(words.end(), one.more.begin(), one.more.end());
        REQUIRE(run_packtrace(words).exit_code == 0);
        for (const int ranks : ranks_tested) {
            CAPTURE(one.scene, one.ending, ranks);
            words[1] = one.scene;
            words[6] = folder / ("m" + one.ending);
            const ProgramResult result = run_ranks(ranks, words);
            CHECK(result.exit_code == 0);
            CHECK(result.err.empty());
            CHECK(
                (read_text(folder / ("m" + one.ending)) == read_text(folder / ("w" + one.ending))));
        }
    }
}

TEST_CASE("every scene has the bytes of one process in either precision", "[mpi][slow]")
{
    // One function per format writes bands, whatever the scene; so each scene is tested in one
    // format. Which rank renders a band does not depend on scene or precision; so the scenes
    // alternate between numbers of ranks, and each has several ranks in at least one precision.
    const std::string endings[] = {".png", ".pfm", ".hdr"};
    std::set<std::filesystem::path> scenes;
    for (const auto& entry : std::filesystem::directory_iterator(PACKTRACE_SOURCE_DIR "/scenes"))
        if (entry.path().extension() == ".scene")
            scenes.insert(entry.path());
    std::size_t number = 0;
    for (const std::filesystem::path& scene : scenes) {
        const bool odd = number % 2 == 1;
        const std::string& of_scene = endings[number++ % std::size(endings)];
        for (const std::string precision : {"single", "double"}) {
            const std::string ending = precision == "double" ? ".pfm" : of_scene;
            const TempFolder folder;
            Words words{"render",
                        scene,
                        "--size",
                        "500x1100",
                        "-q",
                        "--depth",
                        "2",
                        "--precision",
                        precision,
                        "-o",
                        folder / ("w" + ending)};
            REQUIRE(run_packtrace(words).exit_code == 0);
            words.back() = folder / ("m" + ending);
            const int ranks = precision == "double" ? (odd ? 1 : 3) : (odd ? 2 : 5);
            CAPTURE(scene.string(), ending, precision, ranks);
            CHECK(run_ranks(ranks, words).exit_code == 0);
            CHECK((read_text(folder / ("m" + ending)) == read_text(folder / ("w" + ending))));
        }
    }
    CHECK(number > std::size(endings));
}

TEST_CASE("a job reports in JSON what each rank did", "[mpi]")
{
    const TempFolder folder;
    const ProgramResult result = run_ranks(
        3, {"render", four_spheres_file, "--size", "1000x2000", "--json", "-o", folder / "a.png"});
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    std::uint64_t rays = 0;
    int pieces = 0;
    for (const auto& rank : json["ranks"]) {
        rays += rank["rays"].get<std::uint64_t>();
        pieces += rank["pieces"].get<int>();
        CHECK(rank["busy_seconds"].get<double>() >= 0.0);
        CHECK(rank["waiting_seconds"].is_number());
    }
    CHECK(json["ranks"].size() == 3);
    CHECK(rays > 2000000u);
    CHECK(pieces == 8);
}

TEST_CASE("a stress test has the rows of one process for any number of ranks", "[mpi]")
{
    const Words families = first_families(6);
    Words words{"stress", "--json", "--rays", "48", "--threads", "1"};
    for (const std::string& family : families)
        words.insert(words.end(), {"--family", family});
    words.insert(words.end(), {"--family", "exponents", "--family", "mirror-room"});
    const ProgramResult one = run_packtrace(words);
    auto expected = nlohmann::ordered_json::parse(one.out);
    without_times(expected);
    CHECK(expected["rows"].size() > 16);
    for (const int ranks : {1, 2, 3}) {
        CAPTURE(ranks);
        const ProgramResult many = run_ranks_to_file(ranks, words);
        CHECK(many.exit_code == one.exit_code);
        auto json = nlohmann::ordered_json::parse(many.out);
        without_times(json);
        CHECK(json.dump() == expected.dump());
        CHECK_THAT(many.err, ContainsSubstring("16 families in one precision on " +
                                               std::to_string(ranks) + " ranks"));
    }
    CHECK(run_ranks(2, {"stress", "--list"}).out == run_packtrace({"stress", "--list"}).out);
}

TEST_CASE("a report has the errors of one process for any number of ranks", "[mpi]")
{
    const TempFolder folder;
    write_text(folder / "a.scene",
               "image_size = 24 x 20  max_depth = 1\n"
               "sphere { center = (0, 0, 3)  radius = 1  color = (200, 40, 30) }\n"
               "light { type = ambient  intensity = 0.5 }\n");
    const auto words = [&](const std::string& name) {
        return Words{"report",
                     folder / "a.scene",
                     mpi_scene("four_spheres"),
                     "--size",
                     "24x20",
                     "--quick",
                     "--repetitions",
                     "1",
                     "-q",
                     "--cache",
                     folder / (name + "_cache"),
                     "-o",
                     folder / name};
    };
    REQUIRE(run_packtrace(words("w")).exit_code == 0);
    auto expected = nlohmann::ordered_json::parse(read_text(folder / "w/report.json"));
    without_times(expected);
    CHECK(expected["scenes"].size() == 2);
    for (const int ranks : {1, 2, 3}) {
        CAPTURE(ranks);
        const std::string name = "m" + std::to_string(ranks);
        const ProgramResult result = run_ranks(ranks, words(name));
        CHECK(result.exit_code == 0);
        CHECK(result.err.empty());
        auto json = nlohmann::ordered_json::parse(read_text(folder / (name + "/report.json")));
        // Each run has been timed.
        CHECK(json.dump().find("\"seconds\":[]") == std::string::npos);
        without_times(json);
        CHECK(json.dump() == expected.dump());
        CHECK(pictures_of(folder / name) == pictures_of(folder / "w"));
        // The next report finds the truths of an earlier report.
        Words again = words("again" + name);
        again[10] = folder / (name + "_cache");
        CHECK(run_ranks(ranks, again).exit_code == 0);
        auto cached =
            nlohmann::ordered_json::parse(read_text(folder / ("again" + name + "/report.json")));
        CHECK(cached.dump().find("\"cached\":false") == std::string::npos);
        without_times(cached);
        CHECK(cached.dump() == expected.dump());
    }
}

TEST_CASE("no rank of a node works while another rank measures times", "[mpi]")
{
    struct Stage {
        int rank = 0;
        std::string kind;
        std::int64_t begin = 0, end = 0;
    };
    for (const int ranks : {2, 3, 5}) {
        CAPTURE(ranks);
        const ProgramResult result = run_command(mpirun(ranks, PACKTRACE_QUIET_RANKS));
        REQUIRE(result.exit_code == 0);
        std::istringstream lines(result.out);
        // One rank per node measures the times of studies.
        int nodes = 0;
        lines >> nodes;
        CHECK(nodes == 1);
        std::vector<Stage> stages;
        for (Stage one; lines >> one.rank >> one.kind >> one.begin >> one.end;)
            stages.push_back(one);
        CHECK(stages.size() == 60u * static_cast<std::size_t>(ranks));
        int together = 0;
        for (const Stage& timed : stages)
            for (const Stage& other : stages)
                if (timed.kind == "timed" && timed.rank != other.rank && timed.begin < other.end &&
                    other.begin < timed.end)
                    ++together;
        CHECK(together == 0);
    }
}

TEST_CASE("ranks share frames, and a second job renders the missing ones", "[mpi]")
{
    const TempFolder folder;
    write_text(
        folder / "a.scene",
        "image_size = 19 x 13\nanimation { frames = 7  orbit { center = (0, 0, 3) } }\n"
        "sphere { center = (0, 1, 3)  radius = 1  color = (200, 40, 30)  reflective = 0.3 }\n"
        "light { type = ambient  intensity = 0.5 }\n");
    const auto words = [&](const std::string& name) {
        return Words{"render", folder / "a.scene", "--frames", "0..6", "-o", folder / name};
    };
    REQUIRE(run_packtrace(words("w%d.pfm")).exit_code == 0);
    for (const int ranks : ranks_tested) {
        CAPTURE(ranks);
        CHECK(run_ranks(ranks, words("m%d.pfm")).exit_code == 0);
        for (int frame = 0; frame < 7; ++frame)
            CHECK(read_text(folder / ("m" + std::to_string(frame) + ".pfm")) ==
                  read_text(folder / ("w" + std::to_string(frame) + ".pfm")));
        std::filesystem::remove(folder / "m3.pfm");
        const ProgramResult again = run_ranks(ranks, words("m%d.pfm"));
        CHECK(again.exit_code == 0);
        CHECK_THAT(again.err, ContainsSubstring("6 frames were there already"));
        for (int frame = 0; frame < 7; ++frame)
            std::filesystem::remove(folder / ("m" + std::to_string(frame) + ".pfm"));
    }
    // The report of cut rays covers all ranks' frames.
    Words cut = words("m%d.pfm");
    cut.insert(cut.end(), {"--min-weight", "0.5"});
    const std::string said = run_packtrace(cut).err;
    for (int frame = 0; frame < 7; ++frame)
        std::filesystem::remove(folder / ("m" + std::to_string(frame) + ".pfm"));
    const ProgramResult jobs = run_ranks(2, cut);
    CHECK_THAT(said, ContainsSubstring(" not traced; "));
    CHECK_THAT(jobs.err, ContainsSubstring(said.substr(said.find('\n') + 1)));
    for (int frame = 0; frame < 7; ++frame)
        std::filesystem::remove(folder / ("m" + std::to_string(frame) + ".pfm"));
    std::filesystem::create_directory(folder / "m3.pfm");
    const ProgramResult result = run_ranks(3, words("m%d.pfm"));
    CHECK(result.exit_code == 1);
    REQUIRE(own_lines(result.err).size() == 1);
    CHECK_THAT(result.err, ContainsSubstring("m3.pfm: can't write"));
}

TEST_CASE("hits have the bytes of one process for any number of ranks", "[mpi]")
{
    const TempFolder folder;
    std::string rays = many_rays(12000) + "\n";
    write_text(folder / "rays.csv", rays);
    for (const Words& query : {Words{}, Words{"--all"}, Words{"--any", "--precision", "single"}}) {
        Words words{"intersect", four_spheres_file, folder / "rays.csv", "-o", folder / "w.csv"};
        words.insert(words.end(), query.begin(), query.end());
        REQUIRE(run_packtrace(words).exit_code == 0);
        for (const int ranks : ranks_tested) {
            CAPTURE(query, ranks);
            words[4] = folder / "m.csv";
            CHECK(run_ranks(ranks, words).exit_code == 0);
            CHECK((read_text(folder / "m.csv") == read_text(folder / "w.csv")));
        }
    }
    // A header after comments longer than a piece does not count as a ray.
    std::string comments;
    for (int i = 0; i < 4000; ++i)
        comments += "# a comment of some length\n";
    write_text(folder / "late.csv", comments + rays);
    Words late{"intersect", four_spheres_file, folder / "late.csv",
               "-o",        folder / "w.csv",  "--all"};
    REQUIRE(run_packtrace(late).exit_code == 0);
    late[4] = folder / "m.csv";
    CHECK(run_ranks(2, late).exit_code == 0);
    CHECK((read_text(folder / "m.csv") == read_text(folder / "w.csv")));
    // Of two wrong lines the first is reported.
    rays += "1,2,3,0,0,0\n1,2,3,0,0,four\n";
    write_text(folder / "rays.csv", "1,2,3,0,0,1\n" + rays.substr(rays.find('\n', 10) + 1));
    const Words words{"intersect", four_spheres_file, folder / "rays.csv", "-o", folder / "x.csv"};
    const ProgramResult one = run_packtrace(words);
    for (const int ranks : {1, 3}) {
        const ProgramResult many = run_ranks(ranks, words);
        CHECK(many.exit_code == 1);
        CHECK((own_lines(many.err) == own_lines(one.err)));
        CHECK_FALSE(std::filesystem::exists(folder / "x.csv"));
    }
}

TEST_CASE("a job reports what it can't do in one line, once", "[mpi]")
{
    const TempFolder folder;
    struct Wrong {
        Words words;
        int exit_code;
        std::string message;
    };
    const std::string picture = folder / "a.png";
    std::filesystem::create_symlink("/dev/full", folder / "full.pfm");
    write_text(folder / "bad.scene", "sphere { radius = -1 }\n");
    const std::vector<Wrong> wrongs = {
        {{"render", folder / "none.scene", "-o", picture}, 1, "none.scene: can't be opened"},
        {{"render", folder / "bad.scene", "-o", picture}, 1, "bad.scene:1"},
        {{"render", "generate randm", "-o", picture}, 1, "did you mean random?"},
        {{"render", "generate random --help", "-o", picture},
         1,
         "asks for help in place of a scene"},
        {{"render", four_spheres_file, "-o", folder / "none/a.png"}, 1, "a.png: can't write"},
        {{"render", four_spheres_file, "-o", folder / "full.pfm", "--size", "1000x2000"},
         1,
         "full: can't write"},
        {{"render", four_spheres_file, "-o", picture, "--gama", "2"}, 2, "did you mean --gamma?"},
        {{"render", four_spheres_file, "-o", picture, "--isa", "mmx"}, 2, "mmx"},
        {{"render", four_spheres_file, "-o", picture, "--y4m"}, 2, "--y4m: "},
        {{"render", four_spheres_file, "-o", picture, "--certainty", "c.png"}, 2, "--certainty: "},
        {{"render", four_spheres_file, "-o", picture, "--fps", "3"},
         2,
         "render: --fps: is of videos, and ranks write frames; leave it out; see"},
        {{"render", four_spheres_file, "-o", picture, "--fps"}, 2, "render: --fps: is of videos"},
        {{"render", four_spheres_file, "-o", picture, "--shard", "none"}, 2, "render: --shard: "},
        // --fps is not suggested.
        {{"render", four_spheres_file, "-o", picture, "--foo"}, 2, "'--foo'; see"},
        {{"intersect", four_spheres_file, folder / "none.csv"}, 1, "none.csv: can't read"},
        {{"stress", "--family", "none"}, 2, "--family: "},
        {{"stress", "--isa", "mmx"}, 2, "mmx"},
        {{"stress", "--list", "--rays", "10"}, 2, "--rays: --list traces no rays"},
        {{"report", folder / "none.scene", "-o", folder / "r"}, 1, "none.scene: can't be opened"},
        {{"report", "-", "-", "-o", folder / "r"}, 1, "give - for one scene only"},
        {{"report", four_spheres_file, "-o", folder / "bad.scene/r"}, 1, "can't make this folder"},
        {{"report", four_spheres_file, "-o", folder / "r", "--truth-spp", "2"}, 1, "cannot judge"},
        {{}, 2, "subcommand"},
    };
    for (const Wrong& wrong : wrongs) {
        CAPTURE(wrong.words);
        const ProgramResult result = run_ranks(3, wrong.words);
        CHECK(result.exit_code == wrong.exit_code);
        CHECK_THAT(result.err, ContainsSubstring(wrong.message));
        CHECK(own_lines(result.err).size() == 1);
        CHECK(result.out.empty());
        CHECK_FALSE(std::filesystem::exists(picture));
    }
    CHECK(run_ranks(2, {"--version"}).exit_code == 0);
    // Ranks with orders for different work, and one with an unknown option.
    for (const Words& other : {Words{"--spp", "4"}, Words{"--gama", "2"}}) {
        // The script selects by rank number, because mpirun of Open MPI 5.0.7 crashes on a second
        // program after a colon.
        std::string script = "[ \"$OMPI_COMM_WORLD_RANK\" = 0 ] || set -- \"$@\"";
        for (const std::string& word : other)
            script += " " + shell_quoted(word);
        Words job = mpirun(2, "sh");
        job.insert(job.end(), {"-c", script + "; exec \"$0\" \"$@\"", PACKTRACE_MPI, "render",
                               four_spheres_file, "-o", picture, "--size", "16x12"});
        const ProgramResult result = run_command(job);
        CHECK(result.exit_code == 2);
        CHECK_THAT(result.err, ContainsSubstring("rank 1 and rank 0 have different arguments"));
        CHECK(own_lines(result.err).size() == 1);
        CHECK_FALSE(std::filesystem::exists(picture));
    }
}

TEST_CASE("a job whose results do not fit on standard output ends with exit code 1", "[mpi]")
{
    const TempFolder folder;
    const std::vector<Words> all = {
        {"--help"},
        {"--version"},
        {"render", "--help"},
        {"stress", "--list"},
        {"stress", "--rays", "16", "--family", "grazing", "--isa", "sse42"},
        {"stress", "--rays", "16", "--family", "grazing", "--isa", "sse42", "--json"},
        {"render", four_spheres_file, "--size", "16x12", "--json", "-o", folder / "a.png"},
        {"report", four_spheres_file, "--size", "16x12", "--quick", "-q", "--repetitions", "1",
         "--max-error", "1", "-o", folder / "r"}};
    for (const Words& words : all) {
        // A rank that mpirun starts writes into a pipe to mpirun.
        std::string command = shell_quoted(PACKTRACE_MPI);
        for (const std::string& word : words)
            command += " " + shell_quoted(word);
        for (const std::string lost : {"/dev/full", "&-"}) {
            const ProgramResult result = run_command({"sh", "-c", command + " >" + lost});
            CAPTURE(words, lost, result.err);
            CHECK(result.exit_code == 1);
            CHECK_THAT(
                result.err,
                ContainsSubstring(lost == "&-" ? "standard output: can't write: Bad file descriptor"
                                               : "standard output: can't write: No space left"));
        }
    }
}

TEST_CASE("a job's messages show control characters in names as they are written", "[mpi]")
{
    const TempFolder folder;
    const std::string name = folder / "a\n\033[31m.scene";
    for (const Words& words : {Words{"render", name, "-o", folder / "a.png"},
                               Words{"render", four_spheres_file, "-o", name + "/a.png"},
                               Words{"render", four_spheres_file, "-o", folder / "a.png", name}}) {
        CAPTURE(words);
        const ProgramResult result = run_ranks(2, words);
        CHECK(result.exit_code != 0);
        CHECK_THAT(result.err, ContainsSubstring("a\\x0a\\x1b[31m.scene"));
        CHECK(result.err.find('\033') == std::string::npos);
        CHECK(own_lines(result.err).size() == 1);
    }
}

TEST_CASE("a rank that dies ends the job with a line, and --resume continues it", "[mpi]")
{
    const TempFolder folder;
    REQUIRE(run_packtrace(render_high(folder / "w.png")).exit_code == 0);
    for (std::size_t victim = 0; victim < 3; ++victim) {
        CAPTURE(victim);
        const int code = kill_rank(3, render_high(folder / "m.png"), victim, folder / "err",
                                   [&] { return lines_of(folder / "m.png.journal") >= 3; });
        REQUIRE(code > 0);
        CHECK_FALSE(std::filesystem::exists(folder / "m.png"));
        const std::string err = read_text(folder / "err");
        CAPTURE(err);
        CHECK((err.find("packtrace-mpi: the job ended with ") != std::string::npos ||
               err.find("packtrace-mpi: rank 0 died") != std::string::npos));
        const ProgramResult result = run_ranks(victim == 0 ? 2 : 1, render_high(folder / "m.png"));
        CHECK(result.exit_code == 0);
        CHECK((read_text(folder / "m.png") == read_text(folder / "w.png")));
        std::filesystem::remove(folder / "m.png");
        CHECK(folder.names() == Words{"err", "w.png"});
    }
}

TEST_CASE("an interrupted job of rays says in its own name how to continue", "[mpi]")
{
    const TempFolder folder;
    std::string rays;
    for (int i = 0; i < 400000; ++i)
        rays += "0,0,0,0," + std::to_string(i) + ",1\n";
    write_text(folder / "rays.csv", rays);
    const std::string hits = folder / "hits.csv";
    const Words words{"intersect", four_spheres_file, folder / "rays.csv", "-o", hits, "--resume"};
    // The journal has two lines before the first piece.
    const std::string begun =
        errors_of_ended(words, folder / "err", [&] { return lines_of(hits + ".journal") >= 3; });
    CHECK_THAT(begun, ContainsSubstring("packtrace-mpi: interrupted; the same command goes on "));
    // The job waits for a scene that does not arrive.
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    Words waiting = words;
    waiting[1] = folder / "pipe";
    const int pipe = open((folder / "pipe").c_str(), O_RDWR);
    const auto start = std::chrono::steady_clock::now();
    const std::string early = errors_of_ended(waiting, folder / "err", [&] {
        return std::chrono::steady_clock::now() - start > std::chrono::seconds(2);
    });
    close(pipe);
    CHECK_THAT(early, ContainsSubstring("packtrace-mpi: interrupted; finished work is kept where "
                                        "--resume was given"));
}

TEST_CASE("a job ended by mpirun says so and leaves no file, however long its tiles take", "[mpi]")
{
    const TempFolder folder;
    const Words words{"render",        mpi_scene("whitted"), "--size", "1000x2000", "--spp",
                      "1024",          "--threads",          "1",      "-q",        "-o",
                      folder / "m.png"};
    // Rank 0 has the picture's temporary file, whose name contains its process id.
    const auto first_process = [&]() -> pid_t {
        for (const std::string& name : folder.names())
            if (name.starts_with(".m.png."))
                return std::atoi(name.c_str() + std::string(".m.png.").size());
        return 0;
    };
    for (int i = 0; i < 6; ++i) {
        const int code =
            kill_rank(5, words, folder / "err", [&](const std::vector<pid_t>& children) -> pid_t {
                const pid_t first = first_process();
                if (first == 0)
                    return 0;
                // Each rank has begun its first tile. When the first ends by SIGTERM, mpirun kills
                // all.
                std::this_thread::sleep_for(std::chrono::milliseconds(300));
                return first == children.back() ? children.front() : children.back();
            });
        CHECK(code > 0);
        CHECK_THAT(read_text(folder / "err"),
                   ContainsSubstring("packtrace-mpi: the job ended after 0 of 8 bands"));
        CHECK(folder.names() == Words{"err"});
    }
}

TEST_CASE("ranks killed at random moments lose nothing", "[mpi][slow]")
{
    const TempFolder folder;
    REQUIRE(run_packtrace(render_high(folder / "w.png")).exit_code == 0);
    std::uint32_t random = 1;
    for (std::size_t i = 0; i < 25; ++i) {
        random = random * 1664525u + 1013904223u;
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(random >> 21);
        (void)kill_rank(3, render_high(folder / "m.png"), random >> 8, folder / "err",
                        [&] { return std::chrono::steady_clock::now() > end; });
        CHECK((!std::filesystem::exists(folder / "m.png") ||
               read_text(folder / "m.png") == read_text(folder / "w.png")));
        if (i % 5 != 4)
            continue;
        CHECK(run_ranks(2, render_high(folder / "m.png")).exit_code == 0);
        CHECK((read_text(folder / "m.png") == read_text(folder / "w.png")));
        std::filesystem::remove(folder / "m.png");
        CHECK((folder.names() == Words{"err", "w.png"}));
    }
}

#endif

}  // namespace packtrace::test
