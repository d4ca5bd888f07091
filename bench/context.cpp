#include "context.hpp"

#include "core/text.hpp"
#include "lab/harness/machine.hpp"
#include "names.hpp"

#include <nlohmann/json.hpp>

namespace packtrace::bench {

std::vector<std::pair<std::string, std::string>> context()
{
    return {{"processor", processor_name()}, {"instruction_sets", joined(supported_isas(), " ")},
            {"compiler", compiler_name()},   {"flags", kernel_flags},
            {"commit", built_commit},        {"load_before", fixed(load_at_start(), 2)}};
}

nlohmann::ordered_json context_json()
{
    nlohmann::ordered_json json;
    for (const auto& [name, value] : context())
        json[name] = value;
    return json;
}

void add_load_after(nlohmann::ordered_json& context)
{
    context["load_after"] = fixed(load_now(), 2);
}

}  // namespace packtrace::bench
