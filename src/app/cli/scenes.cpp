// fascicle scenes: the embedded scenes with a line each.

#include "app/cli/command.hpp"
#include "fascicle/scene/embedded_scenes.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

namespace fascicle::app {

std::function<int()> add_scenes(CLI::App&) {
    return [] {
        std::size_t width = 0;
        for (const EmbeddedSceneInfo& scene : embedded_scenes())
            width = std::max(width, scene.name.size());
        for (const EmbeddedSceneInfo& scene : embedded_scenes())
            std::cout << scene.name << std::string(width - scene.name.size() + 2, ' ') << scene.line << '\n';
        return 0;
    };
}

} // namespace fascicle::app
