#include "cli/render/band_file.hpp"

#include "cli/render/frame_recipe.hpp"
#include "core/checksum.hpp"

#include <bit>
#include <utility>

namespace packtrace::cli {
namespace {

std::string head_of(const RenderArguments& arguments, const Scene& scene,
                    const RenderOptions& options, const Bands& bands)
{
    return FrameRecipe(arguments, scene, options).of(scene.camera) + ", bands of " +
           std::to_string(bands.rows) + " rows";
}

}  // namespace

BandFile::BandFile(const RenderArguments& arguments, const Scene& scene,
                   const RenderOptions& options, std::int64_t pixels)
    : samples_(arguments.output, scene.width, arguments.write.gamma),
      bands_(cut_into_bands(scene.width, scene.height, samples_.format(), pixels)),
      kept_(static_cast<std::size_t>(bands_.count())),
      journal_(arguments.resume ? std::make_unique<Journal>(
                                      arguments.output, head_of(arguments, scene, options, bands_),
                                      recipe_difference)
                                : nullptr),
      file_(arguments.output, scene.width, scene.height)
{
    if (!journal_)
        return;
    for (const Journal::Entry& entry : journal_->entries())
        if (entry.size() == 4 && entry[0] < kept_.size())
            kept_[entry[0]] = {entry[1], {entry[2], std::bit_cast<double>(entry[3])}};
}

std::optional<FinishedBand> BandFile::kept(int number) const
{
    if (!was_kept(number))
        return std::nullopt;
    const Noted& noted = *kept_[static_cast<std::size_t>(number)];
    FinishedBand band{Bytes(band_bytes(number)), noted.cut};
    journal_->read(offset(number), band.samples);
    if (checksum(band.samples) != noted.checksum)
        return std::nullopt;
    return band;
}

void BandFile::keep(int number, const FinishedBand& band)
{
    if (!journal_)
        return;
    journal_->write(offset(number), band.samples);
    journal_->add({static_cast<std::uint64_t>(number), checksum(band.samples), band.cut.rays,
                   std::bit_cast<std::uint64_t>(band.cut.bound)});
}

void BandFile::write(const Bytes& samples)
{
    file_.write(samples);
}

void BandFile::commit()
{
    file_.commit();
    if (journal_)
        journal_->remove();
}

}  // namespace packtrace::cli
