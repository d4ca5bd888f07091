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

// Error against run time: a scene rendered in many ways, each timed and held against the truth.
namespace packtrace {

/// What a set of runs varies, and so what its truth is: for `sampling` the mean over each pixel,
/// for the others the colour at each pixel's one sample.
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
    int depth = 0;            ///< Scene::max_depth
    double min_weight = 0.0;  ///< Scene::min_weight
    int samples = 1;          ///< as RenderOptions has them
    std::optional<double> adaptive = {};
};

/// Whether the accuracy mode makes a difference.
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
    std::vector<std::string> isas = {};  ///< none: all this machine runs
    std::vector<double> min_weights{0.1, 0.03, 0.01, 1.0 / 255.0, 0.002, 0.0005, 0.0};
    std::vector<int> samples{1, 4, 16, 64};
    /// Samples and contrast of adaptive sampling.
    std::vector<std::pair<int, double>> adaptive{{16, 0.05}, {16, 0.01}, {20, 0.01}, {64, 0.01}};
    int repetitions = 9;               ///< of each run, taken in turns
    int truth_samples = 256;           ///< a pixel, of the truth of Study::sampling
    double threshold = 1.0 / 255.0;    ///< a pixel further off counts as off
    int classified = 128;              ///< pixels of a picture whose rays are compared, at most
    double max_error = 1e-3;           ///< RMSE that the cheapest run is sought for
    double max_time = 0.02;            ///< seconds that the most exact run is sought for
    std::filesystem::path cache = {};  ///< folder of truths; none where empty
    /// What is being done, and the share of it done, in [0, 1]. May be called from any thread.
    std::function<void(const std::string& what, double share)> progress = {};
    /// When a stop is requested the report throws StopError, a frame later.
    std::stop_token stop = {};
};

/// How many of the pixels looked at are off for one reason (lab/report/error_class.hpp).
struct ErrorShare {
    std::string kind;
    std::string meaning;
    int pixels = 0;
    double squared_error = 0.0;  ///< their part of the squared error of those looked at, in [0, 1]
};

/// How a run stands among those of its study. Times are told apart only where the middle halves of
/// their repetitions do not overlap.
enum class Pareto {
    beaten,     ///< another run is as exact, and faster
    undecided,  ///< another run is as exact, and perhaps as fast
    on_front    ///< every run that is as exact is slower
};

/// What came of a variant.
struct ReportRun {
    Variant variant;
    std::vector<double> seconds;  ///< by repetition
    double median = 0.0;          ///< seconds
    double spread = 0.0;          ///< of the middle half of the repetitions, over the median
    std::uint64_t rays = 0;       ///< of a frame; 0 for the reference, which does not count
    CutRays cut = {};             ///< of a frame
    Comparison error;
    int looked_at = 0;  ///< pixels whose rays were compared
    /// Whether these are among those that are off, rather than the worst of a picture without.
    bool looked_at_off = true;
    std::vector<ErrorShare> shares;  ///< largest first, none that are empty
    Pareto pareto = Pareto::beaten;
    std::size_t picture = 0;  ///< index in StudyReport::pictures
};

struct ReportPicture {
    std::string name;   ///< of the first variant that gave it, as a file's name
    std::string label;  ///< that variant's own name; "truth"
    Image<double> image;
};

/// The runs of one study. `pictures` are told apart bit by bit; the first is the truth.
struct StudyReport {
    Study study = Study::arithmetic;
    std::string truth;           ///< what it is
    double truth_seconds = 0.0;  ///< what it took when it was made
    bool truth_cached = false;
    std::vector<ReportRun> runs;
    std::vector<ReportPicture> pictures;
};

struct SceneReport {
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<StudyReport> studies;
};

/// The ways a scene is rendered in a report: a further one is one more row here.
[[nodiscard]] PACKTRACE_API std::vector<Variant> report_variants(const Scene& scene,
                                                                 const ReportOptions& options);

/// Renders a scene in all these ways. Throws what render() does.
[[nodiscard]] PACKTRACE_API SceneReport report(const ReportScene& scene,
                                               const ReportOptions& options = {});

/// A run to take, and others that may be the one instead: the spreads of their times don't tell.
struct RunChoice {
    const ReportRun* run = nullptr;  ///< null when there is none
    std::vector<const ReportRun*> undecided;
};

/// The fastest of the runs with an RMSE of at most `error`; undecided are those among them that
/// may be as fast.
[[nodiscard]] PACKTRACE_API RunChoice cheapest_within(const StudyReport& study, double error);

/// The run of least RMSE whose times stay within `seconds`; undecided are more exact ones whose
/// times lie on both sides of it.
[[nodiscard]] PACKTRACE_API RunChoice most_exact_within(const StudyReport& study, double seconds);

}  // namespace packtrace
