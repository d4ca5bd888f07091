// Any bytes as a cached truth with the key "key" give a whole picture, or nothing.
#include "input_file.hpp"
#include "lab/truth/truth_cache.hpp"

PACKTRACE_FUZZER(truths)
{
    const packtrace::fuzz::InputFile file(bytes);
    const auto truth = packtrace::read_truth(file.name(), "key");
    if (!truth)
        return;
    const auto pixels = static_cast<std::size_t>(truth->image.width) *
                        static_cast<std::size_t>(truth->image.height);
    packtrace::fuzz::require(truth->image.rgb.size() == 3 * pixels, "a truth has all its values");
}
