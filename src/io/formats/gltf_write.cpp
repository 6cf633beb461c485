#include "io/formats/gltf_write.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/vertex_normals.hpp"
#include "io/formats/mesh_bodies.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

namespace fascicle::io {

namespace {

using Json = nlohmann::ordered_json;

// Numbers of the specification, section 5.
constexpr int unsigned_short = 5123, unsigned_int = 5125, float_type = 5126;
constexpr int vertex_data = 34962, index_data = 34963;
constexpr int lines_mode = 1, triangles_mode = 4;

static_assert(std::endian::native == std::endian::little,
              "glTF is little-endian; bytes are written as they lie");

/// One buffer view and its accessor: how many bytes, and who writes them later.
struct Block {
    std::size_t bytes = 0;
    std::function<void(std::ostream&)> write;
};

template <typename Value>
void write_values(std::ostream& out, const std::vector<Value>& values) {
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(Value)));
}

using Floats = std::vector<float>;

/// Positions of a body in metres, y up.
class ToMetres {
public:
    explicit ToMetres(const Animation& animation) {
        scale_ = animation.millimetres_per_unit > 0 ? animation.millimetres_per_unit / 1000 : 1;
        if (animation.up == 'z')
            turn_ << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    }
    Vec3 point(const Vec3& p) const { return scale_ * (turn_ * p); }
    Pose pose(const Pose& p) const {
        return {turn_ * p.rotation * turn_.transpose(), scale_ * (turn_ * p.translation)};
    }

private:
    double scale_ = 1;
    Mat3 turn_ = Mat3::Identity();
};

class GlbWriter {
public:
    GlbWriter(const Animation& animation, const GltfOptions& options, const JobControl& control,
              const std::string& where)
        : animation_(animation), control_(control), where_(where), convert_(animation),
          shapes_(spread_frames(animation.frame_count(), options.morph_targets)) {}

    void write(std::ostream& out);

private:
    void add_body(const AnimatedBody& body, const std::string& name);
    Json add_surface(const AnimatedBody& body);
    void add_motion(const AnimatedBody& body, int node);
    int material(BodyKind kind);
    int add_accessor(const char* type, int component, std::size_t count, Block block, int target,
                     Json bounds = Json::object());
    int add_times(const std::vector<std::size_t>& places);
    int add_scalars(Floats values, const char* type, std::size_t components, const Json& bounds);
    int add_indices(std::vector<std::uint32_t> indices, std::size_t vertices);
    int add_points(std::size_t count, const std::function<void(Floats&)>& values, bool bounded);
    void floats_of(const Points& points, Floats& values) const;
    void shape_in(const AnimatedBody& body, std::size_t place, Points& points) const;

    const Animation& animation_;
    const JobControl& control_;
    const std::string& where_; ///< the file, for errors
    ToMetres convert_;
    std::vector<std::size_t> shapes_; ///< places of the frames that have a shape
    Json gltf_;
    Json channels_ = Json::array(), samplers_ = Json::array();
    std::vector<Block> blocks_;
    std::size_t bytes_ = 0;
    int shape_sampler_ = -1;                   ///< of weights, one for all
    int frame_times_ = -1;                     ///< accessor
    std::array<int, 3> materials_{-1, -1, -1}; ///< by BodyKind
};

int index_of_last(const Json& list) {
    return static_cast<int>(list.size()) - 1;
}

int GlbWriter::add_accessor(const char* type, int component, std::size_t count, Block block, int target,
                            Json bounds) {
    Json view{{"buffer", 0}, {"byteOffset", bytes_}, {"byteLength", block.bytes}};
    if (target != 0)
        view["target"] = target;
    gltf_["bufferViews"].push_back(view);
    Json accessor{{"bufferView", index_of_last(gltf_["bufferViews"])},
                  {"componentType", component},
                  {"count", count},
                  {"type", type}};
    accessor.update(bounds);
    gltf_["accessors"].push_back(accessor);
    bytes_ += (block.bytes + 3) / 4 * 4;
    blocks_.push_back(std::move(block));
    return index_of_last(gltf_["accessors"]);
}

/// VEC3 floats that are made again when they are written, so that not all shapes are in memory at once.
int GlbWriter::add_points(std::size_t count, const std::function<void(Floats&)>& values, bool bounded) {
    Json bounds = Json::object();
    if (bounded) {
        Floats floats;
        values(floats);
        std::array<float, 3> low, high;
        low.fill(std::numeric_limits<float>::infinity());
        high.fill(-std::numeric_limits<float>::infinity());
        for (std::size_t i = 0; i < floats.size(); ++i) {
            low[i % 3] = std::min(low[i % 3], floats[i]);
            high[i % 3] = std::max(high[i % 3], floats[i]);
        }
        bounds = {{"min", low}, {"max", high}};
    }
    const auto write = [values](std::ostream& out) {
        Floats floats;
        values(floats);
        write_values(out, floats);
    };
    return add_accessor("VEC3", float_type, count, {count * 3 * sizeof(float), write}, vertex_data, bounds);
}

