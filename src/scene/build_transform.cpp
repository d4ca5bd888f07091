#include "scene/scene_builder.hpp"

namespace packtrace {

const Keys& transform_keys()
{
    static const Keys keys{};
    return keys;
}

Mat4 build_transform(const Block&)
{
    return Mat4(1.0);
}

}  // namespace packtrace
