#include "lower/packed_light_buffers.hpp"

#include <packtrace/vec.hpp>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace packtrace {
namespace {

/// The cells of a sphere are found with this share of a cell as a margin: far more than the
/// rounding error of a ray's place in the grid.
constexpr double cell_margin = 0.02;

/// Spheres count as larger by this share, and as smaller where they hide others.
constexpr double size_margin = 1e-4;

/// By how much rounding may move a sphere's centre, as a share of its distance from the light.
constexpr double center_margin = 1e-6;

/// The ball around the spheres counts as larger by this factor, for rounding.
constexpr double ball_room = 1.001;

/// A parallel light's origin is this many of the ball's radii before its middle: in front of all
/// spheres.
constexpr double origin_distance = 1.5;

/// A light for which the ball has a larger tangent gets no buffer: its cells would differ too much
/// in size.
constexpr double largest_tangent = 3.0;

/// The spheres may together cover this many times as many cells as there are spheres and cells,
/// else there is no buffer. Spheres side by side cover few cells. Where most overlap, the buffer
/// would take more memory than the spheres (light_buffers_of_spheres_in_each_other in
/// results/tree_designs.json).
constexpr std::size_t most_cells = 64;

/// The depth of cells without spheres. Its square is still a float.
constexpr double no_sphere_depth = 1e18;

/// The grid's cells along each axis: about as many cells as spheres side by side
/// (results/light_buffers.json).
int grid_size(int blocks)
{
    const int spheres = blocks * abi::node_width;
    return spheres < 20000 ? 64 : spheres < 200000 ? 128 : 256;
}

/// For parallel light, spheres count as nearer and as ending further away by this share of the
/// grid's width.
constexpr double depth_margin = 1e-4;

/// Rounding moves a point in the grid by at most this share of |x| + |y| + |z|, along both axes:
/// four roundings, and those of the axes.
constexpr double place_error = 0x1p-21;

/// The light's axes and its grid.
struct LightAxes {
    Vec3 origin;  ///< a point light's position
    Vec3 across;
    Vec3 up;
    Vec3 forward;
    double scale;  ///< cells for a tangent of 1; of parallel light, for a length of 1
    int size;      ///< cells along each axis; 0: no buffer
    bool parallel;

    [[nodiscard]] Vec3 seen(const Vec3& point) const
    {
        const Vec3 d = point - origin;
        return {glm::dot(across, d), glm::dot(up, d), glm::dot(forward, d)};
    }
};

/// A sphere in the space of the light's axes.
struct SeenSphere {
    Vec3 center;
    double distance = 0.0;            ///< of the centre from the light, or along parallel light
    double radius = -1.0;             ///< negative for an unused slot
    double larger = 0.0;              ///< the radius with room for rounding
    double size = 0.0;                ///< apparent size
    std::int16_t low[2] = {0, 0};     ///< the first of its cells along each axis
    std::int16_t high[2] = {-1, -1};  ///< the last one