int GlbWriter::add_scalars(Floats values, const char* type, std::size_t components, const Json& bounds) {
    const std::size_t count = values.size() / components;
    const std::size_t bytes = values.size() * sizeof(float);
    const auto write = [kept = std::move(values)](std::ostream& out) { write_values(out, kept); };
    return add_accessor(type, float_type, count, {bytes, write}, 0, bounds);
}

int GlbWriter::add_times(const std::vector<std::size_t>& places) {
    Floats times;
    for (const std::size_t k : places) {
        times.push_back(to_float(animation_.seconds[k] - animation_.seconds[0], where_));
        if (times.size() > 1 && !(times.back() > times[times.size() - 2]))
            throw_error(where_,
                        "frame " + std::to_string(animation_.frames[k]) +
                            " is at the time of the one before it, in floats",
                        "times that floats can tell apart");
    }
    const Json bounds{{"min", {times.front()}}, {"max", {times.back()}}};
    return add_scalars(std::move(times), "SCALAR", 1, bounds);
}

/// 16 bits where they reach; 65535 is no index but ends a strip.
int GlbWriter::add_indices(std::vector<std::uint32_t> indices, std::size_t vertices) {
    const bool small = vertices <= 65535;
    const std::size_t count = indices.size();
    const auto write = [small, kept = std::move(indices)](std::ostream& out) {
        if (small)
            write_values(out, std::vector<std::uint16_t>(kept.begin(), kept.end()));
        else
            write_values(out, kept);
    };
    return add_accessor("SCALAR", small ? unsigned_short : unsigned_int, count,
                        {count * (small ? 2 : 4), write}, index_data);
}

void GlbWriter::floats_of(const Points& points, Floats& values) const {
    values.resize(points.size() * 3);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int c = 0; c < 3; ++c)
            // No negative zero: a reader's transforms take its sign away, and a file read and written again would be another.
            values[3 * i + static_cast<std::size_t>(c)] = to_float(points[i][c], where_) + 0.0f;
}

/// Metres, y up. A rigid body: before its pose.
void GlbWriter::shape_in(const AnimatedBody& body, std::size_t place, Points& points) const {
    if (body.poses.empty())
        points_in_frame(body, place, points);
    else
        points = body.rest;
    for (Vec3& p : points)
        p = convert_.point(p);
}

/// Normals of unit length: a vertex without triangles has one, too, since glTF asks for it.
Points whole_normals(const Points& points, const std::vector<Tri>& triangles) {
    Points normals = vertex_normals(points, triangles);
    for (Vec3& n : normals)
        if (n.squaredNorm() < 0.25)
            n = Vec3::UnitZ();
    return normals;
}

Json GlbWriter::add_surface(const AnimatedBody& body) {
    const std::size_t count = body.rest.size();
    const bool surface = !body.triangles.empty();
    const auto positions = [this, &body](Floats& values) {
        Points points;
        shape_in(body, 0, points);
        floats_of(points, values);
    };
    const auto normals = [this, &body](Floats& values) {
        Points points;
        shape_in(body, 0, points);
        floats_of(whole_normals(rounded_to_floats(points, where_), body.triangles), values);
    };
    Json primitive{{"attributes", {{"POSITION", add_points(count, positions, true)}}}};
    if (surface)
        primitive["attributes"]["NORMAL"] = add_points(count, normals, false);
    std::vector<std::uint32_t> indices;
    if (surface)
        for (const Tri& t : body.triangles)
            for (const int v : t)
                indices.push_back(static_cast<std::uint32_t>(v));
    else
        for (const std::vector<int>& line : body.lines)
            for (std::size_t i = 1; i < line.size(); ++i) {
                indices.push_back(static_cast<std::uint32_t>(line[i - 1]));
                indices.push_back(static_cast<std::uint32_t>(line[i]));
            }
    primitive["indices"] = add_indices(std::move(indices), count);
    primitive["material"] = material(body.kind);
    primitive["mode"] = surface ? triangles_mode : lines_mode;
    if (!body.poses.empty())
        return primitive;
    for (std::size_t i = 1; i < shapes_.size(); ++i) {
        control_.checkpoint("shapes", 0); // the share is told while writing, which takes as long again
        const std::size_t place = shapes_[i];
        // Against the rounded positions of the base, so that base + difference is off by the difference's rounding alone.
        const auto moved = [this, &body, place](Floats& values) {
            Points points;
            shape_in(body, 0, points);
            floats_of(points, values);
            shape_in(body, place, points);
            for (std::size_t v = 0; v < points.size(); ++v)
                for (int c = 0; c < 3; ++c) {
                    float& value = values[3 * v + static_cast<std::size_t>(c)];
                    value = to_float(points[v][c] - double(value), where_);
                }
        };
        const auto turned = [this, &body, place](Floats& values) {
            Points points;
            shape_in(body, 0, points);
            const Points before = whole_normals(rounded_to_floats(points, where_), body.triangles);
            shape_in(body, place, points);
            Points after = whole_normals(points, body.triangles);
            for (std::size_t v = 0; v < after.size(); ++v)
                after[v] -= before[v];
            floats_of(after, values);
        };
        Json target{{"POSITION", add_points(count, moved, true)}};
        if (surface)
            target["NORMAL"] = add_points(count, turned, false);
        primitive["targets"].push_back(target);
    }
    return primitive;
}

