#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

// A fuzzer is one function of bytes. With PACKTRACE_FUZZ, libFuzzer's build makes a program of each
// fuzzer. The tests' build puts all into one program, which runs them over their corpora.
namespace packtrace::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Fuzzer {
    const char* name;
    void (*run)(Bytes);
};

/// The fuzzers of this program.
inline std::vector<Fuzzer>& fuzzers()
{
    static std::vector<Fuzzer> all;
    return all;
}

inline std::string_view text_of(Bytes bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Ends the program if a promise is broken.
inline void require(bool kept, const char* promise)
{
    if (kept)
        return;
    std::fprintf(stderr, "broken: %s\n", promise);
    std::abort();
}

}  // namespace packtrace::fuzz

#ifdef PACKTRACE_FUZZER_ALONE
#define PACKTRACE_FUZZER(name)                                                         \
    static void run_##name(packtrace::fuzz::Bytes);                                    \
    extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size); \
    extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)  \
    {                                                                                  \
        run_##name({data, size});                                                      \
        return 0;                                                                      \
    }                                                                                  \
    static void run_##name(packtrace::fuzz::Bytes bytes)
#else
#define PACKTRACE_FUZZER(name)                                             \
    static void run_##name(packtrace::fuzz::Bytes);                        \
    [[maybe_unused]] static const bool name##_is_known =                   \
        (packtrace::fuzz::fuzzers().push_back({#name, run_##name}), true); \
    static void run_##name(packtrace::fuzz::Bytes bytes)
#endif
