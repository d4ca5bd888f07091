#include "onedim/solvers.hpp"
#include "onedim/transfer.hpp"

#include <array>
#include <cstdint>

namespace packtrace::onedim {
namespace {

// Transfer functions are the states of an automaton that reads surfaces from the far end. The
// digits of a state's number in base 3 are the function's three values.
constexpr int states = 27;

constexpr std::uint8_t number(const Transfer& f)
{
    int digits = 0;
    for (std::size_t x = 3; x-- > 0;)
        digits = 3 * digits + static_cast<int>(f.left_for[x]);
    return static_cast<std::uint8_t>(digits);
}

constexpr Transfer transfer(int number)
{
    Transfer f;
    for (Intensity& value : f.left_for) {
        value = static_cast<Intensity>(number % 3);
        number /= 3;
    }
    return f;
}

// [surface code][state] -> state. Rows of invalid codes stay 0.
using Automaton = std::array<std::array<std::uint8_t, states>, surface_codes>;

constexpr Automaton make_automaton()
{
    Automaton next{};
    for (int code = 0; code < surface_codes; ++code) {
        if (!is_surface(code))
            continue;
        for (int state = 0; state < states; ++state)
            next[static_cast<std::size_t>(code)][static_cast<std::size_t>(state)] =
                number(step(surface_of(code), transfer(state)));
    }
    return next;
}

constexpr Automaton automaton = make_automaton();

}  // namespace

Intensity solve_linear(std::span<const Surface> system)
{
    std::uint8_t state = number(Transfer{});
    for (std::size_t i = system.size(); i-- > 0;)
        state = automaton[code_of(system[i])][state];
    return transfer(state)(Intensity::none);
}

}  // namespace packtrace::onedim
