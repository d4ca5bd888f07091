#pragma once

#include <packtrace/compare.hpp>
#include <packtrace/export.hpp>
#include <packtrace/image.hpp>
#include <packtrace/render.hpp>
#include <packtrace/scene.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

// Error against run time: a scene is rendered in many ways, and each is timed and compared with the
// truth.
namespace packtrace {

/// What the runs of a study vary. The truth of `sampling` is the mean over each pixel; for the
/// other studies it is the colour at each pixel's only sample.
enum class Study { arithmetic, depth, weight, sampling };

/// One way to render a scene.
struct Variant {
    std::string name;  ///< "packets single avx2, 2 threads"
    Study study = Study::arithmetic;
    Kernel kernel = Kernel::packet;
    Precision precision = Precision::single;  ///< or double_
    std::string isa;                          ///< packets only
    Accuracy accuracy = Accuracy::exact;      ///< packets of floats only
    SelfHits self_hits = default_self_hits;
    bool general = false;  ///< RenderOptions::force_general
    int lanes = 1;         ///< rays in a packet
    int threads = 1;
    int depth = 0;                        ///< Scene::max_depth
    double min_weight = 0.0;              ///< Scene::min_weight
    int samples = 1;                      ///< RenderOptions::samples
    std::optional<double> adaptive = {};  ///< RenderOptions::adaptive
};

/// Whether the variant depends on its accuracy mode.
[[nodiscard]] inline bool has_accuracy(const Variant& variant)
{
    return variant.kernel == Kernel::packet && variant.precision == Precision::single;
}

struct ReportScene {
    std::string name;
    Scene scene;
};

struct ReportOptions {
    std::vector<int> threads{1, 2};
    std::vector<std::string> isas = {};  ///< empty: all that this machine supports
    std::vector<double> min_weights{0.1, 0.03, 0.01, 1.0 / 255.0, 0.002, 0.0005, 0.0};
    std::vector<int> samples{1, 4, 16, 64};
    /// Pairs of samples and contrast for adaptive sampling.
    std::vector<std::pair<int, double>> adaptive{{16, 0.05}, {16, 0.01}, {20, 0.01}, {64, 0.01}};
    int repetitions = 9;               ///< of each run; the runs take turns
    int truth_samples = 256;           ///< per pixel, for the truth of Study::sampling
    double threshold = 1.0 / 255.0;    ///< a pixel with a larger error counts as off
    int classified = 128;              ///< most pixels of a picture whose rays are compared
    double max_error = 1e-3;           ///< RMSE limit for the cheapest run
    double max_time = 0.02;            ///< time limit for the most exact run, seconds
    std::filesystem::path cache = {};  ///< folder that stores truths; empty: they are not stored
    /// Receives the present activity and the share of it that is done, in [0, 1]. May be called
    /// from any thread.
    std::function<void(const std::string& what, double share)> progress = {};
    /// After a stop request the report throws StopError, one frame later.
    std::stop_token stop = {};
};

/// The compared pixels that are off for one reason (lab/report/error_class.hpp).
struct ErrorShare {
    std::string kind;
    std::string meaning;
    int pixels = 0;
    double squared_error = 0.0;  ///< their share of the compared pixels' squared error, in [0, 1]
};

/// The rank of a run in its study. Two times count as different only if the middle halves of their
/// repetitions do not overlap.
enum class Pareto {
    beaten,     ///< another run is at least as exact, and faster
    undecided,  ///< another run is at least as exact, and perhaps as fast
    on_front    ///< every run that is at least as exact is slower
};

/// The result of a variant.
struct ReportRun {
    Variant variant;
    std::vector<double> seconds;  ///< by repetition
    double median = 0.0;          ///< seconds
    double spread = 0.0;          ///< width of the middle half of the repetitions / median
    std::uint64_t rays = 0;       ///< of a frame; 0 for the reference, which does not count rays
    CutRays cut = {};             ///< of a frame
    Comparison error;
    int looked_at = 0;  ///< pixels whose rays were compared
    /// True: these pixels are off. False: no pixel is off, and these are the worst of the picture.
    bool looked_at_off = true;
    std::vector<ErrorShare> shares;  ///< largest first, without empty ones
    Pareto pareto = Pareto::beaten;
    std::size_t picture = 0;  ///< index in StudyReport::pictures
};

struct ReportPicture {
    std::string name;   ///< name of the first variant with this picture, as a file name
    std::string label;  ///< name of that variant; or "truth"
    Image<double> image;
};

/// The runs of one study. `pictures` has each picture that differs in some bit once; the first is
/// the truth.
struct StudyReport {
    Study study = Study::arithmetic;
    std::string truth;           ///< a description of the truth
    double truth_seconds = 0.0;  ///< the time it took to make the truth
    bool truth_cached = false;   ///< the truth was read from the cache
    std::vector<ReportRun> runs;
    std::vector<ReportPicture> pictures;
};

struct SceneReport {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<StudyReport> studies;
};

/// The variants of a report.
[[nodiscard]] PACKTRACE_API std::vector<Variant> report_variants(const Scene& scene,
                                                                 const ReportOptions& options);

/// Renders a scene in all variants of report_variants(). Throws as render() does.
[[nodiscard]] PACKTRACE_API SceneReport report(const ReportScene& scene,
                                               const ReportOptions& options = {});

/// The best run, and runs that may be better, because the spreads of the times overlap.
struct RunChoice {
    const ReportRun* run = nullptr;  ///< null if no run qualifies
    std::vector<const ReportRun*> undecided;
};

/// The fastest run with an RMSE of at most `error`. Undecided: the runs within that error that may
/// be as fast.
[[nodiscard]] PACKTRACE_API RunChoice cheapest_within(const StudyReport& study, double error);

/// The run with the smallest RMSE among those whose times stay within `seconds`. Undecided: more
/// exact runs, some of whose times are within `seconds` and some above.
[[nodiscard]] PACKTRACE_API RunChoice most_exact_within(const StudyReport& study, double seconds);

}  // namespace packtrace
