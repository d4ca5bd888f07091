#include "image/png.hpp"

#include <libdeflate.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "catch.hpp"
#include "image/deflate_end.hpp"
#include "image/deflate_piece.hpp"

namespace packtrace {
namespace {

struct Chunk {
    std::string type;
    Bytes data;
};

std::uint32_t number_at(const Bytes& bytes, std::size_t at)
{
    return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
           std::uint32_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

// The chunks of a file, their checksums looked at.
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

// What a zlib stream holds, its checksum looked at by libdeflate; empty when it is damaged or
// has another length.
Bytes inflated(const Bytes& stream, std::size_t length)
{
    Bytes data(length);
    libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
    const libdeflate_result result = libdeflate_zlib_decompress(
        decompressor, stream.data(), stream.size(), data.data(), data.size(), nullptr);
    libdeflate_free_decompressor(decompressor);
    return result == LIBDEFLATE_SUCCESS ? data : Bytes{};
}

// Smooth above, noise in the middle, flat below, so that a PNG has every kind of deflate block.
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

Bytes bytes_of(std::size_t count, unsigned kinds)
{
    Bytes bytes(count);
    std::uint32_t state = 99;
    for (std::uint8_t& byte : bytes) {
        state = state * 1664525u + 1013904223u;
        byte = static_cast<std::uint8_t>((state >> 24) % kinds);
    }
    return bytes;
}

}  // namespace

TEST_CASE("a PNG's chunks hold the filtered rows in one zlib stream", "[png]")
{
    const Image<float> image = mixed_picture(700, 900);
    const Bytes file = encode_png(image, {.filter = PngFilter::none});
    const std::vector<Chunk> chunks = chunks_of(file);
    REQUIRE(chunks.size() > 5);
    CHECK(chunks.front().type == "IHDR");
    CHECK(chunks.back().type == "IEND");
    Bytes stream;
    for (std::size_t i = 1; i + 1 < chunks.size(); ++i) {
        CHECK(chunks[i].type == "IDAT");
        stream.insert(stream.end(), chunks[i].data.begin(), chunks[i].data.end());
    }
    CHECK((stream[0] * 256 + stream[1]) % 31 == 0);

    Bytes rows;
    for (int y = 0; y < image.height; ++y) {
        rows.push_back(0);
        for (int i = 0; i < 3 * image.width; ++i)
            rows.push_back(static_cast<std::uint8_t>(std::lround(image.pixel(0, y)[i] * 255.0f)));
    }
    CHECK((inflated(stream, rows.size()) == rows));
}

TEST_CASE("every filter and level gives the same picture", "[png]")
{
    const Image<float> image = mixed_picture(301, 700);
    for (const PngFilter filter : {PngFilter::none, PngFilter::sub, PngFilter::up})
        for (int level = 1; level <= 12; ++level) {
            INFO("filter " << static_cast<int>(filter) << " level " << level);
            const Image<float> back =
                decode_png(encode_png(image, {.filter = filter, .level = level}));
            CHECK((back.rgb == image.rgb));
        }
}

TEST_CASE("pictures of any shape survive a PNG", "[png]")
{
    for (const auto& [width, height] : std::vector<std::pair<int, int>>{
             {1, 1}, {1, 5000}, {100000, 2}, {3, 87381}, {341, 257}, {340, 256}}) {
        INFO(width << " x " << height);
        const Image<float> image = mixed_picture(width, height);
        const Image<float> back = decode_png(encode_png(image));
        CHECK(back.width == width);
        CHECK(back.height == height);
        CHECK((back.rgb == image.rgb));
    }
}

TEST_CASE("a PNG's bytes do not depend on the number of threads", "[png]")
{
    const Image<float> image = mixed_picture(640, 900);
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 7);
    const auto with = [&](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([&] { return encode_png(image); });
    };
    const Bytes one = with(1);
    CHECK((with(2) == one));
    CHECK((with(7) == one));
}

TEST_CASE("pieces of deflate join to one stream", "[png]")
{
    // 1 byte is a fixed block, noise a stored one, the others dynamic; level 12 makes many.
    std::vector<Bytes> parts{bytes_of(1, 256),     bytes_of(70000, 256), bytes_of(0, 1),
                             bytes_of(200000, 3),  bytes_of(5000, 1),    bytes_of(300, 20),
                             bytes_of(300000, 60), bytes_of(2, 256)};
    for (int level = 1; level <= 12; ++level) {
        DeflatePieces pieces(level);
        Bytes stream{0x78, 0x01};
        Bytes all;
        std::uint32_t adler = 1;
        for (const Bytes& part : parts) {
            pieces.append(part, stream);
            all.insert(all.end(), part.begin(), part.end());
            adler =
                join_adler32(adler, libdeflate_adler32(1, part.data(), part.size()), part.size());
        }
        const Bytes last = last_deflate_piece();
        stream.insert(stream.end(), last.begin(), last.end());
        CHECK(adler == libdeflate_adler32(1, all.data(), all.size()));
        for (const unsigned shift : {24u, 16u, 8u, 0u})
            stream.push_back(static_cast<std::uint8_t>(adler >> shift));
        INFO("level " << level);
        CHECK((inflated(stream, all.size()) == all));
    }
}

TEST_CASE("a damaged deflate stream is told, not followed", "[png]")
{
    const auto find = [](const Bytes& stream) { return find_deflate_end(stream); };
    CHECK_THROWS_AS(find({}), std::logic_error);
    CHECK_THROWS_AS(find({0x07}), std::logic_error);  // block type 3
    CHECK_THROWS_AS(find({0x01, 0x05, 0x00, 0xfa, 0xff, 0x61}), std::logic_error);
    CHECK_THROWS_AS(find({0x03}), std::logic_error);  // no end of block
    const DeflateEnd end = find({0x03, 0x00});
    CHECK(end.last_block == 0);
    CHECK(end.end == 10);
}

}  // namespace packtrace
