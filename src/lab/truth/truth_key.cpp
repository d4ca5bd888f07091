#include "lab/truth/truth_key.hpp"

#include <limits>

#if defined(__GLIBC__)
#include <gnu/libc-version.h>
#endif

#include <packtrace/render.hpp>
#include <packtrace/version.hpp>
#include <packtrace/write_scene.hpp>

#include "lab/harness/build_stamp.hpp"
#include "lab/harness/machine.hpp"

namespace packtrace {
namespace {

std::string c_library()
{
#if defined(__GLIBC__)
    return std::string("glibc ") + gnu_get_libc_version();
#else
    return "another C library";
#endif
}

template <class Real>
std::string with_bits(const char* name)
{
    return std::string(name) + " of " + std::to_string(std::numeric_limits<Real>::digits) + " bits";
}

}  // namespace

std::string TruthKey::text() const
{
    return "packtrace " + version + "\nsources " + sources + "\ncompiler " + compiler +
           "\nmachine " + machine + "\nprecision " + precision + "\nself-hits " + self_hits +
           "\nsamples " + std::to_string(samples) + '\n' + scene;
}

TruthKey truth_key(const Scene& scene, int samples)
{
    TruthKey key;
    key.version = PACKTRACE_VERSION_STRING;
    key.sources = built_sources;
    key.compiler = compiler_name() + ' ' + flags_name();
    key.machine = processor_name() + ", " + c_library();
    key.precision =
        samples > 1 ? with_bits<double>("double") : with_bits<long double>("long double");
    key.self_hits = default_self_hits == SelfHits::note ? "note" : "exact";
    key.samples = samples;
    key.scene = scene_text(scene);
    return key;
}

}  // namespace packtrace
