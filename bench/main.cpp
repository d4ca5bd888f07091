#include "context.hpp"
#include "register.hpp"

#include <benchmark/benchmark.h>

int main(int argc, char** argv)
{
    for (const auto& [name, value] : packtrace::bench::context())
        benchmark::AddCustomContext(name, value);
    packtrace::bench::register_kernels();
    packtrace::bench::register_frames();
    packtrace::bench::register_power();
    packtrace::bench::register_updates();
    packtrace::bench::register_lit();

    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
