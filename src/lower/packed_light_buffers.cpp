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

/// Share of a cell that a sphere reaches beyond what it covers: far more than rounding does to
/// where a ray lies in the grid.
constexpr double cell_margin = 0.02;

/// Share by which a sphere is taken to be larger than it is, and smaller where it hides others.
constexpr double size_margin = 1e-4;

/// Lights from which the spheres' ball has a wider tangent than this see cells too unlike in size.
constexpr double widest = 3.0;

/// So many cells, to a sphere and to a cell, may spheres cover: they stand side by side in few.
/// Where most of them are in each other, and their view would take more room than they, there is
/// none: results/tree_designs.json.
constexpr std::size_t most_cells = 64;

/// About as many cells as spheres stand side by side: results/light_buffers.json.
int grid_size(int blocks)
{
    const int spheres = blocks * abi::node_width;
    return spheres < 20000 ? 64 : spheres < 200000 ? 128 : 256;
}

/// Share of their ball's radius by which spheres are taken to be nearer to parallel light.
constexpr double depth_margin = 1e-4;

/// Rounding moves where a point lies in the grid by no more than this share of |x| + |y| + |z|,
/// in both axes: four roundings, and those of the axes.
constexpr double place_error = 0x1p-21;

/// The light's axes, and how many cells there are to a tangent of 1, or for parallel light to a
/// length of 1.
struct LightAxes {
    Vec3 origin;  ///< a point light's place
    Vec3 across;
    Vec3 up;
    Vec3 forward;
    double scale;
    int size;
    bool parallel;

    [[nodiscard]] Vec3 seen(const Vec3& point) const
    {
        const Vec3 d = point - origin;
        return {glm::dot(across, d), glm::dot(up, d), glm::dot(forward, d)};
    }
};

/// A sphere as the light sees it.
struct SeenSphere {
    Vec3 center;
    double distance = 0.0;  ///< of the centre; ahead of the origin, for parallel light
    double radius = -1.0;   ///< negative: none
    double larger = 0.0;    ///< a radius that holds what rounding does, too
    double size = 0.0;      ///< that it looks
    std::int16_t low[2] = {0, 0};
    std::int16_t high[2] = {-1, -1};  ///< its cells, the last ones included

    [[nodiscard]] double near() const
    {
        return distance - larger;
    }
};

/// What a circle of the plane of one axis and the way ahead covers, before scaling.
struct Covered {
    double low;
    double high;
};
Covered covered(const Vec3& center, double radius, int axis, bool parallel)
{
    const double x = center[axis];
    if (parallel)
        return {x - radius, x + radius};
    const double z = center.z;
    const double root = radius * std::sqrt(std::max(0.0, x * x + z * z - radius * radius));
    const double below = z * z - radius * radius;
    return {(x * z - root) / below, (x * z + root) / below};
}

