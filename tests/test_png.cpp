#include "catch.hpp"
#include "image/formats.hpp"
#include "refusal.hpp"

#include <libdeflate.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace packtrace {
namespace {

using test::refusal;

struct Chunk {
    std::string type;
    Bytes data;
};

std::uint32_t number_at(const Bytes& bytes, std::size_t at)
{
    return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
           std::uint32_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

// The chunks of a file; checks their checksums.
std::vector<Chunk> chunks_of(const Bytes& file)
{
    std::vector<Chunk> chunks;
    for (std::size_t at = 8; at < file.size();) {
        const std::size_t length = number_at(file, at);
        REQUIRE(at + 12 + length <= file.size());
        CHECK(number_at(file, at + 8 + length) ==
              libdeflate_crc32(0, file.data() + at + 4, length + 4));
        const auto data = file.begin() + static_cast<std::ptrdiff_t>(at) + 8;
        chunks.push_back(
            {std::string(data - 4, data), Bytes(data, data + static_cast<std::ptrdiff_t>(length))});
        at += 12 + length;
    }
    return chunks;
}

// The contents of a zlib stream, decompressed and checked by libdeflate; empty if the stream is
// damaged or has another length.
Bytes inflated(const Bytes& stream, std::size_t length)
{
    Bytes data(length);
    libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
    const libdeflate_result result = libdeflate_zlib_decompress(
        decompressor, stream.data(), stream.size(), data.data(), data.size(), nullptr);
    libdeflate_free_decompressor(decompressor);
    return result == LIBDEFLATE_SUCCESS ? data : Bytes{};
}

// Smooth at the top, noise in the middle, flat at the bottom, so that a PNG has every kind of
// deflate block.
Image<float> mixed_picture(int width, int height)
{
    Image<float> image(width, height);
    std::uint32_t state = 12345;
    for (int y = 0; y < height; ++y)
        for (int i = 0; i < 3 * width; ++i) {
            state = state * 1664525u + 1013904223u;
            const int value = 3 * y < height       ? (y + i / 7) % 256
                              : 3 * y < 2 * height ? static_cast<int>(state >> 24)
                                                   : 17;
            image.pixel(0, y)[i] = static_cast<float>(value) / 255.0f;
        }
    return image;
}

Bytes bytes_of(std::string_view digits)
{
    Bytes bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes.push_back(
            static_cast<std::uint8_t>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16)));
    return bytes;
}

void add_number(Bytes& bytes, std::size_t number)
{
    for (const int shift : {24, 16, 8, 0})
        bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

// Appends a chunk with its length and its checksum.
void add_chunk(Bytes& file, std::string_view type, const Bytes& data)
{
    add_number(file, data.size());
    const std::size_t start = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), data.begin(), data.end());
    add_number(file, libdeflate_crc32(0, file.data() + start, file.size() - start));
}

}  // namespace

TEST_CASE("a PNG's chunks hold the picture's rows in one zlib stream", "[png]")
{
    const Image<float> image = mixed_picture(700, 900);
    const std::vector<Chunk> chunks = chunks_of(encode_png(image));
    REQUIRE(chunks.size() == 3);
    CHECK(chunks[0].type == "IHDR");
    CHECK(chunks[1].type == "IDAT");
    CHECK(chunks[2].type == "IEND");

    // Each row starts with its filter, 2, and stores differences from the row above.
    Bytes rows;
    for (int y = 0; y < image.height; ++y) {
        rows.push_back(2);
        for (int i = 0; i < 3 * image.width; ++i) {
            const auto byte = [&](int row) { return std::lround(image.pixel(0, row)[i] * 255.0f); };
            rows.push_back(static_cast<std::uint8_t>(byte(y) - (y > 0 ? byte(y - 1) : 0)));
        }
    }
    CHECK((inflated(chunks[1].data, rows.size()) == rows));
}

TEST_CASE("pictures of any shape survive a PNG, whole or row by row", "[png]")
{
    for (const auto& [width, height] : std::vector<std::pair<int, int>>{
             {1, 1}, {1, 5000}, {100000, 2}, {3, 87381}, {341, 257}, {340, 256}}) {
        INFO(width << " x " << height);
        const Image<float> image = mixed_picture(width, height);
        for (const std::size_t largest_whole : {PngSettings{}.largest_whole, std::size_t{0}}) {
            const Image<float> back =
                decode_png(encode_png(image, {.largest_whole = largest_whole}));
            CHECK(back.width == width);
            CHECK(back.height == height);
            CHECK((back.rgb == image.rgb));
        }
    }
}

TEST_CASE("a PNG holds its recipe, whole or row by row", "[png]")
{
    const Image<float> image = mixed_picture(9, 7);
    for (const std::size_t largest_whole : {PngSettings{}.largest_whole, std::size_t{0}}) {
        const Bytes file =
            encode_png(image, {.recipe = "four eggs", .largest_whole = largest_whole});
        const std::vector<Chunk> chunks = chunks_of(file);
        CHECK(chunks[1].type == "tEXt");
        CHECK(png_recipe(file) == "four eggs");
        CHECK((decode_png(file).rgb == image.rgb));
        CHECK(png_recipe(encode_png(image, {.largest_whole = largest_whole})).empty());
    }
}