    [[nodiscard]] double near() const
    {
        return distance - larger;
    }
};

struct Covered {
    double low;
    double high;
};

/// The range of tangents that a sphere covers along one axis; of parallel light, its coordinates.
Covered covered(const SeenSphere& sphere, int axis, const LightAxes& axes)
{
    const double radius = sphere.larger;
    const double x = sphere.center[axis];
    if (axes.parallel)
        return {x - radius, x + radius};
    const double z = sphere.center.z;
    const double root = radius * std::sqrt(std::max(0.0, x * x + z * z - radius * radius));
    const double below = z * z - radius * radius;
    return {(x * z - root) / below, (x * z + root) / below};
}

/// Sets the range of cells along one axis.
void set_range(SeenSphere& sphere, int axis, const LightAxes& axes)
{
    const Covered at = covered(sphere, axis, axes);
    const double half = 0.5 * axes.size;
    const double low = at.low * axes.scale + half - cell_margin;
    const double high = at.high * axes.scale + half + cell_margin;
    const double last = axes.size - 1;
    sphere.low[axis] = static_cast<std::int16_t>(std::clamp(std::floor(low), 0.0, last));
    sphere.high[axis] = static_cast<std::int16_t>(std::clamp(std::floor(high), 0.0, last));
}

SeenSphere see(const LightAxes& axes, const abi::BvhView<float>& tree, int place)
{
    const abi::SphereBlock<float>& block = tree.blocks[place / abi::node_width];
    const int slot = place % abi::node_width;
    SeenSphere sphere;
    if (!(block.radius[slot] > 0.0f))
        return sphere;
    sphere.center = axes.seen({double{block.center[0][slot]}, double{block.center[1][slot]},
                               double{block.center[2][slot]}});
    const double distance = glm::length(sphere.center);
    sphere.distance = axes.parallel ? sphere.center.z : distance;
    sphere.radius = double{block.radius[slot]};
    sphere.larger = sphere.radius * (1.0 + size_margin) + 2.0 * double{tree.center_error} +
                    center_margin * distance;
    sphere.size = axes.parallel ? sphere.radius : sphere.radius / distance;
    set_range(sphere, 0, axes);
    set_range(sphere, 1, axes);
    return sphere;
}

/// Calls `visit(cell)` for the cells of a sphere.
template <class Visit>
void for_each_cell(const SeenSphere& sphere, int size, const Visit& visit)
{
    for (int row = sphere.low[1]; row <= sphere.high[1]; ++row)
        for (int column = sphere.low[0]; column <= sphere.high[0]; ++column)
            visit(row * size + column);
}

/// Whether the spheres cover few enough cells.
bool is_sparse(const std::vector<SeenSphere>& spheres, int size)
{
    const auto cells = static_cast<std::size_t>(size * size);
    std::size_t covered = 0;
    for (const SeenSphere& sphere : spheres)
        covered += static_cast<std::size_t>((sphere.high[0] - sphere.low[0] + 1) *
                                            (sphere.high[1] - sphere.low[1] + 1));
    return covered <= most_cells * (spheres.size() + cells);
}

/// Whether a sphere fills a cell: all rays of the cell hit it if those through its corners do.
bool fills(const SeenSphere& sphere, const LightAxes& axes, int cell)
{
    const double smaller =
        sphere.radius * (1.0 - size_margin) - 2.0 * (sphere.larger - sphere.radius);
    if (!(smaller > 0.0))
        return false;
    const double half = 0.5 * axes.size;
    for (int corner = 0; corner < 4; ++corner) {
        const double column = cell % axes.size + (corner % 2 == 0 ? -cell_margin : 1 + cell_margin);
        const double row = cell / axes.size + (corner / 2 == 0 ? -cell_margin : 1 + cell_margin);
        const double x = (column - half) / axes.scale;
        const double y = (row - half) / axes.scale;
        const Vec3 way = axes.parallel ? Vec3(0, 0, 1) : Vec3(x, y, 1);
        const Vec3 from = axes.parallel ? sphere.center - Vec3(x, y, 0) : sphere.center;
        const Vec3 moment = glm::cross(from, way);
        if (glm::dot(moment, moment) > smaller * smaller * glm::dot(way, way))
            return false;
    }
    return true;
}

/// By cell, the depth where the nearest sphere that fills it ends. Behind it all is dark.
std::vector<float> dark_depths(const std::vector<SeenSphere>& spheres, const LightAxes& axes)
{
    std::vector<float> dark(static_cast<std::size_t>(axes.size * axes.size),
                            std::numeric_limits<float>::infinity());
    for (const SeenSphere& sphere : spheres) {
        // A sphere that covers fewer than three cells along an axis fills none.
        if (sphere.high[0] - sphere.low[0] < 2 || sphere.high[1] - sphere.low[1] < 2)
            continue;
        const auto back = static_cast<float>((sphere.distance + sphere.larger) * 1.000001);
        for_each_cell(sphere, axes.size, [&](int cell) {
            float& depth = dark[static_cast<std::size_t>(cell)];
            if (back < depth && fills(sphere, axes, cell))
                depth = back;
        });
    }
    return dark;
}

/// The spheres of each cell, in one array.
struct CellSpheres {
    std::vector<float> dark;  ///< by cell, dark_depths()
    std::vector<int> first;   ///< by cell, the index of its first sphere in `place`; and the end
    std::vector<int> place;   ///< of the spheres in the blocks of the BVH
};

CellSpheres sort_into_cells(const std::vector<SeenSphere>& spheres, const LightAxes& axes)
{
    CellSpheres cells;
    cells.dark = dark_depths(spheres, axes);
    const auto for_each_lit = [&](const SeenSphere& sphere, const auto& visit) {
        const double near = sphere.radius < 0.0 ? 0.0 : sphere.near();
        for_each_cell(sphere, axes.size, [&](int cell) {
            if (near <= double{cells.dark[static_cast<std::size_t>(cell)]})
                visit(static_cast<std::size_t>(cell));
        });
    };
    cells.first.assign(cells.dark.size() + 1, 0);
    for (const SeenSphere& sphere : spheres)
        for_each_lit(sphere, [&](std::size_t cell) { ++cells.first[cell + 1]; });
    for (std::size_t cell = 0; cell < cells.dark.size(); ++cell)
        cells.first[cell + 1] += cells.first[cell];
    cells.place.resize(static_cast<std::size_t>(cells.first.back()));
    std::vector<int> next(cells.first.begin(), cells.first.end() - 1);
    for (const SeenSphere& sphere : spheres)
        for_each_lit(sphere, [&](std::size_t cell) {
            cells.place[static_cast<std::size_t>(next[cell]++)] =
                static_cast<int>(&sphere - spheres.data());
        });
    return cells;
}

/// Turns the axes to the middle of the spheres' ball. Returns the tangent of the ball seen from the
/// light, infinite where a point light is inside it; of parallel light, the ball's radius.
double look_at_spheres(LightAxes& axes, const abi::LightRecord<float>& light,
                       const abi::BvhView<float>& tree)
{
    const Vec3 vector(double{light.vector[0]}, double{light.vector[1]}, double{light.vector[2]});
    const Vec3 middle(double{tree.middle[0]}, double{tree.middle[1]}, double{tree.middle[2]});
    const double radius = double{tree.radius} * ball_room;
    if (axes.parallel) {
        axes.forward = -glm::normalize(vector);
        const Vec3 origin = middle - origin_distance * radius * axes.forward;
        // Rounded as the kernels have it.
        for (int axis = 0; axis < 3; ++axis)
            axes.origin[axis] = double{static_cast<float>(origin[axis])};
        return radius * ball_room;
    }
    axes.origin = vector;
    const Vec3 way = middle - vector;
    const double distance = glm::length(way);
    axes.forward = way / distance;
    return radius / std::sqrt(std::max(0.0, distance * distance - radius * radius));
}

LightAxes axes_of(const abi::LightRecord<float>& light, const abi::BvhView<float>& tree, int size)
{
    LightAxes axes{};
    axes.parallel = light.kind == abi::LightKind::directional;
    const double radius = look_at_spheres(axes, light, tree);
    if (!(radius < (axes.parallel ? std::numeric_limits<double>::infinity() : largest_tangent)))
        return axes;
    const Vec3 side = std::abs(axes.forward.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    axes.across = glm::normalize(glm::cross(axes.forward, side));
    axes.up = glm::cross(axes.forward, axes.across);
    axes.size = size;
    axes.scale = 0.5 * size / (ball_room * radius);
    return axes;
}

/// Largest first: a sphere that looks larger from the light occludes more of its rays.
void sort_by_size(std::span<int> places, const std::vector<SeenSphere>& spheres)
{
    std::sort(places.begin(), places.end(), [&](int a, int b) {
        const SeenSphere& one = spheres[static_cast<std::size_t>(a)];
        const SeenSphere& other = spheres[static_cast<std::size_t>(b)];
        return one.size != other.size ? one.size > other.size : a < b;
    });
}

/// LightCell::near of a cell whose spheres begin at `depth`.
float depth_in_front(double depth, const LightAxes& axes)
{
    if (axes.parallel)
        return static_cast<float>(depth - depth_margin * axes.size / axes.scale);
    const double nearer = std::max(0.0, depth * (1.0 - size_margin));
    return static_cast<float>(nearer * nearer);
}

/// LightCell::dark of a cell that is filled by a sphere which ends at `depth`.
float depth_behind(double depth, const LightAxes& axes)
{
    if (axes.parallel)
        return static_cast<float>(depth + depth_margin * axes.size / axes.scale);
    const double further = depth * (1.0 + size_margin);
    return static_cast<float>(further * further);
}

/// The depth where the first of some spheres begins.
double least_depth(std::span<const int> places, const std::vector<SeenSphere>& spheres)
{
    double depth = no_sphere_depth;
    for (const int place : places)
        depth = std::min(depth, spheres[static_cast<std::size_t>(place)].near());
    return depth;
}

void fill_blocks(std::span<abi::LightBlock> blocks, std::span<const int> places,
                 const abi::BvhView<float>& tree)
{
    for (std::size_t i = 0; i < blocks.size() * abi::light_block_width; ++i) {
        abi::LightBlock& block = blocks[i / abi::light_block_width];
        const std::size_t slot = i % abi::light_block_width;
        const bool used = i < places.size();
        const int place = used ? places[i] : 0;
        const abi::SphereBlock<float>& from = tree.blocks[place / abi::node_width];
        const int from_slot = place % abi::node_width;
        for (int axis = 0; axis < 3; ++axis)
            block.center[axis][slot] =
                used ? from.center[axis][from_slot] : abi::largest_coordinate;
        block.radius[slot] = used ? from.radius[from_slot] : -1.0f;
        block.surface[slot] = used ? tree.block_surfaces[place] : -1;
    }
}

void round_axis(float (&rounded)[3], const Vec3& axis)
{
    for (int i = 0; i < 3; ++i)
        rounded[i] = static_cast<float>(axis[i]);
}

/// Cells with as many blocks each as their spheres need, one cell's after the other's.
AlignedArray<abi::LightCell> cells_of(const CellSpheres& sorted)
{
    AlignedArray<abi::LightCell> cells(sorted.first.size() - 1);
    std::int32_t used = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        const int spheres = sorted.first[cell + 1] - sorted.first[cell];
        cells[cell].first = used;
        cells[cell].count = (spheres + abi::light_block_width - 1) / abi::light_block_width;
        used += cells[cell].count;
    }
    return cells;
}

/// The grid without its cells.
abi::LightBuffer grid_of(const LightAxes& axes)
{
    abi::LightBuffer grid;
    round_axis(grid.across, axes.across * axes.scale);
    round_axis(grid.up, axes.up * axes.scale);
    round_axis(grid.forward, axes.forward);
    round_axis(grid.origin, axes.origin);
    grid.parallel = axes.parallel;
    grid.reach = static_cast<float>(0.25 * cell_margin / (place_error * axes.scale));
    grid.size = axes.size;
    return grid;
}

}  // namespace