/// The range of cells along one axis.
void set_range(SeenSphere& sphere, int axis, const LightAxes& axes)
{
    const Covered at = covered(sphere.center, sphere.larger, axis, axes.parallel);
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
    sphere.larger =
        sphere.radius * (1.0 + size_margin) + 2.0 * double{tree.center_error} + 1e-6 * distance;
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

/// Whether the spheres cover no more cells than their view may have room for.
bool is_sparse(const std::vector<SeenSphere>& spheres, int size)
{
    const auto cells = static_cast<std::size_t>(size * size);
    std::size_t covered = 0;
    for (const SeenSphere& sphere : spheres)
        covered += static_cast<std::size_t>((sphere.high[0] - sphere.low[0] + 1) *
                                            (sphere.high[1] - sphere.low[1] + 1));
    return covered <= most_cells * (spheres.size() + cells);
}

/// Whether all rays of a cell go through a sphere: those through its corners do.
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

/// By cell, where the nearest sphere that fills it ends: nothing is lit behind that.
std::vector<float> dark_depths(const std::vector<SeenSphere>& spheres, const LightAxes& axes)
{
    std::vector<float> dark(static_cast<std::size_t>(axes.size * axes.size),
                            std::numeric_limits<float>::infinity());
    for (const SeenSphere& sphere : spheres) {
        // None of a smaller sphere's cells is filled.
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

/// The spheres of each cell, one cell's after the other's.
struct CellSpheres {
    std::vector<float> dark;  ///< by cell, dark_depths()
    std::vector<int> first;   ///< by cell, and the end of the last
    std::vector<int> place;
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

/// The direction that a light sees the spheres' middle in, and the radius of what it sees around
/// that by the measure of its grid; no number for one that does not see all of them ahead of it.
double look_at_spheres(LightAxes& axes, const abi::LightRecord<float>& light,
                       const abi::BvhView<float>& tree)
{
    const Vec3 vector(double{light.vector[0]}, double{light.vector[1]}, double{light.vector[2]});
    const Vec3 middle(double{tree.middle[0]}, double{tree.middle[1]}, double{tree.middle[2]});
    const double radius = double{tree.radius} * 1.001;
    if (axes.parallel) {
        axes.forward = -glm::normalize(vector);
        const Vec3 origin = middle - 1.5 * radius * axes.forward;
        // As the kernels have it.
        for (int axis = 0; axis < 3; ++axis)
            axes.origin[axis] = double{static_cast<float>(origin[axis])};
        return radius * 1.001;
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
    if (!(radius < (axes.parallel ? std::numeric_limits<double>::infinity() : widest)))
        return axes;
    const Vec3 side = std::abs(axes.forward.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    axes.across = glm::normalize(glm::cross(axes.forward, side));
    axes.up = glm::cross(axes.forward, axes.across);
    axes.size = size;
    axes.scale = 0.5 * size / (1.001 * radius);
    return axes;
}

/// What looks largest from the light blocks most of its rays.
void sort_by_size(std::span<int> places, const std::vector<SeenSphere>& spheres)
{
    std::sort(places.begin(), places.end(), [&](int a, int b) {
        const SeenSphere& one = spheres[static_cast<std::size_t>(a)];
        const SeenSphere& other = spheres[static_cast<std::size_t>(b)];
        return one.size != other.size ? one.size > other.size : a < b;
    });
}

/// A depth as LightCell has it, of spheres that begin there.
float depth_in_front(double depth, const LightAxes& axes)
{
    if (axes.parallel)
        return static_cast<float>(depth - depth_margin * axes.size / axes.scale);
    const double nearer = std::max(0.0, depth * (1.0 - size_margin));
    return static_cast<float>(nearer * nearer);
}

/// The same of a sphere that ends there.
float depth_behind(double depth, const LightAxes& axes)
{
    if (axes.parallel)
        return static_cast<float>(depth + depth_margin * axes.size / axes.scale);
    const double further = depth * (1.0 + size_margin);
    return static_cast<float>(further * further);
}

/// Where the first of some spheres begins.
double nearest(std::span<const int> places, const std::vector<SeenSphere>& spheres)
{
    double distance = 1e18;
    for (const int place : places)
        distance = std::min(distance, spheres[static_cast<std::size_t>(place)].near());
    return distance;
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
        const int there = place % abi::node_width;
        for (int axis = 0; axis < 3; ++axis)
            block.center[axis][slot] = used ? from.center[axis][there] : abi::largest_coordinate;
        block.radius[slot] = used ? from.radius[there] : -1.0f;
        block.surface[slot] = used ? tree.block_surfaces[place] : -1;
    }
}

void round_axis(float (&rounded)[3], const Vec3& axis)
{
    for (int i = 0; i < 3; ++i)
        rounded[i] = static_cast<float>(axis[i]);
}

/// Cells that have room in the blocks, one after the other, for their spheres.
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
    const LightAxes axes = axes_of(light, tree, grid_size(blocks));
    if (axes.size == 0)
        return;
    std::vector<SeenSphere> spheres(static_cast<std::size_t>(blocks) * abi::node_width);
    tbb::parallel_for(std::size_t{0}, spheres.size(), [&](std::size_t place) {
        spheres[place] = see(axes, tree, static_cast<int>(place));
    });
    if (!is_sparse(spheres, axes.size))
        return;
    CellSpheres sorted = sort_into_cells(spheres, axes);
    cells_ = cells_of(sorted);
    const abi::LightCell& last = cells_[cells_.size() - 1];
    blocks_ =
        AlignedArray<abi::LightBlock>::unset(static_cast<std::size_t>(last.first + last.count));
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t cell) {
        const std::span<int> places(sorted.place.data() + sorted.first[cell],
                                    sorted.place.data() + sorted.first[cell + 1]);
        sort_by_size(places, spheres);
        cells_[cell].near = depth_in_front(nearest(places, spheres), axes);
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
