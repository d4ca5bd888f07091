#include "lab/harness/report_variants.hpp"

#include "core/check_number.hpp"
#include "core/text.hpp"
#include "dispatch/kernels.hpp"
#include "kernel_abi/probe.hpp"
#include "render/frame_renderer.hpp"
#include "render/option_words.hpp"
#include "render/precision.hpp"
#include <packtrace/isa.hpp>

#include <algorithm>
#include <memory>

namespace packtrace {
namespace {

std::vector<IsaInfo> wanted_isas(const ReportOptions& options)
{
    std::vector<std::string> names;
    for (const std::string& name : options.isas)
        names.push_back(choose_isa(name).name);
    std::vector<IsaInfo> isas;
    for (const IsaInfo& isa : list_isas())
        if (isa.supported &&
            (names.empty() || std::count(names.begin(), names.end(), isa.name) > 0))
            isas.push_back(isa);
    return isas;
}

Variant packets(const IsaInfo& isa, Precision precision, const Scene& scene)
{
    Variant variant;
    variant.precision = precision;
    variant.isa = isa.name;
    variant.lanes = precision == Precision::single ? isa.lanes_single : isa.lanes_double;
    variant.depth = scene.max_depth;
    variant.min_weight = scene.min_weight;
    return variant;
}

// A variant that differs from the usual packets of singles in one thing, which `how` names.
Variant differing(Variant variant, const std::string& how, const ReportOptions& options)
{
    variant.study = Study::arithmetic;
    variant.threads = options.threads.front();
    variant.name =
        "packets " + variant.isa + " single " + how + ", " + counted(variant.threads, "thread");
    return variant;
}

// With another accuracy.
Variant in_mode(const Variant& usual, Accuracy accuracy, const ReportOptions& options)
{
    Variant variant = differing(usual, std::string(language::word_of(accuracy)), options);
    variant.accuracy = accuracy;
    return variant;
}

// With secondary rays from t = 0.001 on, as in the notes.
Variant by_note(const Variant& usual, const ReportOptions& options)
{
    Variant variant = differing(usual, "from 0.001", options);
    variant.self_hits = SelfHits::note;
    return variant;
}

// With the general kernel.
Variant by_general(const Variant& usual, const ReportOptions& options)
{
    Variant variant = differing(usual, "general kernel", options);
    variant.general = true;
    return variant;
}

Variant scalar(Precision precision, const Scene& scene)
{
    Variant variant;
    variant.kernel = Kernel::scalar;
    variant.precision = precision;
    variant.depth = scene.max_depth;
    variant.min_weight = scene.min_weight;
    return variant;
}

void add_arithmetic(std::vector<Variant>& variants, Variant variant, const ReportOptions& options)
{
    variant.study = Study::arithmetic;
    const std::string kernel =
        variant.kernel == Kernel::scalar ? "scalar" : "packets " + variant.isa;
    for (const int threads : options.threads) {
        variant.threads = threads;
        variant.name = kernel + " " + std::string(language::word_of(variant.precision)) + ", " +
                       counted(threads, "thread");
        variants.push_back(variant);
    }
}

void add_depths(std::vector<Variant>& variants, Variant variant, const Scene& scene)
{
    variant.study = Study::depth;
    for (int depth = 0; depth <= scene.max_depth; ++depth) {
        variant.depth = depth;
        variant.name = "depth " + std::to_string(depth);
        variants.push_back(variant);
    }
}

void add_weights(std::vector<Variant>& variants, Variant variant, const ReportOptions& options)
{
    variant.study = Study::weight;
    for (const double weight : options.min_weights) {
        variant.min_weight = weight;
        variant.name = weight == 0.0 ? "all weights" : "weights from " + brief(weight, 3);
        variants.push_back(variant);
    }
}

void add_samplings(std::vector<Variant>& variants, Variant variant, const ReportOptions& options)
{
    variant.study = Study::sampling;
    for (const int samples : options.samples) {
        variant.samples = samples;
        variant.name = "spp " + std::to_string(samples);
        variants.push_back(variant);
    }
    for (const auto& [samples, contrast] : options.adaptive) {
        variant.samples = samples;
        variant.adaptive = contrast;
        variant.name = "adaptive " + std::to_string(samples) + " at " + brief(contrast, 6);
        variants.push_back(variant);
    }
}

}  // namespace

std::vector<Variant> report_variants(const Scene& scene, const ReportOptions& options)
{
    for (const int threads : options.threads)
        check_number("threads", threads, 1, most_threads);
    std::vector<Variant> variants;
    const std::vector<IsaInfo> isas = wanted_isas(options);
    for (const Precision precision : packet_precisions) {
        add_arithmetic(variants, scalar(precision, scene), options);
        for (const IsaInfo& isa : isas)
            add_arithmetic(variants, packets(isa, precision, scene), options);
    }
    const Variant widest = packets(isas.back(), Precision::single, scene);
    variants.push_back(in_mode(widest, Accuracy::fast, options));
    variants.push_back(by_note(widest, options));
    variants.push_back(by_general(widest, options));
    add_depths(variants, widest, scene);
    add_weights(variants, widest, options);
    add_samplings(variants, widest, options);
    return variants;
}

namespace {

RenderOptions options_of(const Variant& variant)
{
    RenderOptions options{.kernel = variant.kernel};
    if (variant.kernel == Kernel::packet)
        options.isa = variant.isa;
    options.accuracy = variant.accuracy;
    options.self_hits = variant.self_hits;
    options.force_general = variant.general;
    options.threads = variant.threads;
    options.samples = variant.samples;
    options.adaptive = variant.adaptive;
    return options;
}

// One sample per pixel is the scene's own; in the study of sampling it is the pixel's centre.
Scene scene_of(Scene scene, const Variant& variant)
{
    scene.max_depth = variant.depth;
    scene.min_weight = variant.min_weight;
    if (variant.study == Study::sampling)
        scene.camera.pixel_sample = Vec2(0.5);
    return scene;
}

template <class Real>
Subject scalar_subject(const Scene& scene, const Variant& variant)
{
    struct Frame {
        Image<Real> image;
        CutRays cut;
    };
    const auto frame = std::make_shared<Frame>();
    Subject subject;
    subject.variant = variant;
    subject.render = [frame, scene, options = options_of(variant)] {
        frame->image = render<Real>(scene, options, &frame->cut);
    };
    subject.picture = [frame] { return convert<double>(frame->image); };
    subject.cut = [frame] { return frame->cut; };
    subject.rays = [] { return std::uint64_t{0}; };
    if (variant.samples == 1)
        subject.tree = reference_trees<Real>(scene);
    return subject;
}

template <class Real>
Subject subject_in(const Scene& given, const Variant& variant)
{
    const Scene scene = scene_of(given, variant);
    if (variant.kernel == Kernel::scalar)
        return scalar_subject<Real>(scene, variant);
    const LoweredScene lowered = lower_for<Real>(scene, options_of(variant));
    return packet_subject<Real>(scene, lowered, kernels_of(variant.isa), variant);
}

}  // namespace

template <class Real>
Subject packet_subject(const Scene& scene, const LoweredScene& lowered,
                       const abi::KernelTable& table, const Variant& variant)
{
    struct Frame {
        FrameRenderer<Real> renderer;
        Image<Real> image;
        FrameCounts counts;

        Frame(const Scene& of, const LoweredScene& from, const abi::KernelTable& by,
              const RenderOptions& options)
            : renderer(of, from, by, options)
        {
        }
    };
    const auto frame = std::make_shared<Frame>(scene, lowered, table, options_of(variant));
    Subject subject;
    subject.variant = variant;
    subject.render = [frame] { frame->counts = frame->renderer.render(frame->image); };
    subject.picture = [frame] { return convert<double>(frame->image); };
    subject.rays = [frame] { return frame->counts.total(); };
    subject.cut = [frame] { return frame->counts.cut; };
    if (variant.samples == 1 && scene.max_depth <= abi::longest_path<Real>)
        subject.tree = packet_trees<Real>(scene, lowered, table);
    return subject;
}

Subject subject_of(const Scene& scene, const Variant& variant)
{
    return with_packet_real(variant.precision,
                            [&]<class Real>() { return subject_in<Real>(scene, variant); });
}

template Subject packet_subject<float>(const Scene&, const LoweredScene&, const abi::KernelTable&,
                                       const Variant&);
template Subject packet_subject<double>(const Scene&, const LoweredScene&, const abi::KernelTable&,
                                        const Variant&);

}  // namespace packtrace
