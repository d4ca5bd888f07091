#include "embree_modes.hpp"

#include "embree_packets.hpp"
#include "pass_timer.hpp"

#include <array>
#include <string>
#include <utility>

namespace packtrace::peers {
namespace {

using Scene = std::shared_ptr<const EmbreeScene>;

// All lanes are valid: inactive lanes hold rays that end before they begin. Aligned, as Embree
// loads a packet of them at once.
alignas(64) constexpr std::array<int, 16> all_valid = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                       -1, -1, -1, -1, -1, -1, -1, -1};

RTCIntersectContext context_of(RTCIntersectContextFlags flags)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

/// One call for each packet.
template <int lanes>
struct PacketCalls {
    static void trace(RTCScene scene, RTCIntersectContext& context, Query query,
                      Packets<lanes>& packets)
    {
        for (std::size_t p = 0; p < packets.size(); ++p)
            if (query == Query::closest)
                PacketOf<lanes>::intersect(all_valid.data(), scene, &context, packets.data() + p);
            else
                PacketOf<lanes>::occluded(all_valid.data(), scene, &context, packets.data() + p);
    }
};

/// One call for all packets: a stream of single rays, or of packets.
template <int lanes>
struct StreamCall {
    static void trace(RTCScene scene, RTCIntersectContext& context, Query query,
                      Packets<lanes>& packets)
    {
        auto* first = packets.data();
        const auto count = static_cast<unsigned>(packets.size());
        constexpr std::size_t stride = sizeof(*first);
        if constexpr (lanes == 1) {
            if (query == Query::closest)
                rtcIntersect1M(scene, &context, first, count, stride);
            else
                rtcOccluded1M(scene, &context, &first->ray, count, stride);
        } else if (query == Query::closest) {
            rtcIntersectNM(scene, &context, reinterpret_cast<RTCRayHitN*>(first), lanes, count,
                           stride);
        } else {
            rtcOccludedNM(scene, &context, reinterpret_cast<RTCRayN*>(first), lanes, count, stride);
        }
    }
};

template <int lanes, class Calls>
double trace_packets(const Scene& scene, RTCIntersectContextFlags flags, const RaySet& rays,
                     Query query, Hits& hits)
{
    Packets<lanes> packets(chunk_size);
    RTCIntersectContext context = context_of(flags);
    PassTimer watch;
    for (std::size_t first = 0; first < rays.size(); first += chunk_size) {
        const std::size_t count = std::min(chunk_size, rays.size() - first);
        packets.fill(rays, first, count);
        watch.measure([&] { Calls::trace(scene->get(), context, query, packets); });
        if (query == Query::closest)
            packets.read_closest(first, count, hits);
        else
            packets.read_occluded(first, count, hits);
    }
    return watch.seconds();
}

/// Rays in arrays, as for packtrace. Embree writes into them, so each chunk is a copy.
class Arrays {
public:
    void fill(const RaySet& rays, std::size_t first, std::size_t count)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            copy(rays.org[axis], first, count, axis);
            copy(rays.dir[axis], first, count, 4 + axis);
        }
        copy(rays.t_min, first, count, 3);
        copy(rays.t_max, first, count, 8);
        std::fill_n(integers_[0].begin(), count, ~0U);
        for (std::size_t i = 3; i < integers_.size(); ++i)
            std::fill_n(integers_[i].begin(), count, RTC_INVALID_GEOMETRY_ID);
    }

    [[nodiscard]] RTCRayHitNp view()
    {
        auto& f = floats_;
        auto& n = integers_;
        RTCRayHitNp rays;
        rays.ray = {f[0].data(), f[1].data(), f[2].data(), f[3].data(), f[4].data(), f[5].data(),
                    f[6].data(), f[7].data(), f[8].data(), n[0].data(), n[1].data(), n[2].data()};
        rays.hit = {f[9].data(),  f[10].data(), f[11].data(), f[12].data(),
                    f[13].data(), n[3].data(),  n[4].data(),  {n[5].data()}};
        return rays;
    }

    void read_closest(std::size_t first, std::size_t count, Hits& hits) const
    {
        for (std::size_t i = 0; i < count; ++i) {
            hits.t[first + i] = floats_[8][i];
            const bool hit = integers_[4][i] != RTC_INVALID_GEOMETRY_ID;
            hits.object[first + i] = hit ? static_cast<std::int32_t>(integers_[3][i]) : -1;
        }
    }

    void read_occluded(std::size_t first, std::size_t count, Hits& hits) const
    {
        for (std::size_t i = 0; i < count; ++i)
            hits.occluded[first + i] = floats_[8][i] < 0;
    }

