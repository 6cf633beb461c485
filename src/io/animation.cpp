#include "fascicle/io/animation.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/text.hpp"
#include "io/formats/text_scanner.hpp"

#include <map>
#include <set>

namespace fascicle {

namespace {

template <typename Made>
std::vector<std::string> made_unique(const std::vector<std::string>& names, const std::string& between,
                                     const Made& made) {
    std::vector<std::string> out;
    std::set<std::string> taken;
    std::map<std::string, int> numbers; // the next of each name: all before it are taken
    for (const std::string& name : names) {
        const std::string base = made(name.empty() ? "body" : name);
        std::string own = base;
        int& number = numbers.try_emplace(io::lower_case(base), 2).first->second;
        while (!taken.insert(io::lower_case(own)).second)
            own = base + between + std::to_string(number++);
        out.push_back(own);
    }
    return out;
}

std::string identifier(const std::string& name) {
    std::string out;
    for (const char c : name) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        const bool digit = c >= '0' && c <= '9';
        if (digit && out.empty())
            out += '_';
        out += letter || digit ? c : '_';
    }
    return out;
}

} // namespace

void points_in_frame(const AnimatedBody& body, std::size_t k, Points& points) {
    points.resize(body.rest.size());
    if (!body.poses.empty()) {
        const Pose& pose = body.poses.at(k);
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i] = pose.is_identity() ? body.rest[i] : pose.apply(body.rest[i]);
        return;
    }
    FASCICLE_ASSERT(body.points != nullptr);
    body.points(k, points);
}

MeshData first_frame(const Animation& animation) {
    MeshData data;
    data.notes = animation.notes;
    Points all, points;
    for (const AnimatedBody& body : animation.bodies) {
        points_in_frame(body, 0, points);
        const int offset = static_cast<int>(all.size());
        all.insert(all.end(), points.begin(), points.end());
        for (const Tri& t : body.triangles)
            data.mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
        for (std::vector<int> line : body.lines) {
            for (int& v : line)
                v += offset;
            data.lines.lines.push_back(std::move(line));
        }
    }
    if (!data.lines.lines.empty())
        data.lines.points = all;
    if (!data.mesh.triangles.empty() || data.lines.lines.empty())
        data.mesh.positions = std::move(all);
    if (animation.bodies.size() > 1)
        data.notes.push_back(std::to_string(animation.bodies.size()) + " bodies are taken as one mesh.");
    if (animation.frame_count() > 1)
        data.notes.push_back("The first of " + std::to_string(animation.frame_count()) + " frames is taken.");
    return data;
}

std::vector<std::size_t> spread_frames(std::size_t count, int most) {
    FASCICLE_ASSERT(most >= 1);
    std::vector<std::size_t> places;
    if (count == 0)
        return places;
    const std::size_t last = count - 1, shapes = static_cast<std::size_t>(most);
    const std::size_t step = last == 0 ? 1 : (last + shapes - 1) / shapes;
    for (std::size_t k = 0; k < last; k += step)
        places.push_back(k);
    places.push_back(last);
    return places;
}

std::vector<std::string> unique_names(const std::vector<std::string>& names) {
    return made_unique(names, " ", [](const std::string& name) { return name; });
}

std::vector<std::string> unique_file_names(const std::vector<std::string>& names) {
    return made_unique(names, "_", [](const std::string& name) { return file_name_for(name); });
}

std::vector<std::string> unique_identifiers(const std::vector<std::string>& names) {
    return made_unique(names, "_", identifier);
}

} // namespace fascicle
