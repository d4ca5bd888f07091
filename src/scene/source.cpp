#include "scene/source.hpp"

#include <packtrace/read_scene.hpp>

#include "scene/quote.hpp"

namespace packtrace::reader {

void fail(const Source& source, Position at, const std::string& message)
{
    throw SceneError(escape(source.name) + ':' + std::to_string(at.line) + ':' +
                     std::to_string(at.column) + ": " + message);
}

}  // namespace packtrace::reader
