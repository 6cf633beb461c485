#include "io/formats/gltf_motion.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::io {

namespace {

constexpr std::size_t deepest = 100;

template <std::size_t N>
void read_numbers(const GltfDocument& document, const Json& object, const char* key,
                  std::array<double, N>& out) {
    const auto found = object.find(key);
    if (found == object.end())
        return;
    const auto bad = [&] {
        document.fail(std::string("\"") + key + "\" of a node is bad", std::to_string(N) + " finite numbers");
    };
    if (!found->is_array() || found->size() != N)
        bad();
    for (std::size_t i = 0; i < N; ++i) {
        if (!(*found)[i].is_number())
            bad();
        out[i] = (*found)[i].get<double>();
        if (!std::isfinite(out[i]) || std::abs(out[i]) > 1e12)
            bad();
    }
}

} // namespace

GltfMotion::GltfMotion(GltfDocument& document) {
    read_nodes(document);
    read_animation(document);
    for (const Sampler& sampler : samplers_)
        times_.insert(times_.end(), sampler.times->begin(), sampler.times->end());
    std::sort(times_.begin(), times_.end());
    times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
    if (times_.empty())
        times_.push_back(0);
}

void GltfMotion::read_nodes(GltfDocument& document) {
    const Json& nodes = document.list("nodes");
    data_.resize(nodes.size());
    std::size_t index = 0;
    for (const Json& json : nodes) {
        Node& node = data_[index];
        read_numbers(document, json, "translation", node.shift);
        read_numbers(document, json, "rotation", node.turn);
        read_numbers(document, json, "scale", node.stretch);
        if (json.contains("matrix")) {
            std::array<double, 16> m{}; // column by column
            read_numbers(document, json, "matrix", m);
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 4; ++column)
                    node.matrix.matrix()(row, column) = m[static_cast<std::size_t>(4 * column + row)];
            node.has_matrix = true;
        }
        if (const auto children = json.find("children"); children != json.end() && children->is_array())
            for (const Json& child : *children) {
                const std::int64_t c = child.is_number_integer() ? child.get<std::int64_t>() : -1;
                document.entry("nodes", c, "a node");
                Node& below = data_[static_cast<std::size_t>(c)];
                if (below.parent >= 0)
                    document.fail("node " + std::to_string(c) + " has two parents", "a tree of nodes");
                below.parent = static_cast<int>(index);
            }
        ++index;
    }
    for (std::size_t i = 0; i < data_.size(); ++i) {
        std::size_t depth = 0;
        for (int n = static_cast<int>(i); n >= 0; n = data_[static_cast<std::size_t>(n)].parent)
            if (++depth > deepest)
                document.fail("its nodes go round in a circle, or too deep", "at most 100 levels");
    }
    // The roots that the scene shows; all of them where no scene is named.
    std::vector<bool> shown(data_.size(), false);
    const Json& scenes = document.list("scenes");
    if (scenes.empty()) {
        for (std::size_t i = 0; i < data_.size(); ++i)
            shown[i] = data_[i].parent < 0;
    } else {
        const Json& scene =
            document.entry("scenes", document.integer(document.json(), "scene", 0), "the file");
        if (const auto roots = scene.find("nodes"); roots != scene.end() && roots->is_array())
            for (const Json& root : *roots) {
                const std::int64_t r = root.is_number_integer() ? root.get<std::int64_t>() : -1;
                document.entry("nodes", r, "the scene");
                shown[static_cast<std::size_t>(r)] = true;
            }
    }
    for (std::size_t i = 0; i < data_.size(); ++i)
        for (int n = static_cast<int>(i); n >= 0; n = data_[static_cast<std::size_t>(n)].parent)
            if (shown[static_cast<std::size_t>(n)]) {
                nodes_.push_back(static_cast<int>(i));
                break;
            }
}

