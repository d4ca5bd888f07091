#include "cli/command.hpp"
#include "cli/options/shard.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/distinct_files.hpp"
#include "cli/output/output.hpp"
#include "cli/study/study.hpp"
#include "core/checksum.hpp"
#include "core/read_file.hpp"
#include "scene/language/quote.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace packtrace::cli {
namespace {

struct JoinArguments {
    std::vector<std::string> parts;
    std::string output;
};

/// A part of a file of hits. It is open only while it is read, because there may be more parts than
/// a program may open.
struct HitPart {
    std::string file;  ///< empty for a missing part
    PartHead head;
    std::uint64_t end = 0;  ///< bytes before the last line

    /// The name for messages.
    [[nodiscard]] std::string name() const
    {
        return language::escape(file);
    }
};

OpenFile open_file(const std::string& name)
{
    OpenFile file(std::fopen(name.c_str(), "rb"));
    if (!file)
        throw FileError(language::escape(name), FileAction::read, errno);
    return file;
}

/// An upper limit of the first and the last line of a part.
constexpr std::size_t longest_line = std::size_t{1} << 16;

/// Reads a line without its end; empty for a line that is too long.
std::string read_line(const std::string& name, std::FILE* file)
{
    std::string line;
    for (int c; (c = std::fgetc(file)) != EOF && c != '\n';) {
        if (line.size() == longest_line)
            return {};
        line += static_cast<char>(c);
    }
    if (std::ferror(file))
        throw FileError(name, FileAction::read, errno);
    return line;
}

void go_to(const std::string& name, std::FILE* file, off_t place, int from)
{
    if (fseeko(file, place, from) != 0)
        throw FileError(name, FileAction::read, errno);
}

std::uint64_t size_of(const std::string& name, std::FILE* file)
{
    go_to(name, file, 0, SEEK_END);
    const off_t size = ftello(file);
    if (size < 0)
        throw FileError(name, FileAction::read, errno);
    return static_cast<std::uint64_t>(size);
}

/// Calls `take(bytes)` with the next `count` bytes, piece by piece. There may be fewer bytes.
template <class Take>
void read_bytes(const std::string& name, std::FILE* file, std::uint64_t count, const Take& take)
{
    std::vector<char> block(std::size_t{1} << 20);
    for (std::size_t got = 1; count > 0 && got > 0; count -= got) {
        got = std::fread(block.data(), 1, std::min<std::uint64_t>(count, block.size()), file);
        take(std::string_view(block.data(), got));
    }
    if (std::ferror(file))
        throw FileError(name, FileAction::read, errno);
}

/// The number of bytes before the last line. Throws unless they have the length and checksum that
/// the last line says.
std::uint64_t bytes_of_whole(const std::string& name, std::FILE* file)
{
    const std::uint64_t size = size_of(name, file);
    const std::uint64_t searched = std::min<std::uint64_t>(size, PartEnd::longest);
    go_to(name, file, static_cast<off_t>(size - searched), SEEK_SET);
    std::string end;
    read_bytes(name, file, searched, [&](std::string_view bytes) { end += bytes; });
    const std::size_t begin = std::min(end.rfind(PartEnd::begin), end.size());
    const std::uint64_t before = size - (end.size() - begin);
    PartEnd whole{before, 0};
    go_to(name, file, 0, SEEK_SET);
    read_bytes(name, file, before, [&](std::string_view bytes) {
        whole.checksum = checksum(bytes_of(bytes), whole.checksum);
    });
    if (!end.ends_with(whole.line()))
        throw FileError(name + ": is not all of what packtrace wrote there; make this part again");
    return before;
}

HitPart check_part(const std::string& name)
{
    HitPart part{name, {}, 0};
    const OpenFile file = open_file(name);
    const std::optional<PartHead> head = PartHead::parse(read_line(part.name(), file.get()));
    if (!head)
        throw FileError(part.name() +
                        ": is not a part that packtrace intersect --shard or stress --shard wrote");
    part.head = *head;
    part.end = bytes_of_whole(part.name(), file.get());
    return part;
}

/// All parts, sorted by index. Throws if one is missing or belongs to other work.
std::vector<HitPart> check_parts(const std::vector<std::string>& names)
{
    std::vector<HitPart> parts;
    std::string recipe;
    for (const std::string& name : names) {
        HitPart part = check_part(name);
        if (parts.empty()) {
            parts.resize(static_cast<std::size_t>(part.head.shard.count));
            recipe = part.head.recipe;
        }
        if (static_cast<std::size_t>(part.head.shard.count) != parts.size() ||
            part.head.recipe != recipe)
            throw FileError(part.name() +
                            ": is a part of other work than the parts before it; join parts of "
                            "one scene, the same options, rays and number of parts");
        HitPart& place = parts[static_cast<std::size_t>(part.head.shard.index)];
        if (!place.file.empty())
            throw FileError(part.name() + ": is part " + part.head.shard.text() + ", and so is " +
                            place.name() + "; give each part once");
        place = std::move(part);
    }
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].file.empty())
            throw FileError("part " + std::to_string(i) + "/" + std::to_string(parts.size()) +
                            " is missing; give all parts");
    return parts;
}

void join_hits(const std::vector<HitPart>& parts, Output& output)
{
    std::string header;
    for (const HitPart& part : parts) {
        const OpenFile file = open_file(part.file);
        const std::size_t head = read_line(part.name(), file.get()).size() + 1;
        const std::string own = read_line(part.name(), file.get()) + "\n";
        if (header.empty())
            output.write(header = own);
        read_bytes(part.name(), file.get(), part.end - head - own.size(),
                   [&](std::string_view rows) { output.write(rows); });
    }
}

void run_join(const JoinArguments& arguments)
{
    check_not_read(arguments.output, arguments.parts);
    const bool json = std::fgetc(open_file(arguments.parts.front()).get()) == '{';
    if (json) {
        const std::string joined = join_stress(arguments.parts);
        Output output(arguments.output);
        output.write(joined);
        return output.finish();
    }
    const std::vector<HitPart> parts = check_parts(arguments.parts);
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
        ->add_option(
            "PART", arguments->parts,
            "All parts, in any order: files of intersect --shard, or of stress --shard --json")
        ->required()
        ->check(validator([](const std::string& text) { return text != "-"; },
                          "a file; parts are read twice, which standard input can't be"))
        ->type_name("");
    command->add_option("-o,--output", arguments->output, "File to write (default standard output)")
        ->check(file_name())
        ->type_name("FILE");
    command->callback([arguments] { run_join(*arguments); });
}

}  // namespace packtrace::cli
