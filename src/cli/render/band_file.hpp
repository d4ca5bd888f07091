#pragma once

#include "cli/output/journal.hpp"
#include "cli/render/render_arguments.hpp"
#include "cli/render/render_bands.hpp"
#include <packtrace/scene.hpp>

#include <memory>
#include <optional>
#include <string>

namespace packtrace::cli {

/// A finished band.
struct FinishedBand {
    Bytes samples;
    CutRays cut;
};

/// The file of a picture that is rendered in bands. With `--resume`, finished bands are kept beside
/// it until it is complete, and bands of an earlier run are reused.
class BandFile {
public:
    /// Bands have about `pixels` pixels. Throws ImageError, and FileError if the journal belongs to
    /// another picture.
    BandFile(const RenderArguments& arguments, const Scene& scene, const RenderOptions& options,
             std::int64_t pixels);

    [[nodiscard]] const Bands& bands() const
    {
        return bands_;
    }
    [[nodiscard]] const RowSamples& samples() const
    {
        return samples_;
    }
    [[nodiscard]] std::size_t band_bytes(int number) const
    {
        return samples_.row_bytes() * static_cast<std::size_t>(bands_.band(number).rows);
    }

    /// A band of an earlier run; not set if its samples do not match the journal.
    [[nodiscard]] std::optional<FinishedBand> kept(int number) const;

    /// Keeps a finished band, if there is a journal. Bands may come in any order.
    void keep(int number, const FinishedBand& band);
    /// Writes the next band, in the file's order.
    void write(const Bytes& samples);
    /// Call it after the last band.
    void commit();

private:
    /// Whether the journal has the band as finished by an earlier run.
    [[nodiscard]] bool was_kept(int number) const
    {
        return kept_[static_cast<std::size_t>(number)].has_value();
    }

    /// The journal's entry of a band.
    struct Noted {
        std::uint64_t checksum = 0;
        CutRays cut;
    };

    [[nodiscard]] std::uint64_t offset(int number) const
    {
        return samples_.row_bytes() * static_cast<std::uint64_t>(bands_.band(number).first);
    }

    RowSamples samples_;
    Bands bands_;
    std::vector<std::optional<Noted>> kept_;
    std::unique_ptr<Journal> journal_;
    RowFile file_;
};

}  // namespace packtrace::cli
