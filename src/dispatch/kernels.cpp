#include "dispatch/kernels.hpp"

#include <stdexcept>
#include <string>

namespace packtrace {

// kernel_list.inc is written by the build: a line KERNELS(isa) for each set compiled in.
#define KERNELS(isa)                        \
    namespace isa {                         \
    const abi::KernelTable& kernel_table(); \
    }
#include "dispatch/kernel_list.inc"
#undef KERNELS

const std::vector<const abi::KernelTable*>& all_kernels()
{
    static const std::vector<const abi::KernelTable*> tables = {
#define KERNELS(isa) &isa::kernel_table(),
#include "dispatch/kernel_list.inc"
#undef KERNELS
    };
    return tables;
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
