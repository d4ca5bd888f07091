#include "dispatch/kernels.hpp"
#include "scene/language/quote.hpp"
#include <packtrace/isa.hpp>

#include <cstdlib>
#include <stdexcept>

namespace packtrace {
namespace {

std::string supported_names(const std::vector<IsaInfo>& isas)
{
    std::string names;
    for (const IsaInfo& isa : isas)
        if (isa.supported)
            names += " " + isa.name;
    return names;
}

IsaInfo forced(const std::string& name, const char* source, int width,
               const std::vector<IsaInfo>& isas)
{
    for (const IsaInfo& isa : isas) {
        if (isa.name != name)
            continue;
        if (!isa.supported)
            throw std::invalid_argument(std::string(source) + ": this machine cannot run " +
                                        language::quote(name) +
                                        "; it can run:" + supported_names(isas));
        if (width != 0 && width != isa.lanes_single)
            throw std::invalid_argument(std::string(source) + ": '" + name + "' has " +
                                        std::to_string(isa.lanes_single) + " lanes, not " +
                                        std::to_string(width) + "; leave out one of the two");
        return isa;
    }
    throw std::invalid_argument(std::string(source) + ": unknown instruction set " +
                                language::quote(name) +
                                "; choose auto or one of:" + supported_names(isas));
}

IsaInfo widest(int width, const std::vector<IsaInfo>& isas)
{
    for (auto isa = isas.rbegin(); isa != isas.rend(); ++isa)
        if (isa->supported && (width == 0 || isa->lanes_single == width))
            return *isa;
    throw std::invalid_argument("width: no instruction set of this machine has " +
                                std::to_string(width) +
                                " lanes; it can run:" + supported_names(isas));
}

}  // namespace

std::vector<IsaInfo> list_isas()
{
    std::vector<IsaInfo> isas;
    for (const abi::KernelTable* table : all_kernels())
        isas.push_back({table->isa, table->single_precision.lanes, table->double_precision.lanes,
                        cpu_runs(table->isa)});
    return isas;
}

IsaInfo choose_isa(std::string_view request, int width)
{
    const std::vector<IsaInfo> isas = list_isas();
    if (request != "auto")
        return forced(std::string(request), "isa", width, isas);
    const char* variable = std::getenv("PACKTRACE_ISA");
    if (variable != nullptr && *variable != '\0' && std::string_view(variable) != "auto")
        return forced(variable, "PACKTRACE_ISA", width, isas);
    return widest(width, isas);
}

}  // namespace packtrace