/// Rotation and translation of every frame; of a body that does not move, the node's own.
void GlbWriter::add_motion(const AnimatedBody& body, int node) {
    std::vector<Pose> poses;
    for (const Pose& pose : body.poses)
        poses.push_back(convert_.pose(pose));
    Floats turns, places;
    Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
    bool moves = false;
    for (const Pose& pose : poses) {
        Eigen::Quaterniond q = Eigen::Quaterniond(pose.rotation).normalized();
        if (q.dot(last) < 0) // q and -q are the same turn: the one nearer to the last goes the shorter way
            q.coeffs() = -q.coeffs();
        last = q;
        for (const double c : {q.x(), q.y(), q.z(), q.w()})
            turns.push_back(static_cast<float>(c));
        for (int c = 0; c < 3; ++c)
            places.push_back(to_float(pose.translation[c], where_));
        moves = moves || pose.rotation != poses[0].rotation || pose.translation != poses[0].translation;
    }
    if (!poses[0].is_identity() || moves) {
        gltf_["nodes"][static_cast<std::size_t>(node)]["rotation"] = Floats(turns.begin(), turns.begin() + 4);
        gltf_["nodes"][static_cast<std::size_t>(node)]["translation"] =
            Floats(places.begin(), places.begin() + 3);
    }
    if (!moves)
        return;
    if (frame_times_ < 0) {
        std::vector<std::size_t> all(poses.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        frame_times_ = add_times(all);
    }
    const auto add = [&](const char* path, Floats values, const char* type, std::size_t components) {
        samplers_.push_back({{"input", frame_times_},
                             {"output", add_scalars(std::move(values), type, components, Json::object())},
                             {"interpolation", "LINEAR"}});
        channels_.push_back(
            {{"sampler", index_of_last(samplers_)}, {"target", {{"node", node}, {"path", path}}}});
    };
    add("rotation", std::move(turns), "VEC4", 4);
    add("translation", std::move(places), "VEC3", 3);
}

void GlbWriter::add_body(const AnimatedBody& body, const std::string& name) {
    const bool drawn = !body.triangles.empty() || std::any_of(body.lines.begin(), body.lines.end(),
                                                              [](const auto& l) { return l.size() > 1; });
    if (!drawn)
        return;
    Json mesh{{"name", name}, {"primitives", {add_surface(body)}}};
    const bool shapes = body.poses.empty() && shapes_.size() > 1;
    if (shapes) {
        mesh["weights"] = std::vector<int>(shapes_.size() - 1, 0);
        Json names = Json::array();
        for (std::size_t i = 1; i < shapes_.size(); ++i)
            names.push_back("frame " + std::to_string(animation_.frames[shapes_[i]]));
        mesh["extras"]["targetNames"] = names; // what Blender and three.js show
    }
    gltf_["meshes"].push_back(mesh);
    gltf_["nodes"].push_back({{"name", name}, {"mesh", index_of_last(gltf_["meshes"])}});
    const int node = index_of_last(gltf_["nodes"]);
    gltf_["nodes"][0]["children"].push_back(node);
    if (!body.poses.empty())
        add_motion(body, node);
    if (!shapes)
        return;
    if (shape_sampler_ < 0) {
        // Shape i alone at its own time, nothing at the first: between two times their shapes are blended.
        const std::size_t targets = shapes_.size() - 1;
        Floats weights(shapes_.size() * targets, 0.0f);
        for (std::size_t i = 1; i < shapes_.size(); ++i)
            weights[i * targets + i - 1] = 1;
        const int times = add_times(shapes_);
        const int values = add_scalars(std::move(weights), "SCALAR", 1, Json::object());
        samplers_.push_back({{"input", times}, {"output", values}, {"interpolation", "LINEAR"}});
        shape_sampler_ = index_of_last(samplers_);
    }
    channels_.push_back({{"sampler", shape_sampler_}, {"target", {{"node", node}, {"path", "weights"}}}});
}

/// Linear colours; made when the first body wants it, since what nothing uses is a fault to validators.
int GlbWriter::material(BodyKind kind) {
    struct Look {
        const char* name;
        std::array<double, 4> colour;
        double roughness;
    };
    static constexpr Look looks[]{{"muscle", {0.42, 0.06, 0.05, 1}, 0.55},
                                  {"bone", {0.78, 0.70, 0.54, 1}, 0.7},
                                  {"fibres", {0.85, 0.45, 0.30, 1}, 0.8}};
    int& index = materials_[static_cast<std::size_t>(kind)];
    if (index >= 0)
        return index;
    const Look& look = looks[static_cast<std::size_t>(kind)];
    gltf_["materials"].push_back(
        {{"name", look.name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", look.colour}, {"metallicFactor", 0.0}, {"roughnessFactor", look.roughness}}},
         {"doubleSided", true}}); // bones may have holes
    return index = index_of_last(gltf_["materials"]);
}

void GlbWriter::write(std::ostream& out) {
    gltf_["asset"] = {{"version", "2.0"}, {"generator", std::string("fascicle ") + program_version()}};
    Json about = animation_.provenance.empty() ? Json::object() : Json::parse(animation_.provenance);
    about["frames"] = animation_.frames;
    std::vector<int> shape_frames;
    for (const std::size_t k : shapes_)
        shape_frames.push_back(animation_.frames[k]);
    about["shape_frames"] = shape_frames;
    gltf_["asset"]["extras"]["fascicle"] = about;
    gltf_["scene"] = 0;
    std::vector<std::string> names;
    for (const AnimatedBody& body : animation_.bodies)
        names.push_back(body.name);
    names.push_back(animation_.name); // last: a scene called as its muscle gives way
    names = unique_names(names);
    gltf_["scenes"] = {{{"name", animation_.name}, {"nodes", {0}}}};
    gltf_["nodes"] = {{{"name", names.back()}}};
    for (std::size_t i = 0; i < animation_.bodies.size(); ++i)
        add_body(animation_.bodies[i], names[i]);
    if (!gltf_.contains("meshes"))
        throw_error(where_, "there is nothing to write", "a body with triangles or lines");
    if (!channels_.empty())
        gltf_["animations"] = {{{"name", "motion"}, {"samplers", samplers_}, {"channels", channels_}}};
    gltf_["buffers"] = {{{"byteLength", bytes_}}};

    std::string json = gltf_.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.append((4 - json.size() % 4) % 4, ' ');
    const std::uint64_t total = 12 + 8 + std::uint64_t{json.size()} + 8 + bytes_;
    if (total > std::numeric_limits<std::uint32_t>::max())
        throw_error(where_, "the file would be larger than 4 GiB, which glTF cannot say",
                    "fewer morph targets or frames");
    const auto word = [&](std::uint64_t value) {
        const auto bits = static_cast<std::uint32_t>(value);
        out.write(reinterpret_cast<const char*>(&bits), sizeof bits);
    };
    out.write("glTF", 4);
    word(2);
    word(total);
    word(json.size());
    out.write("JSON", 4);
    out.write(json.data(), static_cast<std::streamsize>(json.size()));
    word(bytes_);
    out.write("BIN\0", 4);
    std::size_t done = 0;
    for (const Block& block : blocks_) {
        control_.checkpoint("writing", static_cast<double>(done) / static_cast<double>(bytes_));
        block.write(out);
        out.write("\0\0\0", static_cast<std::streamsize>((4 - block.bytes % 4) % 4));
        done += block.bytes;
    }
}

} // namespace

void write_glb(std::ostream& out, const Animation& animation, const GltfOptions& options,
               const std::string& where, const JobControl& control) {
    GlbWriter(animation, options, control, where).write(out);
}

void write_glb_mesh(std::ostream& out, const MeshData& data) {
    Animation animation;
    animation.name = "mesh";
    animation.millimetres_per_unit = 0;
    animation.up = 'y';
    animation.frames = {0};
    animation.seconds = {0};
    animation.bodies = bodies_of_mesh(data, BodyKind::bone);
    for (AnimatedBody& body : animation.bodies)
        body.poses = {Pose{}};
    write_glb(out, animation, {}, "glTF");
}

} // namespace fascicle::io
