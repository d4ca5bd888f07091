#include "dispatch/kernels.hpp"

#include <stdexcept>

namespace packtrace {

#define PACKTRACE_DECLARE(isa)              \
    namespace isa {                         \
    const abi::KernelTable& kernel_table(); \
    }
#ifdef PACKTRACE_HAS_sse42
PACKTRACE_DECLARE(sse42)
PACKTRACE_DECLARE(sse_fma)
PACKTRACE_DECLARE(avx2)
PACKTRACE_DECLARE(avx512)
#else
PACKTRACE_DECLARE(neon64)
#endif

const std::vector<const abi::KernelTable*>& all_kernels()
{
#ifdef PACKTRACE_HAS_sse42
    static const std::vector<const abi::KernelTable*> tables = {
        &sse42::kernel_table(), &sse_fma::kernel_table(), &avx2::kernel_table(),
        &avx512::kernel_table()};
#else
    static const std::vector<const abi::KernelTable*> tables = {&neon64::kernel_table()};
#endif
    return tables;
}

const abi::KernelTable& kernels_of(const std::string& isa)
{
    if (cpu_runs(isa))
        for (const abi::KernelTable* table : all_kernels())
            if (isa == table->isa)
                return *table;
    throw std::invalid_argument("no kernels for instruction set '" + isa + "' on this machine");
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
