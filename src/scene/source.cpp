#include "scene/source.hpp"

#include <packtrace/read_scene.hpp>

#include "scene/quote.hpp"

namespace packtrace::reader {
namespace {

std::string placed(const Source& source, Position at, const std::string& message)
{
    return escape(source.name) + ':' + std::to_string(at.line) + ':' + std::to_string(at.column) +
           ": " + message;
}

}  // namespace

void fail(const Source& source, Position at, const std::string& message)
{
    throw SceneError(placed(source, at, message));
}

void warn(const Source& source, Position at, const std::string& message)
{
    if (source.take_warning)
        source.take_warning(placed(source, at, message));
}

}  // namespace packtrace::reader
