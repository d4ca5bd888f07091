#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <stdlib.h>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace packtrace::test {

/// A folder for a test among the system's temporary files, removed with its contents.
class TempFolder {
public:
    TempFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "packtrace-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw std::runtime_error(name + ": can't make a temporary folder; set TMPDIR");
        path_ = name;
    }
    ~TempFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const
    {
        return path_;
    }
    [[nodiscard]] std::filesystem::path operator/(std::string_view name) const
    {
        return path_ / name;
    }
    /// The sorted names in the folder, including hidden ones.
    [[nodiscard]] std::vector<std::string> names() const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path()))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

private:
    std::filesystem::path path_;
};

inline void write_text(const std::filesystem::path& file, std::string_view text)
{
    std::ofstream(file, std::ios::binary) << text;
}

[[nodiscard]] inline std::string read_text(const std::filesystem::path& file)
{
    // Reads blocks: reading single characters of a picture with many bands takes seconds.
    std::ifstream input(file, std::ios::binary);
    std::string text;
    std::string block(std::size_t{1} << 16, '\0');
    while (input.read(block.data(), static_cast<std::streamsize>(block.size())) ||
           input.gcount() > 0)
        text.append(block, 0, static_cast<std::size_t>(input.gcount()));
    return text;
}

}  // namespace packtrace::test
