// Any text gives a scene or a one-line error. The text written of a scene reads back as the same
// scene.
#include "fuzzer.hpp"
#include <packtrace/read_scene.hpp>
#include <packtrace/write_scene.hpp>

#include <string>

PACKTRACE_FUZZER(scene_text)
{
    using namespace packtrace;
    Scene scene;
    try {
        scene = parse_scene(fuzz::text_of(bytes), "fuzz.scene");
    } catch (const SceneError& error) {
        const std::string what = error.what();
        fuzz::require(what.find('\n') == std::string::npos, "a message is one line");
        return;
    }
    const std::string text = scene_text(scene);
    const std::string again = scene_text(parse_scene(text, "again.scene"));
    fuzz::require(text == again, "a scene's text reads back as the same scene");
}
