// The texts of options about an OpenSim model.
#include "fascicle/base/error.hpp"
#include "fascicle/base/suggest.hpp"
#include "io/osim_scene/osim_scene.hpp"

namespace fascicle {
namespace {

[[noreturn]] void fail(const std::string& where, const std::string& what, const std::string& expected) {
    throw_error(where, what, expected, ErrorKind::usage);
}

} // namespace

MeshFrame parse_mesh_frame(const std::string& text) {
    for (const MeshFrame frame : {MeshFrame::body, MeshFrame::ground, MeshFrame::scan})
        if (text == to_text(frame))
            return frame;
    fail("--mesh-frame", "got '" + text + "'" + did_you_mean(text, {"body", "ground", "scan"}),
         "body, ground or scan");
}

const char* axis_mapping_key(AxisMapping mapping) {
    for (const AxisMappingRow& row : axis_mappings())
        if (row.mapping == mapping)
            return row.key;
    return "as_is";
}

AxisMapping parse_axis_mapping(const std::string& text) {
    std::string known;
    std::vector<std::string> keys;
    for (const AxisMappingRow& row : axis_mappings()) {
        if (text == row.key)
            return row.mapping;
        known += (known.empty() ? "" : ", ") + std::string(row.key);
        keys.emplace_back(row.key);
    }
    fail("--axes", "got '" + text + "'" + did_you_mean(text, keys), "one of " + known);
}

MeshOfBodies parse_mesh_of_bodies(const std::string& option, const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos && !text.empty())
        return {text, {}};
    MeshOfBodies out{text.substr(0, equals), {}};
    std::string rest =
        text.substr(equals + 1); // all of it without an equals sign: only an empty text, an error
    bool good = equals > 0;
    for (std::size_t comma; good; rest = rest.substr(comma + 1)) {
        comma = rest.find(',');
        out.bodies.push_back(rest.substr(0, comma));
        good = !out.bodies.back().empty();
        if (comma == std::string::npos)
            break;
    }
    if (!good)
        fail(option, "got '" + text + "'", "MESH=BODY, or MESH=BODY,BODY");
    return out;
}

namespace io {

void check_osim_request(const SceneRequest& r) {
    const std::pair<bool, const char*> others[] = {{r.hinge.has_value(), "--hinge"},
                                                   {r.angle_deg.has_value(), "--angle-deg"},
                                                   {r.phases.has_value(), "--phases"},
                                                   {!r.moving_bones.empty(), "--moving-bone"},
                                                   {!r.lines.empty(), "--lines"}};
    for (const auto& [is, option] : others)
        if (is)
            fail(option, "cannot go with --osim: the model and its trial tell all bones, lines and frames",
                 "one of the two");
    if (r.motion.empty())
        fail("--osim", "the model has no motion", "--motion TRIAL.mot beside it");
    const TrialReading& reading = r.osim.reading;
    if (reading.from_s && reading.to_s && !(*reading.from_s < *reading.to_s))
        fail("--to", "is not after --from", "seconds of the trial, ascending");
}

void require_no_osim_options(const OsimRequest& osim) {
    const std::pair<bool, const char*> given[] = {
        {osim.mesh_frame.has_value(), "--mesh-frame"}, {osim.axes != AxisMapping::as_is, "--axes"},
        {!osim.coordinate.empty(), "--coordinate"},    {osim.reading.from_s.has_value(), "--from"},
        {osim.reading.to_s.has_value(), "--to"},       {osim.reading.frames != 0, "--trial-frames"}};
    for (const auto& [is, option] : given)
        if (is)
            fail(option, "is about a model", "--osim MODEL beside it");
}

} // namespace io
} // namespace fascicle