void GltfMotion::read_animation(GltfDocument& document) {
    const Json& animations = document.list("animations");
    if (animations.empty())
        return;
    const Json& animation = animations[0];
    const auto part = [&](const char* name) -> const Json& {
        const auto found = animation.find(name);
        if (found == animation.end() || !found->is_array())
            document.fail(std::string("the animation has no ") + name, "a list of them");
        for (const Json& entry : *found)
            if (!entry.is_object())
                document.fail(std::string("an entry of ") + name + " is " + entry.type_name(), "an object");
        return *found;
    };
    const Json& samplers = part("samplers");
    std::size_t index = 0;
    for (const Json& channel : part("channels")) {
        const std::string user = "channel " + std::to_string(index++) + " of the animation";
        const auto target = channel.find("target");
        if (target == channel.end() || !target->is_object() || !target->contains("node"))
            continue;
        const auto name = target->find("path");
        const std::string path = name != target->end() && name->is_string() ? name->get<std::string>() : "";
        const int which = path == "translation" ? translation
                          : path == "rotation"  ? rotation
                          : path == "scale"     ? scale
                          : path == "weights"   ? weight
                                                : -1;
        if (which < 0) // of an extension
            continue;
        const std::int64_t node = document.integer(*target, "node", -1);
        document.entry("nodes", node, user);
        const std::int64_t s = document.integer(channel, "sampler", -1);
        if (s < 0 || static_cast<std::uint64_t>(s) >= samplers.size())
            document.fail(user + " has no sampler", "0 to " + std::to_string(samplers.size()) + " - 1");
        const Json& json = samplers[static_cast<std::size_t>(s)];
        Sampler sampler;
        if (const auto way = json.find("interpolation"); way != json.end() && way->is_string()) {
            sampler.step = *way == "STEP";
            sampler.cubic = *way == "CUBICSPLINE";
        }
        sampler.times = document.floats(document.integer(json, "input", -1), 1, user);
        const std::size_t components = which == rotation ? 4 : which == weight ? 1 : 3;
        sampler.values = document.floats(document.integer(json, "output", -1), components, user);
        const std::vector<float>& times = *sampler.times;
        if (times.empty() || sampler.values->empty())
            document.fail(user + " has no keys");
        for (std::size_t i = 1; i < times.size(); ++i)
            if (!(times[i] > times[i - 1]))
                document.fail(user + " has times that do not rise, key " + std::to_string(i));
        const std::size_t keys = times.size() * (sampler.cubic ? 3 : 1);
        if (sampler.values->size() % keys != 0 ||
            (which != weight && sampler.values->size() / keys != components))
            document.fail(user + " has " + std::to_string(sampler.values->size()) + " numbers for " +
                              std::to_string(times.size()) + " keys",
                          "as many for each");
        sampler.width = sampler.values->size() / keys;
        data_[static_cast<std::size_t>(node)].samplers[static_cast<std::size_t>(which)] =
            static_cast<int>(samplers_.size());
        samplers_.push_back(std::move(sampler));
    }
}

std::pair<std::size_t, double> GltfMotion::key_at(const Sampler& sampler, double time) {
    const std::vector<float>& times = *sampler.times;
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin())
        return {0, 0};
    const auto key = static_cast<std::size_t>(after - times.begin()) - 1;
    if (after == times.end() || sampler.step)
        return {key, 0};
    return {key, (time - double(times[key])) / (double(times[key + 1]) - double(times[key]))};
}

/// Of cubic splines the values alone; at the keys, which are all that is asked for, they are exact.
double GltfMotion::value(const Sampler& sampler, std::size_t key, std::size_t c) {
    return (*sampler.values)[(sampler.cubic ? 3 * key + 1 : key) * sampler.width + c];
}

bool GltfMotion::moves(int node) const {
    for (int n = node; n >= 0; n = data_[static_cast<std::size_t>(n)].parent)
        for (const int path : {translation, rotation, scale})
            if (data_[static_cast<std::size_t>(n)].samplers[static_cast<std::size_t>(path)] >= 0)
                return true;
    return false;
}

void GltfMotion::weigh(int node, double time, std::vector<double>& weights) const {
    const int s = data_[static_cast<std::size_t>(node)].samplers[weight];
    if (s < 0)
        return;
    const Sampler& sampler = samplers_[static_cast<std::size_t>(s)];
    const auto [key, share] = key_at(sampler, time);
    for (std::size_t i = 0; i < std::min(weights.size(), sampler.width); ++i) {
        weights[i] = value(sampler, key, i);
        if (share > 0)
            weights[i] += share * (value(sampler, key + 1, i) - weights[i]);
    }
}

Eigen::Affine3d GltfMotion::place(int node, double time) const {
    Eigen::Affine3d all = Eigen::Affine3d::Identity();
    for (int n = node; n >= 0; n = data_[static_cast<std::size_t>(n)].parent) {
        const Node& at = data_[static_cast<std::size_t>(n)];
        if (at.has_matrix) {
            all = at.matrix * all;
            continue;
        }
        const auto triple = [&](Path path, const std::array<double, 3>& rest) {
            Vec3 v(rest[0], rest[1], rest[2]);
            if (const int s = at.samplers[path]; s >= 0) {
                const Sampler& sampler = samplers_[static_cast<std::size_t>(s)];
                const auto key = key_at(sampler, time);
                for (int c = 0; c < 3; ++c) {
                    v[c] = value(sampler, key.first, static_cast<std::size_t>(c));
                    if (key.second > 0)
                        v[c] +=
                            key.second * (value(sampler, key.first + 1, static_cast<std::size_t>(c)) - v[c]);
                }
            }
            return v;
        };
        Eigen::Quaterniond turn(at.turn[3], at.turn[0], at.turn[1], at.turn[2]);
        if (const int s = at.samplers[rotation]; s >= 0) {
            const Sampler& sampler = samplers_[static_cast<std::size_t>(s)];
            const auto key = key_at(sampler, time);
            const auto of = [&](std::size_t k) {
                return Eigen::Quaterniond(value(sampler, k, 3), value(sampler, k, 0), value(sampler, k, 1),
                                          value(sampler, k, 2))
                    .normalized();
            };
            turn = key.second > 0 ? of(key.first).slerp(key.second, of(key.first + 1)) : of(key.first);
        }
        turn.normalize();
        all = Eigen::Translation3d(triple(translation, at.shift)) * turn *
              Eigen::Scaling(triple(scale, at.stretch)) * all;
    }
    return all;
}

} // namespace fascicle::io