private:
    void copy(const std::vector<float>& from, std::size_t first, std::size_t count, std::size_t to)
    {
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(first), count, floats_[to].begin());
    }

    template <class T>
    struct alignas(64) Component : std::array<T, chunk_size> {
    };
    // Origin, t_min, direction, time, t_max, normal, u, v; mask, id, flags, object, geometry,
    // instance.
    std::array<Component<float>, 14> floats_{};
    std::array<Component<unsigned>, 6> integers_{};
};

double trace_arrays(const Scene& scene, RTCIntersectContextFlags flags, const RaySet& rays,
                    Query query, Hits& hits)
{
    const auto arrays = std::make_unique<Arrays>();
    RTCRayHitNp view = arrays->view();
    RTCIntersectContext context = context_of(flags);
    PassTimer watch;
    for (std::size_t first = 0; first < rays.size(); first += chunk_size) {
        const std::size_t count = std::min(chunk_size, rays.size() - first);
        arrays->fill(rays, first, count);
        watch.measure([&] {
            if (query == Query::closest)
                rtcIntersectNp(scene->get(), &context, &view, static_cast<unsigned>(count));
            else
                rtcOccludedNp(scene->get(), &context, &view.ray, static_cast<unsigned>(count));
        });
        if (query == Query::closest)
            arrays->read_closest(first, count, hits);
        else
            arrays->read_occluded(first, count, hits);
    }
    return watch.seconds();
}

using Trace = double (*)(const Scene&, RTCIntersectContextFlags, const RaySet&, Query, Hits&);

struct Mode {
    const char* name;
    Trace trace;
    bool quick;  ///< it is among the best in most races
};

constexpr Mode modes[] = {
    {"1", trace_packets<1, PacketCalls<1>>, true},
    {"4", trace_packets<4, PacketCalls<4>>, false},
    {"8", trace_packets<8, PacketCalls<8>>, false},
    {"16", trace_packets<16, PacketCalls<16>>, true},
    {"1M", trace_packets<1, StreamCall<1>>, false},
    {"NM", trace_packets<16, StreamCall<16>>, false},
    {"Np", trace_arrays, false},
};

constexpr std::pair<const char*, RTCIntersectContextFlags> flag_names[] = {
    {"coherent", RTC_INTERSECT_CONTEXT_FLAG_COHERENT},
    {"incoherent", RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT},
};

}  // namespace

std::vector<Tracer> embree_tracers(const Scene& scene, Geometry geometry, Modes which)
{
    std::vector<Tracer> tracers;
    for (const Mode& mode : modes)
        for (const auto& [flag_name, flags] : flag_names) {
            const bool single = std::string(mode.name) == "1";
            const bool sphere = geometry == Geometry::sphere;
            if (which == Modes::quick &&
                (!mode.quick || sphere || (single && flags == RTC_INTERSECT_CONTEXT_FLAG_COHERENT)))
                continue;
            tracers.push_back({.name = std::string("embree ") + name_of(geometry) + ' ' +
                                       mode.name + ' ' + flag_name,
                               .side = sphere ? Side::embree_sphere : Side::embree_user,
                               .trace = [=, trace = mode.trace, flags = flags](
                                            const RaySet& rays, Query query, Hits& hits) {
                                   return trace(scene, flags, rays, query, hits);
                               }});
        }
    return tracers;
}

}  // namespace packtrace::peers
