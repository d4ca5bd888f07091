#include "options.hpp"

#include "words.hpp"

namespace packtrace::python {

RenderOptions kernel_options(const py::kwargs& arguments)
{
    RenderOptions options;
    options.kernel = word_value<Kernel>(arguments["kernel"], "kernel");
    from_python(arguments["isa"], "isa", options.isa);
    from_python(arguments["lanes"], "lanes", options.width);
    options.accuracy = word_value<Accuracy>(arguments["accuracy"], "accuracy");
    options.self_hits = word_value<SelfHits>(arguments["self_hits"], "self_hits");
    options.traversal = word_value<Traversal>(arguments["traversal"], "traversal");
    from_python(arguments["threads"], "threads", options.threads);
    if (options.threads < 0)
        throw_wrong("threads", arguments["threads"], "0, for all processors, or more");
    return options;
}

}  // namespace packtrace::python
