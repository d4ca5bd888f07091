#include "options.hpp"

#include "core/check_number.hpp"
#include "core/text.hpp"
#include "words.hpp"
#include <packtrace/isa.hpp>

#include <set>
#include <string>

namespace packtrace::python {
namespace {

/// Checks `lanes`. In Python `width` is the width of a picture.
void check_lanes(py::handle value, int lanes)
{
    std::set<int> known{0};
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            known.insert(isa.lanes_single);
    if (known.count(lanes) == 0)
        throw_wrong(
            "lanes", value,
            "0, for the most, or what a set of this machine has: " +
                packtrace::joined(known, ", ", [](int number) { return std::to_string(number); }));
}

}  // namespace

RenderOptions kernel_options(const py::kwargs& arguments)
{
    RenderOptions options;
    options.kernel = word_value<Kernel>(arguments["kernel"], "kernel");
    from_python(arguments["isa"], "isa", options.isa);
    from_python(arguments["lanes"], "lanes", options.width);
    check_lanes(arguments["lanes"], options.width);
    options.accuracy = word_value<Accuracy>(arguments["accuracy"], "accuracy");
    options.self_hits = word_value<SelfHits>(arguments["self_hits"], "self_hits");
    options.traversal = word_value<Traversal>(arguments["traversal"], "traversal");
    from_python(arguments["threads"], "threads", options.threads);
    if (options.threads < 0 || options.threads > most_threads)
        throw_wrong("threads", arguments["threads"],
                    "0, for all processors, or up to " + std::to_string(most_threads));
    return options;
}

}  // namespace packtrace::python
