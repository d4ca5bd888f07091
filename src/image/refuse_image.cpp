#include <packtrace/image.hpp>

#include <stdexcept>
#include <string>

namespace packtrace::detail {

void refuse_sides(int width, int height)
{
    throw std::invalid_argument("image: " + std::to_string(width) + " x " + std::to_string(height) +
                                " pixels; sides are 0 or above");
}

void refuse_values(std::size_t values, int width, int height)
{
    throw std::invalid_argument("image: " + std::to_string(values) + " values in `rgb` for " +
                                std::to_string(width) + " x " + std::to_string(height) +
                                " pixels; give three a pixel");
}

}  // namespace packtrace::detail
