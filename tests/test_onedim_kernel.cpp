#include "catch.hpp"
#include "core/aligned_array.hpp"
#include "dispatch/kernels.hpp"
#include "onedim/solvers.hpp"
#include "onedim/transfer.hpp"
#include "onedim_systems.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/onedim.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace packtrace::onedim {
namespace {

std::vector<const abi::KernelTable*> kernels()
{
    std::vector<const abi::KernelTable*> tables;
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            tables.push_back(&kernels_of(isa.name));
    return tables;
}

std::vector<Transfer> monotone_functions()
{
    std::vector<Transfer> functions;
    for (const Intensity low : all_intensities)
        for (const Intensity middle : all_intensities)
            for (const Intensity high : all_intensities)
                if (low <= middle && middle <= high)
                    functions.push_back({{low, middle, high}});
    return functions;
}

bool contains(const std::vector<Transfer>& functions, const Transfer& f)
{
    return std::find(functions.begin(), functions.end(), f) != functions.end();
}

// All functions that a segment of any line can have: everything that surfaces make of empty space.
std::vector<Transfer> reachable()
{
    std::vector<Transfer> functions{Transfer{}};
    for (std::size_t done = 0; done < functions.size(); ++done)
        for (const Surface& surface : test::all_surfaces()) {
            const Transfer next = step(surface, functions[done]);
            if (!contains(functions, next))
                functions.push_back(next);
        }
    return functions;
}

std::uint64_t all_bits(bool set)
{
    return set ? ~std::uint64_t{0} : 0;
}

// The kernel's step in the last word of a register whose other words are empty.
Transfer kernel_step(const abi::OnedimTable& kernel, const Surface& surface, const Transfer& beyond)
{
    const auto words = static_cast<std::size_t>(kernel.words);
    const AlignedArray<std::uint64_t> planes(abi::onedim_planes * words);
    const AlignedArray<std::uint64_t> state(abi::onedim_state_planes * words);
    std::uint64_t* plane = planes.data() + words - 1;
    std::uint64_t* some = state.data() + words - 1;
    std::uint64_t* all = some + words;
    for (std::size_t p = 0; p < abi::onedim_planes; ++p)
        plane[p * words] = all_bits(code_of(surface) >> p & 1);
    for (std::size_t x = 0; x < 3; ++x) {
        some[2 * x * words] = all_bits(beyond.left_for[x] >= Intensity::medium);
        all[2 * x * words] = all_bits(beyond.left_for[x] == Intensity::all);
    }
    kernel.solve({planes.data(), 1, state.data()});

    Transfer before;
    for (std::size_t x = 0; x < 3; ++x) {
        CHECK((some[2 * x * words] == 0 || ~some[2 * x * words] == 0));
        before.left_for[x] =
            static_cast<Intensity>((some[2 * x * words] & 1) + (all[2 * x * words] & 1));
    }
    return before;
}

}  // namespace

TEST_CASE("a surface's byte is its code", "[onedim_kernel]")
{
    std::set<int> codes;
    for (const Surface& surface : test::all_surfaces()) {
        CHECK((std::bit_cast<std::uint8_t>(surface) & 0x7f) == code_of(surface));
        CHECK((surface_of(code_of(surface)) == surface));
        CHECK(is_surface(code_of(surface)));
        codes.insert(code_of(surface));
    }
    CHECK(codes.size() == 54);
}

TEST_CASE("a surface turns a monotone function into a monotone one", "[onedim_kernel]")
{
    const std::vector<Transfer> functions = monotone_functions();
    CHECK(functions.size() == 10);
    for (const Transfer& beyond : functions)
        for (const Surface& surface : test::all_surfaces())
            CHECK(contains(functions, step(surface, beyond)));
}

TEST_CASE("seven of the ten monotone functions occur", "[onedim_kernel]")
{
    CHECK(reachable().size() == 7);
}

TEST_CASE("bit planes are the transposed bytes", "[onedim_kernel]")
{
    for (const abi::KernelTable* kernel : kernels()) {
        INFO(kernel->isa);
        const auto words = static_cast<std::size_t>(kernel->onedim.words);
        std::mt19937_64 random(12);
        const AlignedArray<std::uint64_t> tiles(2 * 64 * words);
        std::vector<std::uint64_t> before(tiles.size());
        for (std::size_t i = 0; i < before.size(); ++i)
            tiles[i] = before[i] = random();
        kernel->onedim.transpose(tiles.data(), 2);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            const std::size_t row = i / words % 64;
            const std::size_t first = i - row * words;
            for (std::size_t bit = 0; bit < 64; ++bit)
                wrong += (before[i] >> bit & 1) != (tiles[first + bit * words] >> row & 1);
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("the kernel steps over every surface as the scalar step does", "[onedim_kernel]")
{
    for (const abi::KernelTable* kernel : kernels()) {
        INFO(kernel->isa);
        int wrong = 0;
        for (const Surface& surface : test::all_surfaces())
            for (const Transfer& beyond : monotone_functions())
                wrong += kernel_step(kernel->onedim, surface, beyond) != step(surface, beyond);
        CHECK(wrong == 0);
    }
}

TEST_CASE("systems are sorted by length, and systems of equal length keep their order",
          "[onedim_kernel]")
{
    Systems systems;
    for (const std::size_t length : {20u, 3u, 0u, 24u, 8u, 17u})
        systems.push_back(std::vector<Surface>(length));
    CHECK(order_by_length(systems) == std::vector<std::uint32_t>{2, 1, 4, 0, 3, 5});
}

}  // namespace packtrace::onedim
