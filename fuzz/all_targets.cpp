#include "fuzz/targets.hpp"

namespace fascicle::fuzz {

const std::vector<Target>& targets() {
    static const std::vector<Target> rows = [] {
        std::vector<Target> all;
        for (const auto make :
             {mesh_targets, animation_targets, table_targets, scene_targets, opensim_targets, json_targets,
              project_targets, run_targets, codec_targets, option_targets, command_line_targets})
            for (Target& target : make())
                all.push_back(std::move(target));
        return all;
    }();
    return rows;
}

} // namespace fascicle::fuzz
