// Which instruction set a request gets, and the message for a wrong request.
#include "catch.hpp"
#include "dispatch/kernels.hpp"
#include "environment.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/renderer.hpp>

#include <csignal>
#include <stdexcept>

namespace packtrace::test {
namespace {

std::vector<IsaInfo> runnable_isas()
{
    std::vector<IsaInfo> isas;
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            isas.push_back(isa);
    return isas;
}

std::string supported_text()
{
    std::string text;
    for (const IsaInfo& isa : runnable_isas())
        text += " " + isa.name;
    return text;
}

std::string refusal(const std::string& request, int width)
{
    try {
        return "accepted as " + choose_isa(request, width).name;
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

constexpr const char* variable = "PACKTRACE_ISA";

}  // namespace

TEST_CASE("instruction sets are listed narrowest first, and doubles have half the lanes, or one",
          "[isa]")
{
    const std::vector<IsaInfo> isas = list_isas();
    REQUIRE_FALSE(isas.empty());
    for (std::size_t i = 0; i < isas.size(); ++i) {
        const int halves = isas[i].lanes_single == 1 ? 1 : 2;
        CHECK(isas[i].lanes_double * halves == isas[i].lanes_single);
        CHECK((i == 0 || isas[i - 1].lanes_single <= isas[i].lanes_single));
    }
    CHECK_FALSE(runnable_isas().empty());
}

TEST_CASE("a forced instruction set is the one that runs", "[isa]")
{
    const ScopedVariable unset(variable, std::nullopt);
    for (const IsaInfo& isa : runnable_isas()) {
        CHECK(choose_isa(isa.name).name == isa.name);
        CHECK(choose_isa(isa.name, isa.lanes_single).name == isa.name);
        CHECK(kernels_of(isa.name).isa == isa.name);
        const RenderOptions options{.isa = isa.name};
        CHECK(Renderer<float>(Scene{}, options).isa().name == isa.name);
        CHECK(Renderer<double>(Scene{}, options).isa().lanes_double == isa.lanes_double);
    }
}

TEST_CASE("auto takes the widest instruction set, or one of the requested width", "[isa]")
{
    const ScopedVariable unset(variable, std::nullopt);
    CHECK(choose_isa().name == runnable_isas().back().name);
    for (const IsaInfo& isa : runnable_isas())
        CHECK(choose_isa("auto", isa.lanes_single).lanes_single == isa.lanes_single);
}

TEST_CASE("of two instruction sets of one width, auto takes the better one", "[isa]")
{
    const ScopedVariable unset(variable, std::nullopt);
    std::string best;
    for (const IsaInfo& isa : runnable_isas())
        if (isa.lanes_single == 4)
            best = isa.name;
    CHECK(choose_isa("auto", 4).name == best);
}

TEST_CASE("PACKTRACE_ISA decides only for auto", "[isa]")
{
    for (const IsaInfo& isa : runnable_isas()) {
        const ScopedVariable set(variable, isa.name);
        CHECK(choose_isa().name == isa.name);
        for (const IsaInfo& other : runnable_isas())
            CHECK(choose_isa(other.name).name == other.name);
    }
}

TEST_CASE("an empty PACKTRACE_ISA and the value auto count as unset", "[isa]")
{
    for (const char* value : {"", "auto"}) {
        const ScopedVariable set(variable, value);
        CHECK(choose_isa().name == runnable_isas().back().name);
    }
}

TEST_CASE("an unknown instruction set is refused with a list of the known ones", "[isa]")
{
    CHECK(refusal("mmx", 0) ==
          "isa: unknown instruction set 'mmx'; choose auto or one of:" + supported_text());
    CHECK(refusal("", 0) ==
          "isa: unknown instruction set ''; choose auto or one of:" + supported_text());
    CHECK(refusal("a\nb", 0) ==
          "isa: unknown instruction set 'a\\x0ab'; choose auto or one of:" + supported_text());
    const ScopedVariable set(variable, "AVX2");
    CHECK(refusal("auto", 0) ==
          "PACKTRACE_ISA: unknown instruction set 'AVX2'; choose auto or "
          "one of:" +
              supported_text());
}

TEST_CASE("an instruction set that the machine lacks is refused with a list of its sets", "[isa]")
{
    const ScopedVariable unset(variable, std::nullopt);
    for (const IsaInfo& isa : list_isas()) {
        if (isa.supported)
            continue;
        CHECK(refusal(isa.name, 0) ==
              "isa: this machine cannot run '" + isa.name + "'; it can run:" + supported_text());
        CHECK_THROWS_AS(kernels_of(isa.name), std::invalid_argument);
    }
    CHECK_THROWS_AS(kernels_of("mmx"), std::invalid_argument);
}

TEST_CASE("a width that contradicts the instruction set is refused", "[isa]")
{
    const IsaInfo isa = runnable_isas().front();
    const std::string lanes = std::to_string(isa.lanes_single);
    const std::string rest =
        "'" + isa.name + "' has " + lanes + " lanes, not 5; leave out one of the two";
    CHECK(refusal(isa.name, 5) == "isa: " + rest);
    const ScopedVariable set(variable, isa.name);
    CHECK(refusal("auto", 5) == "PACKTRACE_ISA: " + rest);
}

TEST_CASE("a width that no instruction set has is refused", "[isa]")
{
    const ScopedVariable unset(variable, std::nullopt);
    CHECK(refusal("auto", 5) ==
          "width: no instruction set of this machine has 5 lanes; it can run:" + supported_text());
}

// The next two tests are for a processor without AVX, which check_without_avx.sh emulates.

TEST_CASE("without AVX sse42 is chosen, and forcing more is a clean error", "[.without_avx]")
{
    const ScopedVariable unset(variable, std::nullopt);
    CHECK(choose_isa().name == "sse42");
    CHECK(supported_text() == " sse42");
    for (const IsaInfo& wider : list_isas())
        if (wider.name != "sse42")
            CHECK(refusal(wider.name, 0) ==
                  "isa: this machine cannot run '" + wider.name + "'; it can run: sse42");
    CHECK(refusal("auto", 8) ==
          "width: no instruction set of this machine has 8 lanes; it can run: sse42");
}

TEST_CASE("the AVX kernels are run without asking the processor", "[.unchecked_avx]")
{
    // The default handler: the test framework's handler would hide the signal.
    std::signal(SIGILL, SIG_DFL);
    for (const abi::KernelTable* table : all_kernels()) {
        if (std::string(table->isa) != "avx2")
            continue;
        const float x[8] = {0.5f};
        float y[8] = {};
        table->single_precision.highlight_power(x, x, y, 8);
        CHECK(y[0] > 0.0f);
    }
}

}  // namespace packtrace::test
