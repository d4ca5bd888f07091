#include "bindings.hpp"
#include "interrupt.hpp"
#include "lab/report/report_text.hpp"
#include "pictures.hpp"
#include "scene.hpp"
#include "values.hpp"
#include "words.hpp"
#include <packtrace/report.hpp>

#include <utility>

namespace packtrace::python {
namespace {

using namespace py::literals;

py::object or_none(const std::string& text)
{
    return text.empty() ? py::object(py::none()) : py::str(text);
}

/// A run with the columns of report.csv.
py::dict row_of(const SceneReport& scene, const StudyReport& study, const ReportRun& run)
{
    const Variant& variant = run.variant;
    const bool counted = run.rays > 0;
    return py::dict(
        "scene"_a = scene.name, "width"_a = scene.width, "height"_a = scene.height,
        "study"_a = name_of(study.study), "run"_a = variant.name,
        "kernel"_a = word_of(variant.kernel), "precision"_a = word_of(variant.precision),
        "isa"_a = or_none(variant.isa),
        "accuracy"_a =
            has_accuracy(variant) ? py::object(py::str(word_of(variant.accuracy))) : py::none(),
        "lanes"_a = variant.lanes, "threads"_a = variant.threads, "depth"_a = variant.depth,
        "min_weight"_a = variant.min_weight, "samples"_a = variant.samples,
        "adaptive"_a = variant.adaptive ? py::object(py::float_(*variant.adaptive)) : py::none(),
        "median_s"_a = run.median, "spread"_a = run.spread,
        "rays"_a = counted ? py::object(py::int_(run.rays)) : py::none(),
        "cut_rays"_a = run.cut.rays, "cut_bound"_a = run.cut.bound, "rmse"_a = run.error.rmse,
        "max_abs"_a = run.error.max_abs, "psnr"_a = run.error.psnr, "pixels"_a = run.error.pixels,
        "pixels_off"_a = run.error.pixels_off, "pareto"_a = name_of(run.pareto),
        "errors"_a = or_none(shares_text(run)));
}

template <class T>
void read_list(py::handle values, const std::string& key, std::vector<T>& to)
{
    if (values.is_none())
        return;
    to.clear();
    for (const py::object& value : elements_of(values, key))
        to.push_back(value_of<T>(value, key));
}

void read_adaptive(py::handle values, std::vector<std::pair<int, double>>& to)
{
    if (values.is_none())
        return;
    to.clear();
    for (const py::object& value : elements_of(values, "adaptive")) {
        const std::vector<py::object> pair = elements_of(value, "adaptive");
        if (pair.size() != 2)
            throw_wrong("adaptive", values, "pairs of samples and contrast, such as [(16, 0.01)]");
        to.emplace_back(value_of<int>(pair[0], "adaptive"), value_of<double>(pair[1], "adaptive"));
    }
}

py::list report_scene(py::handle value, py::handle name, py::handle threads, py::handle isas,
                      py::handle min_weights, py::handle samples, py::handle adaptive,
                      py::handle repetitions, py::handle truth_samples, py::handle threshold,
                      const py::object& call)
{
    ReportOptions options;
    read_list(threads, "threads", options.threads);
    read_list(isas, "isas", options.isas);
    read_list(min_weights, "min_weights", options.min_weights);
    read_list(samples, "samples", options.samples);
    read_adaptive(adaptive, options.adaptive);
    from_python(repetitions, "repetitions", options.repetitions);
    from_python(truth_samples, "truth_samples", options.truth_samples);
    from_python(threshold, "threshold", options.threshold);
    Interrupt interrupt;
    options.progress = [&](const std::string& what, double share) {
        interrupt.call(call, what, share);
    };
    options.stop = interrupt.stop();
    const ReportScene scene{value_of<std::string>(name, "name"), scene_of(value)};
    SceneReport made;
    run_interruptibly(interrupt, [&] { made = report(scene, options); });
    py::list rows;
    for (const StudyReport& study : made.studies)
        for (const ReportRun& run : study.runs)
            rows.append(row_of(made, study, run));
    return rows;
}

}  // namespace

void bind_report(py::module_& module)
{
    module.def("report", report_scene);
}

}  // namespace packtrace::python
