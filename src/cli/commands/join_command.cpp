#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/options/shard.hpp"
#include "cli/output/distinct_files.hpp"
#include "cli/output/output.hpp"
#include "cli/study/study.hpp"
#include "core/checksum.hpp"
#include "core/read_file.hpp"
#include "scene/language/quote.hpp"

namespace packtrace::cli {
namespace {

struct JoinArguments {
    std::vector<std::string> parts;
    std::string output;
};

/// An open part of a file of hits, after its first line.
struct HitPart {
    std::string name;
    PartHead head;
    OpenFile file;
    std::uint64_t left = 0;  ///< bytes, without the last line
};

std::string read_line(std::FILE* file)
{
    std::string line;
    for (int c; (c = std::fgetc(file)) != EOF && c != '\n';)
        line += static_cast<char>(c);
    return line;
}

/// Calls `take(bytes)` with the next `count` bytes, or with as many as there are, piece by piece.
template <class Take>
void read_bytes(const HitPart& part, std::uint64_t count, const Take& take)
{
    std::vector<char> block(std::size_t{1} << 20);
    for (std::size_t got = 1; count > 0 && got > 0; count -= got) {
        got = std::fread(block.data(), 1, std::min<std::uint64_t>(count, block.size()),
                         part.file.get());
        take(std::string_view(block.data(), got));
    }
    if (std::ferror(part.file.get()))
        throw FileError(part.name, "can't read", errno);
}

/// How many bytes stand before the last line, which says so. Throws where they are not those that
/// were written.
std::uint64_t bytes_of_whole(const HitPart& part)
{
    std::FILE* const file = part.file.get();
    std::fseek(file, 0, SEEK_END);
    const auto size = static_cast<std::uint64_t>(std::max(0L, std::ftell(file)));
    const std::uint64_t searched = std::min<std::uint64_t>(size, PartEnd::longest);
    std::fseek(file, static_cast<long>(size - searched), SEEK_SET);
    std::string end;
    read_bytes(part, searched, [&](std::string_view bytes) { end += bytes; });
    const std::size_t begin = std::min(end.rfind(PartEnd::begin), end.size());
    const std::uint64_t before = size - (end.size() - begin);
    PartEnd whole{before, 0};
    std::rewind(file);
    read_bytes(part, before, [&](std::string_view bytes) {
        whole.checksum = checksum(bytes_of(bytes), whole.checksum);
    });
    if (!end.ends_with(whole.line()))
        throw FileError(part.name +
                        ": is not all of what packtrace wrote there; make this part again");
    return before;
}

HitPart open_part(const std::string& name)
{
    HitPart part{language::escape(name), {}, {}, 0};
    part.file.reset(std::fopen(name.c_str(), "rb"));
    if (!part.file)
        throw FileError(part.name, "can't read", errno);
    const std::optional<PartHead> head = PartHead::parse(read_line(part.file.get()));
    if (!head)
        throw FileError(part.name +
                        ": is not a part that packtrace intersect --shard or stress --shard wrote");
    part.head = *head;
    part.left = bytes_of_whole(part) - head->line().size();
    std::fseek(part.file.get(), static_cast<long>(head->line().size()), SEEK_SET);
    return part;
}

int first_byte(const std::string& name)
{
    const OpenFile file(std::fopen(name.c_str(), "rb"));
    if (!file)
        throw FileError(language::escape(name), "can't read", errno);
    return std::fgetc(file.get());
}

/// All parts, each in its place. Throws where one is missing or of other work.
std::vector<HitPart> open_parts(const std::vector<std::string>& names)
{
    std::vector<HitPart> parts;
    for (const std::string& name : names) {
        HitPart part = open_part(name);
        if (parts.empty())
            parts.resize(static_cast<std::size_t>(part.head.shard.count));
        const auto index = static_cast<std::size_t>(part.head.shard.index);
        const bool same_count = static_cast<std::size_t>(part.head.shard.count) == parts.size();
        for (const HitPart& other : parts)
            if (!same_count || (other.file && other.head.recipe != part.head.recipe))
                throw FileError(part.name +
                                ": is a part of other work than the parts before it; join parts of "
                                "one scene, the same options, rays and number of parts");
        if (parts[index].file)
            throw FileError(part.name + ": is part " + part.head.shard.text() + ", and so is " +
                            parts[index].name + "; give each part once");
        parts[index] = std::move(part);
    }
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (!parts[i].file)
            throw FileError("part " + std::to_string(i) + "/" + std::to_string(parts.size()) +
                            " is missing; give all parts");
    return parts;
}

void join_hits(const std::vector<HitPart>& parts, Output& output)
{
    std::string header;
    for (const HitPart& part : parts) {
        const std::string own = read_line(part.file.get()) + "\n";
        if (header.empty())
            output.write(header = own);
        read_bytes(part, part.left - own.size(),
                   [&](std::string_view rows) { output.write(rows); });
    }
}

void run_join(const JoinArguments& arguments)
{
    check_not_read(arguments.output, arguments.parts);
    const bool json = first_byte(arguments.parts.front()) == '{';
    if (json) {
        const std::string joined = join_stress(arguments.parts);
        Output output(arguments.output);
        output.write(joined);
        return output.finish();
    }
    const std::vector<HitPart> parts = open_parts(arguments.parts);
    Output output(arguments.output);
    join_hits(parts, output);
    output.finish();
}

}  // namespace

void add_join(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("join", "Make one file of the parts that --shard wrote");
    const auto arguments = std::make_shared<JoinArguments>();
    command
        ->add_option("PART", arguments->parts,
                     "All parts, in any order: of intersect --shard, or of stress --shard --json")
        ->required()
        ->type_name("");
    command->add_option("-o,--output", arguments->output, "File to write (default standard output)")
        ->check(file_name())
        ->type_name("FILE");
    command->callback([arguments] { run_join(*arguments); });
}

}  // namespace packtrace::cli
