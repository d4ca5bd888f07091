#include "cli/options/shard.hpp"

#include <charconv>

namespace packtrace::cli {
namespace {

constexpr int most_shards = 1'000'000;

}  // namespace

std::optional<Shard> parse_shard(const std::string& text)
{
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto [slash, error] = std::from_chars(text.data(), end, shard.index);
    if (error != std::errc() || slash == end || *slash != '/')
        return std::nullopt;
    const auto [stop, second_error] = std::from_chars(slash + 1, end, shard.count);
    if (second_error != std::errc() || stop != end || shard.index < 0 ||
        shard.index >= shard.count || shard.count > most_shards)
        return std::nullopt;
    return shard;
}

CLI::Option* add_shard_option(CLI::App& command, std::optional<std::string>& shard,
                              const std::string& what)
{
    const auto check = [](const std::string& text) {
        return parse_shard(text)
                   ? std::string()
                   : "'" + text + "' is no shard such as 0/8, the first of eight, or 7/8, the last";
    };
    return command.add_option("--shard", shard, what)
        ->check(CLI::Validator(check, ""))
        ->type_name("I/N");
}

}  // namespace packtrace::cli
