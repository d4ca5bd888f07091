#include "dispatch/kernels.hpp"

#include <stdexcept>
#include <string>

namespace packtrace {

// The build writes kernel_list.inc: a line KERNELS(isa) for each instruction set compiled in,
// followed by PROBES(isa) if its probes are compiled in, too.
#define KERNELS(isa)                        \
    namespace isa {                         \
    const abi::KernelTable& kernel_table(); \
    const abi::FusedTable& fused_kernels(); \
    }
#define PROBES(isa)                           \
    namespace isa {                           \
    const abi::ProbeKernels& probe_kernels(); \
    }
#include "dispatch/kernel_list.inc"
#undef KERNELS
#undef PROBES

namespace {

[[maybe_unused]] void add_probes(const abi::ProbeKernels& probes, abi::KernelTable& table)
{
    // The feature sets with Features::exact come first.
    constexpr int probe = abi::feature_set_count + abi::probe_set;
    table.single_precision.kernels[abi::probe_set] = probes.exact;
    table.single_precision.kernels[probe] = probes.single_precision;
    table.double_precision.kernels[probe] = probes.double_precision;
}

std::vector<abi::KernelTable> whole_tables()
{
    std::vector<abi::KernelTable> tables;
#define KERNELS(isa)                               \
    tables.push_back(isa::kernel_table());         \
    for (int i = 0; i < abi::fused_set_count; ++i) \
        tables.back().single_precision.fused[i] = isa::fused_kernels().set[i];
#define PROBES(isa) add_probes(isa::probe_kernels(), tables.back());
#include "dispatch/kernel_list.inc"
#undef KERNELS
#undef PROBES
    return tables;
}

}  // namespace

const std::vector<const abi::KernelTable*>& all_kernels()
{
    static const std::vector<abi::KernelTable> tables = whole_tables();
    static const std::vector<const abi::KernelTable*> pointers = [] {
        std::vector<const abi::KernelTable*> result;
        for (const abi::KernelTable& table : tables)
            result.push_back(&table);
        return result;
    }();
    return pointers;
}

const abi::KernelTable& kernels_of(std::string_view isa)
{
    if (cpu_runs(isa))
        for (const abi::KernelTable* table : all_kernels())
            if (isa == table->isa)
                return *table;
    throw std::invalid_argument("no kernels for instruction set '" + std::string(isa) +
                                "' on this machine");
}

template <>
const abi::PrecisionTable<float>& precision<float>(const abi::KernelTable& table)
{
    return table.single_precision;
}

template <>
const abi::PrecisionTable<double>& precision<double>(const abi::KernelTable& table)
{
    return table.double_precision;
}

}  // namespace packtrace
