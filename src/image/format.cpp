#include "image/format.hpp"

#include <algorithm>
#include <string>

namespace packtrace {

ImageFormat image_format(const std::filesystem::path& file)
{
    const std::string extension = file.extension().string();
    std::string lower = extension;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    if (lower == ".png")
        return ImageFormat::png;
    if (lower == ".pfm")
        return ImageFormat::pfm;
    if (lower == ".hdr")
        return ImageFormat::hdr;
    const std::string what = extension.empty() ? "no extension tells the picture format"
                                               : "unknown picture format '" + extension + "'";
    throw ImageError(file.string() + ": " + what + "; use .png, .pfm or .hdr");
}

}  // namespace packtrace
