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
/// it until it is complete, and those that an earlier run kept are given back.
class BandFile {
public:
    /// Bands of about `pixels` pixels. Throws ImageError, or FileError where the journal is of
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

    /// The band; nothing where its samples are not those that were noted.
    [[nodiscard]] std::optional<FinishedBand> kept(int number) const;

    /// Keeps a finished band, if there is a journal. In any order.
    void keep(int number, const FinishedBand& band);
    /// Writes the next band, in the file's order.
    void write(const Bytes& samples);
    /// After the last band.
    void commit();

private:
    /// Whether an earlier run noted the band as finished.
    [[nodiscard]] bool was_kept(int number) const
    {
        return kept_[static_cast<std::size_t>(number)].has_value();
    }

    /// What the journal says of a band.
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
