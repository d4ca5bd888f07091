#include <packtrace/read_scene.hpp>

#include "scene/check_text.hpp"
#include "scene/load_text.hpp"
#include "scene/scene_builder.hpp"
#include "scene/syntax_tree.hpp"

namespace packtrace {

Scene parse_scene(std::string_view text, const std::string& name, const TakeWarning& warn)
{
    const reader::Source source{name, text, warn};
    reader::check_text(source);
    return reader::build_scene(source, reader::parse_tree(source));
}

Scene read_scene(const std::filesystem::path& file, const TakeWarning& warn)
{
    return parse_scene(reader::load_text(file), file.string(), warn);
}

}  // namespace packtrace