TEST_CASE("PNGs of other programs can be read", "[png]")
{
    // 3 x 2 grey pixels, in encodings that packtrace does not write.
    struct Sample {
        const char* what;
        const char* file;
        std::vector<double> grey;  ///< values of 255
    };
    const std::vector<Sample> samples{
        {"grey of 1 bit",
         "89504e470d0a1a0a0000000d4948445200000003000000020100000000b50f5bb70000000c494441"
         "5478da6358c0e00000022400e14d16e85e0000000049454e44ae426082",
         {255, 0, 255, 0, 255, 0}},
        {"grey of 16 bits",
         "89504e470d0a1a0a0000000d4948445200000003000000021000000000e88fe58500000016494441"
         "5478da6360606060fcff9f8191a1818191110013100283b17987ce0000000049454e44ae426082",
         {0, 0.0038910505836575876, 255, 0.99610894941634243, 127.50194552529183, 1}},
        {"grey with alpha",
         "89504e470d0a1a0a0000000d4948445200000003000000020804000000377dae9100000016494441"
         "5478da6360f82fd0a0c0c060f0df81318009001a920372163d336d0000000049454e44ae426082",
         {0, 16, 32, 48, 64, 80}},
        {"a palette with alpha",
         "89504e470d0a1a0a0000000d49484452000000030000000204030000006f5a7b2900000009504c54"
         "450707070909090b0b0b0704200f0000000274524e5300809b2b4e180000000e4944415478da6360"
         "54605064000000cd00437a58dbad0000000049454e44ae426082",
         {7, 9, 11, 11, 9, 7}},
        {"an interlaced one",
         "89504e470d0a1a0a0000000d4948445200000003000000020800000001cf18095000000012494441"
         "5478da63e06290631061d030b2010002b200d3e5a3a5ab0000000049454e44ae426082",
         {10, 20, 30, 40, 50, 60}},
    };
    for (const Sample& sample : samples) {
        INFO(sample.what);
        const Image<float> image = decode_png(bytes_of(sample.file));
        REQUIRE(image.width == 3);
        REQUIRE(image.height == 2);
        for (std::size_t i = 0; i < image.rgb.size(); ++i)
            CHECK(image.rgb[i] == Approx(sample.grey[i / 3] / 255.0).epsilon(1e-6));
    }
}

TEST_CASE("a PNG with a colour that is not in its palette is refused", "[png]")
{
    // 4 x 1 pixels with indices 0, 1, 2 and 3 of two bits, and a palette of `colors` greys. The
    // rows are stored without compression.
    const auto with_palette = [](std::uint8_t colors) {
        Bytes palette;
        for (std::uint8_t i = 0; i < colors; ++i)
            palette.insert(palette.end(), 3, static_cast<std::uint8_t>(10 * (i + 1)));
        Bytes file = bytes_of("89504e470d0a1a0a");
        add_chunk(file, "IHDR", bytes_of("00000004000000010203000000"));
        add_chunk(file, "PLTE", palette);
        add_chunk(file, "IDAT", bytes_of("7801010200fdff001b001d001c"));
        add_chunk(file, "IEND", {});
        return file;
    };
    const Image<float> image = decode_png(with_palette(4));
    for (int x = 0; x < 4; ++x)
        CHECK(image.pixel(x, 0)[1] == Approx(10.0 * (x + 1) / 255.0).epsilon(1e-6));
    for (const std::uint8_t colors : {std::uint8_t{1}, std::uint8_t{3}})
        CHECK(refusal<ImageError>([&] { return decode_png(with_palette(colors)); }) ==
              "damaged PNG: the colour of a pixel is not in the palette");
}

TEST_CASE("a PNG that is damaged or too short for its pixels is refused", "[png]")
{
    Bytes file = encode_png(mixed_picture(300, 200));
    const auto error_of = [](const Bytes& bytes) {
        return refusal<ImageError>([&] { return decode_png(bytes); });
    };
    CHECK(error_of(file) == "accepted");
    for (const std::size_t length : {file.size() - 1, file.size() / 2, std::size_t{40}}) {
        INFO("the first " << length << " bytes");
        CHECK(error_of(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length)))
                  .starts_with("damaged PNG: "));
    }
    Bytes other = file;
    other[file.size() / 2] ^= 1;
    CHECK(error_of(other).starts_with("damaged PNG: "));
    // A header of a million by a million pixels with a correct checksum.
    Bytes huge = file;
    for (const std::size_t at : {std::size_t{16}, std::size_t{20}})
        for (std::size_t i = 0; i < 4; ++i)
            huge[at + i] = static_cast<std::uint8_t>(1000000u >> (24 - 8 * i));
    const std::uint32_t sum = libdeflate_crc32(0, huge.data() + 12, 17);
    for (std::size_t i = 0; i < 4; ++i)
        huge[29 + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
    CHECK(error_of(huge) == "damaged PNG: the file is too short for its size in pixels");
}

}  // namespace packtrace
