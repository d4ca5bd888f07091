#include "catch.hpp"
#include "onedim_systems.hpp"
#include <packtrace/onedim.hpp>

#include <random>

namespace packtrace::onedim {
namespace {

using test::ContainsSubstring;

SyntaxError error_of(const std::string& line)
{
    Systems systems;
    systems.push_back(test::all_surfaces());
    const auto error = read_system(line, systems);
    REQUIRE(error);
    CHECK(systems.size() == 1);
    CHECK(systems.surfaces.size() == 54);
    return *error;
}

void check_error(const std::string& line, std::size_t column, const std::string& message)
{
    INFO(line);
    const SyntaxError error = error_of(line);
    CHECK(error.column == column);
    CHECK(error.message == message);
}

std::string compact(const std::string& line)
{
    return to_text(test::systems_of({line})[0], Notation::compact);
}

}  // namespace

TEST_CASE("values are written in three ways", "[onedim_notation]")
{
    CHECK(to_text(Intensity::none, Notation::note) == "Inl ()");
    CHECK(to_text(Intensity::medium, Notation::note) == "Inr Inl ()");
    CHECK(to_text(Intensity::all, Notation::note) == "Inr Inr Inl ()");
    CHECK(to_text(Intensity::medium, Notation::compact) == "M");
    CHECK(to_text(Intensity::all, Notation::words) == "All");
}

TEST_CASE("the note's notation is read", "[onedim_notation]")
{
    CHECK(compact("Inr()") == "");
    CHECK(compact("Inl((Inl (), (Inl (), (Inr Inl (), Inr Inr Inl ()))), Inr())") == "T:NMA");
    CHECK(compact("Inl((Inr (), (Inr Inr Inl (), (Inl (), Inr Inl ()))), "
                  "Inl((Inl (), (Inl (), (Inl (), Inl ()))), Inr ()))") == "A:ANM T:NNN");
}

TEST_CASE("white space does not matter, and an argument may stand in parentheses",
          "[onedim_notation]")
{
    CHECK(compact("Inl((Inl(),(InrInl(),(Inl(),InrInrInl()))),Inr())") == "T:MNA");
    CHECK(
        compact("  Inl\t( ( Inl ( ) , ( Inr  Inl() , ( Inl(),Inr Inr Inl( ) ) ) ) , Inr( ) ) \r") ==
        "T:MNA");
    CHECK(compact("Inl(((Inl ()), (Inr (Inl ()), (Inl (), Inr (Inr (Inl ()))))), Inr())") ==
          "T:MNA");
}

TEST_CASE("the compact notation is read with and without optional characters", "[onedim_notation]")
{
    CHECK(compact("") == "");
    CHECK(compact(" \t\r") == "");
    CHECK(compact("T:MAN A:NNM") == "T:MAN A:NNM");
    CHECK(compact(" TMAN\tANNM ") == "T:MAN A:NNM");
    CHECK(compact("TMANANNM") == "T:MAN A:NNM");
}

TEST_CASE("written systems read back as the same systems", "[onedim_notation]")
{
    std::mt19937 random(13);
    for (std::size_t length = 0; length < 40; ++length) {
        const std::vector<Surface> system = test::random_system(random, length, 1);
        Systems systems;
        REQUIRE(!read_system(to_text(system, Notation::note), systems));
        REQUIRE(!read_system(to_text(system, Notation::compact), systems));
        CHECK((std::vector(systems[0].begin(), systems[0].end()) == system));
        CHECK((std::vector(systems[1].begin(), systems[1].end()) == system));
    }
}

TEST_CASE("a list may be nested a million deep", "[onedim_notation][bulk]")
{
    const std::vector<Surface> system(1'000'000, test::all_surfaces()[20]);
    Systems systems;
    REQUIRE(!read_system(to_text(system, Notation::note), systems));
    CHECK(systems.surfaces.size() == system.size());
}

TEST_CASE("errors in the compact notation name the column and a remedy", "[onedim_notation]")
{
    check_error("T:MAX", 5, "expected N, M or A for the emission, found 'X'");
    check_error("T:MAN A:N", 10,
                "expected N, M or A for the translucence, found the end of the line");
    check_error("B:MAN", 1, "expected a surface's direction, T or A, found 'B'");
    check_error("T:MAN\x01", 6, "expected a surface's direction, T or A, found byte 0x01");
    check_error("T:MAN, A:NNN", 6, "expected a surface's direction, T or A, found ','");
    check_error(std::string("T:MAN\0", 6), 6, "expected the end of the line, found byte 0x00");
}

TEST_CASE("errors in the note's notation name the column and a remedy", "[onedim_notation]")
{
    check_error("Inx", 1,
                "expected Inl of one more surface or Inr () of the list's end, found 'I'");
    check_error("Inr", 4, "expected '()', found the end of the line");
    check_error("Inr() x", 7, "expected the end of the line, found 'x'");
    check_error("Inl((Inl (), (Inl (), (Inl (), Inl ()))), Inr()", 48,
                "expected ')', 1 more to close the list, found the end of the line");
    check_error("Inl((Inl (), (Inr Inr Inr Inl (), (Inl (), Inl ()))), Inr())", 23,
                "expected Inl after two Inr of the reflectance, found 'I'");
    check_error("Inl((Inl (), (Inr (), (Inl (), Inl ()))), Inr())", 20,
                "expected Inl or Inr of the reflectance, found ')'");
    check_error("Inl((Inl (), (Inl (), (Inl () Inl ()))), Inr())", 31,
                "expected ',' after the translucence, found 'I'");
    check_error("Inl((Inl (), (Inl (), (Inl (), Inl ()))) Inr())", 42,
                "expected ',' between a surface and the rest of the list, found 'I'");
}

TEST_CASE("no text of the notations' letters makes the reader fail in another way",
          "[onedim_notation]")
{
    std::mt19937 random(14);
    const std::vector<std::string> tokens{"Inl", "Inr", "(", ")", ",", " ", "I", "T", "N", "T:AMN"};
    int understood = 0;
    for (int k = 0; k < 20'000; ++k) {
        std::string line;
        for (std::size_t left = random() % 12; left > 0; --left)
            line += tokens[random() % tokens.size()];
        Systems systems;
        const auto error = read_system(line, systems);
        if (error) {
            REQUIRE_THAT(error->message, ContainsSubstring("expected "));
            REQUIRE((error->column >= 1 && error->column <= line.size() + 1));
        } else {
            REQUIRE(systems.size() == 1);
            ++understood;
        }
    }
    CHECK(understood > 0);
}

}  // namespace packtrace::onedim
