#include "io/project_unknown.hpp"

#include <algorithm>

namespace fascicle::io {
namespace {

struct Shape;

struct Child {
    const char* key;
    const Shape* shape;
    /// Of entries of a list: fields that all have to be the same, one set after the other; none: by place.
    std::vector<std::vector<const char*>> same = {};
};

/// The fields that this version may write into an object, and those among them that hold objects themselves.
struct Shape {
    std::vector<const char*> known;
    std::vector<Child> children = {};
};

const Shape& project_shape() {
    static const Shape source{{"path", "hash", "size"}};
    static const Shape carried{{"vertices", "triangles", "coordinate_bits", "index_bits", "data"}};
    static const Shape fibres{{"path", "hash", "size", "points", "lines"}};
    static const Shape fibre_template{{"path", "hash", "size", "template"}};
    static const Shape outline{{"kind", "bone", "points", "head", "hole"}};
    static const Shape attachment{{"kind", "bone", "vertices"}};
    static const Shape area{{"kind", "bone", "head", "vertex_count", "ranges"}};
    static const Shape bone{{"name", "path", "hash", "size", "embedded", "mesh"}, {{"mesh", &carried}}};
    static const Shape muscle{{"name", "path", "hash", "size", "embedded", "mesh", "attach_automatically",
                               "attach_to", "outline_files", "outlines", "attachments", "areas",
                               "surface_fibres", "fibre_template"},
                              {{"mesh", &carried},
                               {"outline_files", &source, {{"path"}}},
                               {"outlines", &outline, {{"kind", "bone", "head"}, {"kind", "bone"}}},
                               {"attachments", &attachment, {{"kind", "bone"}}},
                               {"areas", &area, {{"kind", "bone", "head"}, {"kind", "bone"}}},
                               {"surface_fibres", &fibres},
                               {"fibre_template", &fibre_template}}};
    static const Shape hinge{{"centre", "axis"}};
    static const Shape angle{{"frame", "angle_rad"}};
    static const Shape pose{{"frame", "pose"}};
    static const Shape track{{"bone", "keys"}, {{"keys", &pose, {{"frame"}}}}};
    static const Shape timeline{
        {"last_frame", "hinge", "angles", "tracks"},
        {{"hinge", &hinge}, {"angles", &angle, {{"frame"}}}, {"tracks", &track, {{"bone"}}}}};
    static const Shape marker{{"frame", "name"}};
    static const Shape body{{"body", "bone"}};
    static const Shape opensim{{"model", "trial", "mesh_frame", "axes", "coordinate", "from_s", "to_s",
                                "trial_frames", "lines", "bodies"},
                               {{"model", &source}, {"trial", &source}, {"bodies", &body, {{"body"}}}}};
    static const Shape parameters{{}}; // keys of the table that are not written stand at their defaults
    static const Shape project{{"fascicle_project", "program_version", "name", "embedded_scene",
                                "carries_meshes", "unit", "bones", "muscles", "timeline", "markers",
                                "motion_file", "opensim", "line_muscles", "parameter_defaults", "parameters"},
                               {{"bones", &bone, {{"name"}, {"path", "hash"}}},
                                {"muscles", &muscle, {{"name"}, {"path", "hash"}}},
                                {"timeline", &timeline},
                                {"markers", &marker, {{"frame", "name"}, {"name"}, {"frame"}}},
                                {"motion_file", &source},
                                {"opensim", &opensim},
                                {"line_muscles", &source}}};
    return project;
}

bool same_fields(const Json& a, const Json& b, const std::vector<const char*>& fields) {
    return std::all_of(fields.begin(), fields.end(), [&](const char* field) {
        const auto x = a.find(field), y = b.find(field);
        return (x == a.end()) == (y == b.end()) && (x == a.end() || *x == *y);
    });
}

void keep(Json& fresh, const Json& previous, const Shape& shape);

void keep_in_list(Json& fresh, const Json& previous, const Child& child) {
    std::vector<bool> used(previous.size()), done(fresh.size());
    for (const auto& fields : child.same)
        for (std::size_t i = 0; i < fresh.size(); ++i)
            for (std::size_t k = 0; k < previous.size() && !done[i]; ++k)
                if (!used[k] && previous[k].is_object() && same_fields(fresh[i], previous[k], fields)) {
                    keep(fresh[i], previous[k], *child.shape);
                    used[k] = done[i] = true;
                }
}

void keep(Json& fresh, const Json& previous, const Shape& shape) {
    for (const auto& [key, value] : previous.items()) {
        const bool known = std::any_of(shape.known.begin(), shape.known.end(),
                                       [&name = key](const char* field) { return name == field; });
        if (!known && !fresh.contains(key))
            fresh[key] = value;
    }
    for (const Child& child : shape.children) {
        const auto mine = fresh.find(child.key);
        const auto theirs = previous.find(child.key);
        if (mine == fresh.end() || theirs == previous.end())
            continue;
        if (mine->is_object() && theirs->is_object())
            keep(*mine, *theirs, *child.shape);
        else if (mine->is_array() && theirs->is_array())
            keep_in_list(*mine, *theirs, child);
    }
}

} // namespace

void keep_unknown_fields(Json& fresh, const Json& previous) {
    if (previous.is_object())
        keep(fresh, previous, project_shape());
}

} // namespace fascicle::io
