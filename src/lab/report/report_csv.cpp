#include <sstream>

#include "lab/harness/names.hpp"
#include "lab/report/report_text.hpp"

namespace packtrace {
namespace {

// A field between quotes, as some names have commas.
std::string csv_text(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text)
        result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

std::string exact(double value)
{
    return brief(value, 9);
}

void write_row(std::ostream& to, const SceneReport& scene, const StudyReport& study,
               const ReportRun& run)
{
    const Variant& variant = run.variant;
    to << csv_text(scene.name) << ',' << scene.width << ',' << scene.height << ','
       << name_of(study.study) << ',' << csv_text(variant.name) << ','
       << (variant.kernel == Kernel::scalar ? "scalar" : "packet") << ',' << variant.precision
       << ',' << variant.isa << ',' << (has_accuracy(variant) ? name_of(variant.accuracy) : "")
       << ',' << variant.lanes << ',' << variant.threads << ',' << variant.depth << ','
       << exact(variant.min_weight) << ',' << variant.samples << ','
       << (variant.adaptive ? exact(*variant.adaptive) : "") << ',' << exact(run.median) << ','
       << exact(run.spread) << ',' << run.rays << ',' << run.cut.rays << ',' << exact(run.cut.bound)
       << ',' << exact(run.error.rmse) << ',' << exact(run.error.max_abs) << ','
       << exact(run.error.psnr) << ',' << run.error.pixels << ',' << run.error.pixels_off << ','
       << name_of(run.pareto) << ',' << csv_text(shares_text(run)) << '\n';
}

}  // namespace

std::string report_csv(const std::vector<SceneReport>& scenes)
{
    std::ostringstream csv;
    csv << "scene,width,height,study,run,kernel,precision,isa,accuracy,lanes,threads,depth,min_"
           "weight,"
           "samples,adaptive,median_s,spread,rays,cut_rays,cut_bound,rmse,max_abs,psnr,pixels,"
           "pixels_off,pareto,errors\n";
    for (const SceneReport& scene : scenes)
        for (const StudyReport& study : scene.studies)
            for (const ReportRun& run : study.runs)
                write_row(csv, scene, study, run);
    return csv.str();
}

}  // namespace packtrace
