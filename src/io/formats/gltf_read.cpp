#include "io/formats/gltf_read.hpp"

#include "fascicle/base/error.hpp"
#include "io/formats/gltf_motion.hpp"
#include "io/formats/mesh_bodies.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace fascicle::io {

namespace {

/// Section 5.24.4 of the specification.
enum Mode { points_mode, lines_mode, line_loop, line_strip, triangles_mode, triangle_strip, triangle_fan };

/// Primitives of one mesh that share positions and targets.
struct Shape {
    std::string name;
    GltfDocument::Floats base;
    std::vector<GltfDocument::Floats> targets;
    std::vector<double> weights; ///< at rest
    std::vector<Tri> triangles;
    std::vector<std::vector<int>> lines;
};
/// Shapes of one mesh by their accessors: a mesh may have very many primitives.
using KnownShapes = std::map<std::vector<std::int64_t>, std::size_t>;

class GlbReader {
public:
    GlbReader(std::string_view bytes, const std::string& file)
        : document_(bytes, file), motion_(std::make_shared<GltfMotion>(document_)) {
        most_points_ = std::max<std::size_t>(bytes.size(), 1000000);
    }
    Animation read();

private:
    const std::vector<Shape>& shapes_of(std::int64_t mesh);
    void read_primitive(const Json& primitive, const std::string& user, std::vector<Shape>& shapes,
                        KnownShapes& known);
    void add_faces(Shape& shape, const std::vector<std::uint32_t>& indices, std::int64_t mode) const;
    void add_node(int node, Animation& animation);
    void name_frames(Animation& animation) const;

