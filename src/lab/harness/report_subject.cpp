#include "lab/harness/report_subject.hpp"

#include <memory>

#include "dispatch/kernels.hpp"
#include "kernel_abi/probe.hpp"
#include "render/frame_renderer.hpp"

namespace packtrace {
namespace {

RenderOptions options_of(const Variant& variant)
{
    RenderOptions options;
    options.kernel = variant.kernel;
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

// One sample a pixel is the scene's own, but where samples are studied it is the centre.
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
    const LoweredScene lowered =
        lower(scene, accuracy_in<Real>(options_of(variant)), variant.self_hits);
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
    return variant.precision == "single" ? subject_in<float>(scene, variant)
                                         : subject_in<double>(scene, variant);
}

template Subject packet_subject<float>(const Scene&, const LoweredScene&, const abi::KernelTable&,
                                       const Variant&);
template Subject packet_subject<double>(const Scene&, const LoweredScene&, const abi::KernelTable&,
                                        const Variant&);

}  // namespace packtrace