PackedLightBuffer::PackedLightBuffer(const abi::LightRecord<float>& light,
                                     const abi::BvhView<float>& tree, int blocks)
{
    // Project all spheres onto the grid.
    const LightAxes axes = axes_of(light, tree, grid_size(blocks));
    if (axes.size == 0)
        return;
    std::vector<SeenSphere> spheres(static_cast<std::size_t>(blocks) * abi::node_width);
    tbb::parallel_for(std::size_t{0}, spheres.size(), [&](std::size_t place) {
        spheres[place] = see(axes, tree, static_cast<int>(place));
    });
    if (!is_sparse(spheres, axes.size))
        return;

    // Sort them into the cells, and fill the blocks of each cell.
    CellSpheres sorted = sort_into_cells(spheres, axes);
    cells_ = cells_of(sorted);
    const abi::LightCell& last = cells_[cells_.size() - 1];
    blocks_ =
        AlignedArray<abi::LightBlock>::unset(static_cast<std::size_t>(last.first + last.count));
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t cell) {
        const std::span<int> places(sorted.place.data() + sorted.first[cell],
                                    sorted.place.data() + sorted.first[cell + 1]);
        sort_by_size(places, spheres);
        cells_[cell].near = depth_in_front(least_depth(places, spheres), axes);
        cells_[cell].dark = depth_behind(double{sorted.dark[cell]}, axes);
        fill_blocks(
            {blocks_.data() + cells_[cell].first, static_cast<std::size_t>(cells_[cell].count)},
            places, tree);
    });
    view_ = grid_of(axes);
    view_.cells = cells_.data();
    view_.blocks = blocks_.data();
}

}  // namespace packtrace