    GltfDocument document_;
    std::shared_ptr<GltfMotion> motion_;
    std::map<std::int64_t, std::vector<Shape>> meshes_;
    std::size_t most_points_ = 0, points_ = 0;
    std::size_t passed_over_ = 0;
};

std::string text_of(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void GlbReader::add_faces(Shape& shape, const std::vector<std::uint32_t>& indices, std::int64_t mode) const {
    const auto at = [&](std::size_t i) { return static_cast<int>(indices[i]); };
    const std::size_t n = indices.size();
    const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
        shape.triangles.push_back({at(a), at(b), at(c)});
    };
    if (mode == triangles_mode)
        for (std::size_t i = 0; i + 3 <= n; i += 3)
            triangle(i, i + 1, i + 2);
    else if (mode == triangle_strip)
        for (std::size_t i = 0; i + 3 <= n; ++i)
            triangle(i, i + 1 + i % 2, i + 2 - i % 2);
    else if (mode == triangle_fan)
        for (std::size_t i = 1; i + 2 <= n; ++i)
            triangle(i, i + 1, 0);
    else if (mode == lines_mode) {
        // Pieces that follow each other are one line.
        for (std::size_t i = 0; i + 2 <= n; i += 2) {
            if (i == 0 || shape.lines.empty() || shape.lines.back().back() != at(i))
                shape.lines.push_back({at(i)});
            shape.lines.back().push_back(at(i + 1));
        }
    } else if (n > 1) { // one point is no line
        std::vector<int> line(indices.begin(), indices.end());
        if (mode == line_loop)
            line.push_back(line.front());
        shape.lines.push_back(std::move(line));
    }
}

void GlbReader::read_primitive(const Json& primitive, const std::string& user, std::vector<Shape>& shapes,
                               KnownShapes& known) {
    const std::int64_t mode = document_.integer(primitive, "mode", triangles_mode);
    const auto attributes = primitive.find("attributes");
    if (mode <= points_mode || mode > triangle_fan || attributes == primitive.end() ||
        !attributes->is_object() || !attributes->contains("POSITION")) {
        ++passed_over_;
        return;
    }
    std::vector<std::int64_t> accessors{document_.integer(*attributes, "POSITION", -1)};
    if (const auto targets = primitive.find("targets"); targets != primitive.end() && targets->is_array())
        for (const Json& target : *targets)
            accessors.push_back(target.is_object() ? document_.integer(target, "POSITION", -1) : -1);
    auto found = known.find(accessors);
    if (found == known.end()) {
        Shape made;
        made.base = document_.floats(accessors[0], 3, user);
        for (std::size_t i = 1; i < accessors.size(); ++i) {
            made.targets.push_back(accessors[i] < 0 ? nullptr : document_.floats(accessors[i], 3, user));
            if (made.targets.back() != nullptr && made.targets.back()->size() != made.base->size())
                document_.fail(user + " has a morph target with another number of points");
        }
        found = known.emplace(accessors, shapes.size()).first;
        shapes.push_back(std::move(made));
    }
    Shape& shape = shapes[found->second];
    const std::size_t count = shape.base->size() / 3;
    if (primitive.contains("indices")) {
        add_faces(shape, document_.indices(document_.integer(primitive, "indices", -1), count, user), mode);
    } else {
        std::vector<std::uint32_t> all(count);
        for (std::size_t i = 0; i < count; ++i)
            all[i] = static_cast<std::uint32_t>(i);
        add_faces(shape, all, mode);
    }
}

const std::vector<Shape>& GlbReader::shapes_of(std::int64_t mesh) {
    if (const auto found = meshes_.find(mesh); found != meshes_.end())
        return found->second;
    const std::string user = "mesh " + std::to_string(mesh);
    const Json& json = document_.entry("meshes", mesh, "a node");
    std::vector<Shape> shapes;
    KnownShapes known;
    if (const auto primitives = json.find("primitives"); primitives != json.end() && primitives->is_array())
        for (const Json& primitive : *primitives)
            if (primitive.is_object())
                read_primitive(primitive, user, shapes, known);
    const auto weights = json.find("weights");
    for (Shape& shape : shapes) {
        shape.name = text_of(json, "name");
        shape.weights.assign(shape.targets.size(), 0.0);
        if (weights != json.end() && weights->is_array())
            for (std::size_t i = 0; i < std::min(weights->size(), shape.weights.size()); ++i)
                if (const Json& w = (*weights)[i]; w.is_number() && std::isfinite(w.get<double>()))
                    shape.weights[i] = w.get<double>();
    }
    return meshes_[mesh] = std::move(shapes);
}

void GlbReader::add_node(int node, Animation& animation) {
    const Json& json = document_.entry("nodes", node, "the scene");
    if (!json.contains("mesh"))
        return;
    for (const Shape& shape : shapes_of(document_.integer(json, "mesh", -1))) {
        points_ += shape.base->size() / 3 + shape.triangles.size() + shape.lines.size();
        if (points_ > most_points_)
            document_.fail("its meshes are used again and again, for more points than the file can hold",
                           "at most " + std::to_string(most_points_) + " points and triangles");
        AnimatedBody body;
        body.name = text_of(json, "name").empty() ? shape.name : text_of(json, "name");
        body.kind = shape.triangles.empty() ? BodyKind::fibres
                    : shape.targets.empty() ? BodyKind::bone
                                            : BodyKind::muscle;
        body.triangles = shape.triangles;
        body.lines = shape.lines;
        const auto at = [motion = motion_, node, base = shape.base, targets = shape.targets,
                         rest = shape.weights, file = document_.file()](std::size_t k, Points& points) {
            const double time = motion->times()[k];
            std::vector<double> weights = rest;
            motion->weigh(node, time, weights);
            points.resize(base->size() / 3);
            for (std::size_t i = 0; i < points.size(); ++i)
                points[i] = Vec3((*base)[3 * i], (*base)[3 * i + 1], (*base)[3 * i + 2]);
            for (std::size_t t = 0; t < targets.size(); ++t)
                if (weights[t] != 0 && targets[t] != nullptr)
                    for (std::size_t i = 0; i < points.size(); ++i)
                        points[i] += weights[t] * Vec3((*targets[t])[3 * i], (*targets[t])[3 * i + 1],
                                                       (*targets[t])[3 * i + 2]);
            const Eigen::Affine3d place = motion->place(node, time);
            if (!(place.matrix().cwiseAbs().maxCoeff() < 1e100))
                throw_error(file, "node " + std::to_string(node) + " is placed out of all range",
                            "finite places");
            if (!place.matrix().isIdentity(0))
                for (Vec3& p : points)
                    p = place * p;
            want_finite(points, file);
        };
        at(0, body.rest);
        body.points = at;
        animation.bodies.push_back(std::move(body));
    }
}

/// Files of ours say which frames the times are: all frames where a bone moves, else those that have a shape.
void GlbReader::name_frames(Animation& animation) const {
    for (std::size_t k = 0; k < animation.seconds.size(); ++k)
        animation.frames.push_back(static_cast<int>(k));
    const Json extras = document_.json()["asset"].value("extras", Json::object());
    if (!extras.is_object() || !extras.contains("fascicle") || !extras["fascicle"].is_object())
        return;
    const Json& about = extras["fascicle"];
    animation.provenance = about.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (const char* key : {"frames", "shape_frames"}) {
        const auto found = about.find(key);
        if (found == about.end() || !found->is_array() || found->size() != animation.seconds.size())
            continue;
        std::vector<int> frames;
        for (const Json& number : *found)
            if (number.is_number_integer() && number.get<std::int64_t>() >= 0 &&
                number.get<std::int64_t>() <= 1000000000 &&
                (frames.empty() || number.get<int>() > frames.back()))
                frames.push_back(number.get<int>());
        if (frames.size() == animation.seconds.size()) {
            animation.frames = frames;
            return;
        }
    }
}

Animation GlbReader::read() {
    Animation animation;
    animation.millimetres_per_unit = 1000;
    animation.up = 'y';
    animation.seconds = motion_->times();
    name_frames(animation);
    for (const int node : motion_->nodes())
        add_node(node, animation);
    if (animation.bodies.empty())
        document_.fail("it shows no mesh", "a node with triangles or lines");
    if (const Json& scenes = document_.list("scenes"); !scenes.empty())
        animation.name = text_of(scenes[0], "name");
    if (!document_.list("skins").empty())
        animation.notes.push_back("Skins are passed over: bodies stand as they were bound.");
    if (document_.list("animations").size() > 1)
        animation.notes.push_back("Of several animations the first is read.");
    if (passed_over_ > 0)
        animation.notes.push_back(
            "Parts that are no triangles or lines are passed over: " + std::to_string(passed_over_) + ".");
    return animation;
}

} // namespace

bool looks_like_glb(std::string_view bytes) {
    return bytes.substr(0, 4) == "glTF";
}

Animation read_glb(std::string_view bytes, const std::string& file) {
    return GlbReader(bytes, file).read();
}

MeshData read_glb_mesh(std::string_view bytes, const std::string& file) {
    return first_frame(read_glb(bytes, file));
}

} // namespace fascicle::io
