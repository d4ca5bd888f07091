#include "catch.hpp"
#include "memory_limit.hpp"
#include "onedim_systems.hpp"
#include "run_program.hpp"
#include "temp_folder.hpp"
#include <packtrace/onedim.hpp>

#include <algorithm>
#include <fstream>
#include <random>

namespace packtrace {
namespace {

using test::ContainsSubstring;
using test::memory_limit;
using test::ProgramResult;
using test::run_packtrace;
using test::TempFolder;
using test::write_text;

ProgramResult answer(const std::string& text, std::vector<std::string> options = {})
{
    const TempFolder folder;
    write_text(folder / "systems", text);
    options.insert(options.begin(), {"onedim", "-"});
    return run_packtrace(options, "", (folder / "systems").string());
}

void write_systems(const std::filesystem::path& file, int count)
{
    std::mt19937 random(15);
    std::ofstream out(file);
    for (int k = 0; k < count; ++k) {
        const std::size_t length = random() % 17;
        out << to_text(test::random_system(random, length, 3), onedim::Notation::compact) << '\n';
    }
}

}  // namespace

TEST_CASE("every line is answered, in either notation, including an empty line", "[onedim_cli]")
{
    const ProgramResult result = answer(
        "T:NAM T:NNM\n"
        "\n"
        "# a remark\n"
        "Inl((Inl (), (Inl (), (Inl (), Inr Inl ()))), Inr ())");
    CHECK(result.exit_code == 0);
    CHECK(result.out == "All\nNone\nMedium\n");
    CHECK(result.err.empty());
}

TEST_CASE("answers are written in words, letters or the note's notation", "[onedim_cli]")
{
    const std::string lines = "TNNN\nTNNM\nTNNA\n";
    CHECK(answer(lines, {"--output", "words"}).out == "None\nMedium\nAll\n");
    CHECK(answer(lines, {"--output", "compact"}).out == "N\nM\nA\n");
    CHECK(answer(lines, {"--output", "note"}).out == "Inl ()\nInr Inl ()\nInr Inr Inl ()\n");
}

TEST_CASE("every solver and instruction set answers the table of small systems", "[onedim_cli]")
{
    std::ifstream table(PACKTRACE_SOURCE_DIR "/tests/data/onedim/exhaustive_n0to2.tsv");
    std::string lines, expected;
    for (std::string line; std::getline(table, line);)
        if (!line.starts_with('#')) {
            const std::size_t tab = line.find('\t');
            lines += line.substr(0, tab) + '\n';
            expected += line.substr(tab + 1, 1) + '\n';
        }
    const TempFolder folder;
    write_text(folder / "systems", lines);
    const std::string file = (folder / "systems").string();
    for (const char* solver : {"scalar", "linear", "bitsliced"})
        CHECK((run_packtrace({"onedim", file, "--output", "compact", "--solver", solver}).out ==
               expected));
    for (const IsaInfo& isa : list_isas())
        if (isa.supported)
            CHECK((run_packtrace({"onedim", file, "--output", "compact", "--isa", isa.name}).out ==
                   expected));
}

TEST_CASE("a malformed line ends the run and is named with its position", "[onedim_cli]")
{
    const ProgramResult result = answer("TNNA\n# remark\n\n T:NXN\nTNNA\n");
    CHECK(result.exit_code == 1);
    CHECK(result.out == "All\nNone\n");
    CHECK(result.err == "<stdin>:4:5: expected N, M or A for the translucence, found 'X'\n");
}

TEST_CASE("with --keep-going the other lines are answered", "[onedim_cli]")
{
    const ProgramResult result = answer("oops\nTNNA\nInl(\nTNNM\nTNN", {"--keep-going"});
    CHECK(result.exit_code == 1);
    CHECK(result.out == "?\nAll\n?\nMedium\n?\n");
    CHECK_THAT(result.err, ContainsSubstring("<stdin>:1:1: expected "));
    CHECK_THAT(result.err, ContainsSubstring("<stdin>:3:5: expected '(' of a surface, found the "
                                             "end of the line"));
    CHECK_THAT(result.err, ContainsSubstring("<stdin>:5:4: expected "));
    CHECK(answer("TNNA\n", {"--keep-going"}).exit_code == 0);
}

TEST_CASE("files that can't be read are an error", "[onedim_cli]")
{
    const TempFolder folder;
    const ProgramResult missing = run_packtrace({"onedim", (folder / "none").string()});
    CHECK(missing.exit_code == 1);
    CHECK_THAT(missing.err, ContainsSubstring("none: can't read: No such file"));
    const ProgramResult directory = run_packtrace({"onedim", (folder / "").string()});
    CHECK(directory.exit_code == 1);
    CHECK_THAT(directory.err, ContainsSubstring("can't read: Is a directory"));
}

TEST_CASE("wrong use exits 2 with one line", "[onedim_cli]")
{
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"onedim"},
             {"onedim", "-", "--solver", "magic"},
             {"onedim", "-", "--output", "braille"},
             {"onedim", "-", "--isa", "mmx"},
             {"onedim", "-", "--isa", "sse42", "--width", "16"},
             {"onedim", "-", "--solver", "linear", "--isa", "avx2"}}) {
        const ProgramResult result = run_packtrace(arguments);
        CHECK(result.exit_code == 2);
        CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    }
    CHECK(run_packtrace({"onedim", "-"}, "PACKTRACE_ISA=mmx").exit_code == 2);
}

TEST_CASE("a list of a hundred thousand surfaces does not overflow the stack", "[onedim_cli]")
{
    const std::vector<onedim::Surface> system(100'000, test::all_surfaces().at(9));
    CHECK(answer(to_text(system, onedim::Notation::note)).out == "None\n");
}

TEST_CASE("a million systems are answered in less memory than they fill", "[onedim_cli][slow]")
{
    const TempFolder folder;
    const std::filesystem::path file = folder / "systems";
    write_systems(file, 1'000'000);
    REQUIRE(std::filesystem::file_size(file) > 45'000'000);
    const ProgramResult result = run_packtrace({"onedim", file.string()}, memory_limit(40'000));
    CHECK(result.exit_code == 0);
    CHECK(std::count(result.out.begin(), result.out.end(), '\n') == 1'000'000);
}

}  // namespace packtrace
