#include "fascicle/scene/embedded_scenes.hpp"

#include "embedded.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/suggest.hpp"

namespace fascicle {

namespace {

struct Row {
    EmbeddedSceneInfo info;
    Scene (*make)(int threads);
};

const std::vector<Row>& rows() {
    static const std::vector<Row> table{
        {{"hip", "right hip with gluteus maximus and iliacus, flexed to 1 rad about the femoral head"},
         embedded::make_hip},
        {{"squish-box", "box of 5,292 triangles squeezed between two plates to 10 % of the gap and released"},
         embedded::make_squish_box},
        {{"cylinder", "strap over a cylinder on a hinge: length and moment arm known in closed form"},
         embedded::make_cylinder},
        {{"two-heads",
          "muscle with two origins that grow together, with superficial fibres, stretched by a lever"},
         embedded::make_two_heads}};
    return table;
}

} // namespace

const std::vector<EmbeddedSceneInfo>& embedded_scenes() {
    static const std::vector<EmbeddedSceneInfo> infos = [] {
        std::vector<EmbeddedSceneInfo> list;
        for (const Row& row : rows())
            list.push_back(row.info);
        return list;
    }();
    return infos;
}

Scene make_embedded_scene(std::string_view name, int threads) {
    std::string known;
    std::vector<std::string> names;
    for (const Row& row : rows()) {
        if (row.info.name == name) {
            Scene scene = row.make(threads);
            scene.name = row.info.name;
            scene.embedded_name = row.info.name;
            return scene;
        }
        known += (known.empty() ? "" : ", ") + row.info.name;
        names.push_back(row.info.name);
    }
    throw_error("scene '" + std::string(name) + "'",
                "there is no embedded scene of that name" + did_you_mean(name, names), "one of: " + known,
                ErrorKind::usage);
}

} // namespace fascicle
