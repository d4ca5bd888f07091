#pragma once

#include "lab/report/report_study.hpp"
#include "lab/stress/stress.hpp"
#include "mpi/job.hpp"
#include "mpi/wire.hpp"

#include <type_traits>
#include <utility>

// The data of reports and stress tests that ranks send each other.
namespace packtrace {

template <class Wire, class Share>
requires std::is_same_v<std::remove_const_t<Share>, ErrorShare>
void each_field(Wire& wire, Share& share)
{
    wire(share.kind, share.meaning, share.pixels, share.squared_error);
}

template <class Wire, class Error>
requires std::is_same_v<std::remove_const_t<Error>, Comparison>
void each_field(Wire& wire, Error& error)
{
    wire(error.max_abs, error.rmse, error.psnr, error.pixels, error.pixels_off, error.worst);
}

template <class Wire, class Picture>
requires std::is_same_v<std::remove_const_t<Picture>, Image<double>>
void each_field(Wire& wire, Picture& picture)
{
    wire(picture.width, picture.height, picture.rgb);
}

/// All fields except the variant, which rank 0 knows, and values that follow from other runs.
template <class Wire, class Look>
requires std::is_same_v<std::remove_const_t<Look>, StudyLook>
void each_field(Wire& wire, Look& look)
{
    wire(look.run.rays, look.run.cut, look.run.error, look.run.looked_at, look.run.looked_at_off,
         look.run.shares, look.picture);
}

}  // namespace packtrace

namespace packtrace::lab {

/// All fields of a row.
template <class Wire, class Row>
requires std::is_same_v<std::remove_const_t<Row>, StressRow>
void each_field(Wire& wire, Row& row)
{
    wire(static_cast<std::conditional_t<std::is_const_v<Row>, const ErrorCounts&, ErrorCounts&>>(
             row),
         row.family, row.precision, row.kernel, row.mode, row.isa, row.held, row.wrong, row.ulp,
         row.normal, row.second_rays, row.self_hits, row.second_lost, row.second_inexact,
         row.second, row.bounds, row.bounds_missed, row.bounds_ulp, row.ns, row.pareto,
         row.example_scene, row.example_ray, row.example, row.faults);
}

}  // namespace packtrace::lab

namespace packtrace::mpi {

/// A piece of work with these values.
template <class... T>
[[nodiscard]] Piece piece_of(const T&... values)
{
    WireWriter wire;
    wire(values...);
    Piece piece;
    piece.bytes = std::move(wire.bytes);
    return piece;
}

}  // namespace packtrace::mpi
