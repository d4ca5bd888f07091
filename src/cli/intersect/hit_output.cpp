#include "cli/intersect/hit_output.hpp"

#include "cli/interrupts.hpp"
#include "cli/options/shard.hpp"
#include "cli/render/frame_recipe.hpp"
#include "core/checksum.hpp"
#include "image/bytes.hpp"

#include <algorithm>

namespace packtrace::cli {
namespace {

/// Adds the bytes of the part file from `begin` to `end` to a checksum.
std::uint32_t checksum_of(const Journal& journal, std::uint64_t begin, std::uint64_t end,
                          std::uint32_t before)
{
    Bytes piece;
    while (begin < end) {
        piece.assign(std::min<std::uint64_t>(end - begin, std::uint64_t{1} << 20), 0);
        journal.read(begin, piece);
        before = checksum(piece, before);
        begin += piece.size();
    }
    return before;
}

}  // namespace

HitOutput::HitOutput(const IntersectArguments& arguments, const std::string& recipe,
                     std::string_view header)
    : name_(arguments.output)
{
    if (!arguments.resume) {
        text_ = std::make_unique<Output>(arguments.output);
        append(header);
        return;
    }
    journal_ = std::make_unique<Journal>(arguments.output, recipe, recipe_difference);
    done_ = find_finished(header);
    journal_->truncate(done_.bytes);
    journal_->write(0, bytes_of(header));
    note_progress();
}

/// The progress at the last entry whose bytes are in the part file.
HitOutput::Progress HitOutput::find_finished(std::string_view header) const
{
    Progress done{.bytes = header.size(), .rows = checksum(bytes_of(header))};
    Bytes begun(header.size());
    journal_->read(0, begun);
    if (checksum(begun) != done.rows) {
        // The head of a part depends on its file of rays, so the rays have changed.
        const std::string_view text(reinterpret_cast<const char*>(begun.data()), begun.size());
        if (PartHead::parse(text.substr(0, text.find('\n'))))
            fail_of_rays();
        return done;
    }
    for (const Journal::Entry& entry : journal_->entries()) {
        if (entry.size() != 4 || entry[0] <= done.blocks || entry[2] < done.bytes)
            continue;
        const std::uint32_t rows = checksum_of(*journal_, done.bytes, entry[2], done.rows);
        if (rows != entry[3])
            break;
        done = {entry[0], static_cast<std::uint32_t>(entry[1]), entry[2], rows};
    }
    return done;
}

void HitOutput::skip_finished(const std::function<std::string()>& next)
{
    std::uint32_t sum = 0;
    for (std::uint64_t i = 0; i < done_.blocks; ++i)
        sum = checksum(bytes_of(next()), sum);
    if (sum != done_.rays)
        fail_of_rays();
}

void HitOutput::fail_of_rays() const
{
    throw FileError(name_ +
                    ".journal: was begun with other rays; use what it was begun with, or remove "
                    "this file to begin again");
}

void HitOutput::take(std::string_view block, std::string_view rows)
{
    append(rows);
    if (text_)
        return;
    ++done_.blocks;
    done_.rays = checksum(bytes_of(block), done_.rays);
    journal_->add({done_.blocks, done_.rays, done_.bytes, done_.rows});
    note_progress();
}

/// Sets the message for an interruption: what the run leaves behind.
void HitOutput::note_progress() const
{
    set_interrupt_line("interrupted; the same command goes on after the " +
                       std::to_string(done_.blocks) + " finished blocks of rays of " + name_);
}

void HitOutput::end_part()
{
    append(PartEnd{done_.bytes, done_.rows}.line());
}

void HitOutput::append(std::string_view text)
{
    if (text_)
        text_->write(text);
    else
        journal_->write(done_.bytes, bytes_of(text));
    done_.bytes += text.size();
    done_.rows = checksum(bytes_of(text), done_.rows);
}

void HitOutput::finish()
{
    if (text_)
        return text_->finish();
    journal_->rename_part();
    set_interrupt_line("");
}

}  // namespace packtrace::cli
