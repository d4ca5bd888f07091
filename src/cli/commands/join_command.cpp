#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/options/shard.hpp"
#include "cli/output/distinct_files.hpp"
#include "cli/output/text_output.hpp"
#include "cli/study/study.hpp"
#include "scene/quote.hpp"

namespace packtrace::cli {
namespace {

struct JoinArguments {
    std::vector<std::string> parts;
    std::string output;
};

struct Closer {
    void operator()(std::FILE* file) const
    {
        std::fclose(file);
    }
};

/// An open part of a file of hits, after its first line.
struct HitPart {
    std::string name;
    PartHead head;
    std::unique_ptr<std::FILE, Closer> file;
};

std::string read_line(std::FILE* file)
{
    std::string line;
    for (int c; (c = std::fgetc(file)) != EOF && c != '\n';)
        line += static_cast<char>(c);
    return line;
}

HitPart open_part(const std::string& name)
{
    HitPart part{language::escape(name), {}, {}};
    part.file.reset(std::fopen(name.c_str(), "rb"));
    if (!part.file)
        throw FileError(part.name, "can't read", errno);
    const std::optional<PartHead> head = PartHead::parse(read_line(part.file.get()));
    if (!head)
        throw FileError(part.name +
                        ": is not a part that packtrace intersect --shard or stress --shard wrote");
    part.head = *head;
    return part;
}

int first_byte(const std::string& name)
{
    const std::unique_ptr<std::FILE, Closer> file(std::fopen(name.c_str(), "rb"));
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

void copy_rest(const HitPart& part, TextOutput& output)
{
    std::vector<char> block(std::size_t{1} << 20);
    for (std::size_t got; (got = std::fread(block.data(), 1, block.size(), part.file.get())) > 0;)
        output.write({block.data(), got});
    if (std::ferror(part.file.get()))
        throw FileError(part.name, "can't read", errno);
}

void join_hits(const std::vector<HitPart>& parts, TextOutput& output)
{
    std::string header;
    for (const HitPart& part : parts) {
        const std::string own = read_line(part.file.get());
        if (header.empty())
            output.write((header = own) + "\n");
        copy_rest(part, output);
    }
}

void run_join(const JoinArguments& arguments)
{
    check_not_read(arguments.output, arguments.parts);
    const bool json = first_byte(arguments.parts.front()) == '{';
    if (json) {
        const std::string joined = join_stress(arguments.parts);
        TextOutput output(arguments.output);
        output.write(joined);
        return output.finish();
    }
    const std::vector<HitPart> parts = open_parts(arguments.parts);
    TextOutput output(arguments.output);
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
        ->type_name("FILE");
    command->callback([arguments] { run_join(*arguments); });
}

}  // namespace packtrace::cli
