// packtrace_power_error: writes the errors of the highlights' power as JSON, compared with long
// double, by instruction set, precision and decade of the exponent. Errors are in units of the last
// place, of powers above 1e-4.
#include "power_error.hpp"

#include "context.hpp"
#include "names.hpp"

#include <nlohmann/json.hpp>

#include <iostream>

namespace packtrace::bench {
namespace {

template <class Real>
void append_errors(nlohmann::ordered_json& errors)
{
    for (const test::ExponentDecade& decade : test::exponent_decades) {
        const auto samples = test::power_samples<Real>(decade, 1e-4, 4000);
        for (const std::string& isa : supported_isas()) {
            const auto& kernels = kernels_of(isa);
            const auto error = test::power_error(samples, test::highlight_powers(kernels, samples));
            errors.push_back({{"isa", isa},
                              {"precision", precision_name<Real>()},
                              {"exponents", {decade.first, decade.last}},
                              {"max_ulp", error.max_ulp},
                              {"p99_ulp", error.p99_ulp},
                              {"max_abs", error.max_abs},
                              {"samples", error.counted}});
        }
    }
}

}  // namespace
}  // namespace packtrace::bench

int main()
{
    nlohmann::ordered_json report;
    report["context"] = packtrace::bench::context_json();
    report["errors"] = nlohmann::ordered_json::array();
    packtrace::bench::append_errors<float>(report["errors"]);
    packtrace::bench::append_errors<double>(report["errors"]);
    std::cout << report.dump(2) << '\n';
}
