#include "io/formats/usda_write.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/vertex_normals.hpp"
#include "io/formats/mesh_bodies.hpp"
#include "io/formats/usda_read.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <utility>

namespace fascicle::io {

namespace {

/// The shortest digits that read back as the same float.
void put(std::ostream& out, float value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    out.write(text, end - text);
}

void put(std::ostream& out, const Vec3& p) {
    out << '(';
    put(out, to_float(p.x(), "USD"));
    out << ", ";
    put(out, to_float(p.y(), "USD"));
    out << ", ";
    put(out, to_float(p.z(), "USD"));
    out << ')';
}

template <typename List, typename Each>
void put_list(std::ostream& out, const List& list, const Each& each) {
    out << '[';
    bool first = true;
    for (const auto& item : list) {
        if (!std::exchange(first, false))
            out << ", ";
        each(item);
    }
    out << ']';
}

void put_points(std::ostream& out, const Points& points) {
    put_list(out, points, [&](const Vec3& p) { put(out, p); });
}

/// Text between quotes: what would end it or the line is escaped.
std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += '\\';
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out + '"';
}

/// Four digits are enough for shading, and make half the text.
Points rounded(Points normals) {
    for (Vec3& n : normals)
        for (int c = 0; c < 3; ++c)
            n[c] = std::round(n[c] * 1e4) / 1e4 + 0.0; // no "-0"
    return normals;
}

class UsdaWriter {
public:
    UsdaWriter(std::ostream& out, const Animation& animation, const JobControl& control)
        : out_(out), animation_(animation), control_(control) {}

    void write();

private:
    void write_surface(const AnimatedBody& body, const std::string& indent);
    void write_fibres(const AnimatedBody& body);
    void write_body(const AnimatedBody& body, const std::string& name);
    void write_poses(const AnimatedBody& body);
    /// "points = ..." of a body that stands still in its own frame, "points.timeSamples = { ... }" of one that deforms.
    /// interpolation: metadata, or null.
    void write_values(const AnimatedBody& body, const std::string& indent, const std::string& name,
                      const std::function<void(const Points&)>& value, const char* interpolation = nullptr);
    void end_with(const std::string& indent, const char* interpolation);

    std::ostream& out_;
    const Animation& animation_;
    const JobControl& control_;
    std::size_t done_ = 0; ///< bodies
};

void UsdaWriter::end_with(const std::string& indent, const char* interpolation) {
    if (interpolation != nullptr)
        out_ << " (\n" << indent << "    interpolation = \"" << interpolation << "\"\n" << indent << ")";
    out_ << "\n";
}

void UsdaWriter::write_values(const AnimatedBody& body, const std::string& indent, const std::string& name,
                              const std::function<void(const Points&)>& value, const char* interpolation) {
    if (!body.poses.empty() || animation_.frame_count() < 2) {
        out_ << indent << name << " = ";
        value(body.rest);
        end_with(indent, interpolation);
        return;
    }
    if (interpolation != nullptr) { // beside time samples it takes a statement of its own
        out_ << indent << name;
        end_with(indent, interpolation);
    }
    out_ << indent << name << ".timeSamples = {\n";
    Points points;
    for (std::size_t k = 0; k < animation_.frame_count(); ++k) {
        control_.checkpoint("writing",
                            (static_cast<double>(done_) +
                             static_cast<double>(k) / static_cast<double>(animation_.frame_count())) /
                                static_cast<double>(animation_.bodies.size()));
        points_in_frame(body, k, points);
        out_ << indent << "    " << animation_.frames[k] << ": ";
        value(points);
        out_ << ",\n";
    }
    out_ << indent << "}\n";
}

void put_extent(std::ostream& out, const Points& points, double margin) {
    BoundingBox box;
    for (const Vec3& p : rounded_to_floats(points, "USD")) // so that no point lies outside
        box.add(p);
    const Vec3 by = Vec3::Constant(margin);
    out << '[';
    put(out, box.min - by);
    out << ", ";
    put(out, box.max + by);
    out << ']';
}

void UsdaWriter::write_surface(const AnimatedBody& body, const std::string& indent) {
    const auto values = [&](const char* name, const std::function<void(const Points&)>& value) {
        write_values(body, indent, name, value);
    };
    out_ << indent << "uniform token subdivisionScheme = \"none\"\n";
    out_ << indent << "uniform bool doubleSided = " << (body.kind == BodyKind::bone ? 1 : 0) << "\n";
    out_ << indent << "int[] faceVertexCounts = ";
    put_list(out_, body.triangles, [&](const Tri&) { out_ << 3; });
    out_ << "\n" << indent << "int[] faceVertexIndices = ";
    put_list(out_, body.triangles, [&](const Tri& t) { out_ << t[0] << ", " << t[1] << ", " << t[2]; });
    out_ << "\n";
    values("point3f[] points", [&](const Points& points) { put_points(out_, points); });
    values("float3[] extent", [&](const Points& points) { put_extent(out_, points, 0); });
    const auto normals = [&](const Points& points) {
        put_points(out_, rounded(vertex_normals(rounded_to_floats(points, "USD"), body.triangles)));
    };
    write_values(body, indent, "normal3f[] normals", normals, "vertex");
    out_ << indent << "color3f[] primvars:displayColor = ["
         << (body.kind == BodyKind::bone ? "(0.78, 0.7, 0.54)" : "(0.42, 0.06, 0.05)") << ']';
    end_with(indent, "constant");
}

void UsdaWriter::write_fibres(const AnimatedBody& body) {
    const std::string indent = "        ";
    const double millimetre =
        animation_.millimetres_per_unit > 0 ? 1 / animation_.millimetres_per_unit : 0.001;
    const double width = 0.6 * millimetre;
    out_ << indent << "uniform token type = \"linear\"\n";
    out_ << indent << "uniform token wrap = \"nonperiodic\"\n";
    out_ << indent << "int[] curveVertexCounts = ";
    put_list(out_, body.lines, [&](const std::vector<int>& line) { out_ << line.size(); });
    out_ << "\n";
    // Curves have points of their own, one after another.
    const auto along = [&](const Points& points) {
        Points own;
        for (const std::vector<int>& line : body.lines)
            for (const int v : line)
                own.push_back(points[static_cast<std::size_t>(v)]);
        return own;
    };
    write_values(body, indent, "point3f[] points",
                 [&](const Points& points) { put_points(out_, along(points)); });
    write_values(body, indent, "float3[] extent",
                 [&](const Points& points) { put_extent(out_, along(points), width); });
    out_ << indent << "float[] widths = [";
    put(out_, static_cast<float>(width));
    out_ << ']';
    end_with(indent, "constant");
    out_ << indent << "color3f[] primvars:displayColor = [(0.85, 0.45, 0.3)]";
    end_with(indent, "constant");
}

void UsdaWriter::write_poses(const AnimatedBody& body) {
    const std::string indent = "        ";
    const auto samples = [&](const char* name, const std::function<void(std::size_t)>& value) {
        out_ << indent << name << ".timeSamples = {\n";
        for (std::size_t k = 0; k < body.poses.size(); ++k) {
            out_ << indent << "    " << animation_.frames[k] << ": ";
            value(k);
            out_ << ",\n";
        }
        out_ << indent << "}\n";
    };
    samples("double3 xformOp:translate", [&](std::size_t k) {
        const Vec3& t = body.poses[k].translation;
        out_ << '(' << number_text(t.x()) << ", " << number_text(t.y()) << ", " << number_text(t.z()) << ')';
    });
    Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
    samples("quatd xformOp:orient", [&](std::size_t k) {
        Eigen::Quaterniond q = Eigen::Quaterniond(body.poses[k].rotation).normalized();
        if (q.dot(last) < 0)
            q.coeffs() = -q.coeffs();
        last = q;
        out_ << '(' << number_text(q.w()) << ", " << number_text(q.x()) << ", " << number_text(q.y()) << ", "
             << number_text(q.z()) << ')';
    });
    out_ << indent << "uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]\n";
}

void UsdaWriter::write_body(const AnimatedBody& body, const std::string& name) {
    const auto begin = [&](const char* indent, const char* type, const std::string& prim, bool named) {
        out_ << "\n" << indent << "def " << type << " \"" << prim << '"';
        if (named)
            out_ << " (\n" << indent << "    displayName = " << quoted(body.name) << "\n" << indent << ")";
        out_ << "\n" << indent << "{\n";
    };
    if (body.triangles.empty()) {
        begin("    ", "BasisCurves", name, true);
        write_fibres(body);
    } else if (body.poses.empty()) {
        begin("    ", "Mesh", name, true);
        write_surface(body, "        ");
    } else {
        begin("    ", "Xform", name, true);
        write_poses(body);
        begin("        ", "Mesh", "surface", false);
        write_surface(body, "            ");
        out_ << "        }\n";
    }
    out_ << "    }\n";
}

void UsdaWriter::write() {
    const double speed =
        animation_.frame_count() > 1 && animation_.seconds.back() > animation_.seconds.front()
            ? (animation_.frames.back() - animation_.frames.front()) /
                  (animation_.seconds.back() - animation_.seconds.front())
            : 24;
    const double metres = animation_.millimetres_per_unit > 0 ? animation_.millimetres_per_unit / 1000 : 1;
    if (!is_usda_scale(metres) || !is_usda_scale(speed))
        throw_error("USD",
                    "the unit is " + number_text(metres) + " m and a second has " + number_text(speed) +
                        " frames",
                    "numbers from 1e-9 to 1e9");
    const std::string root = unique_identifiers({animation_.name})[0];
    out_ << "#usda 1.0\n(\n    defaultPrim = \"" << root << "\"\n";
    out_ << "    doc = " << quoted(std::string("Written by fascicle ") + program_version()) << "\n";
    if (animation_.frame_count() > 0)
        out_ << "    endTimeCode = " << animation_.frames.back() << "\n";
    out_ << "    metersPerUnit = " << number_text(metres) << "\n";
    if (animation_.frame_count() > 0)
        out_ << "    startTimeCode = " << animation_.frames.front() << "\n";
    // Rounded: 1 / 0.01 s would come out as 99.99999999999999.
    out_ << "    timeCodesPerSecond = " << number_text(speed < 1 ? speed : std::round(speed * 1e6) / 1e6)
         << "\n";
    out_ << "    upAxis = \"" << (animation_.up == 'y' ? 'Y' : 'Z') << "\"\n)\n\n";
    out_ << "def Xform \"" << root << "\" (\n    displayName = " << quoted(animation_.name);
    if (!animation_.provenance.empty())
        out_ << "\n    customData = {\n        string fascicle = " << quoted(animation_.provenance)
             << "\n    }";
    out_ << "\n    kind = \"component\"\n)\n{";
    std::vector<std::string> names;
    for (const AnimatedBody& body : animation_.bodies)
        names.push_back(body.name);
    names = unique_identifiers(names);
    for (const AnimatedBody& body : animation_.bodies) {
        if (!body.triangles.empty() || !body.lines.empty())
            write_body(body, names[done_]);
        ++done_;
    }
    out_ << "}\n";
}

} // namespace

void write_usda(std::ostream& out, const Animation& animation, const JobControl& control) {
    UsdaWriter(out, animation, control).write();
}

void write_usda_mesh(std::ostream& out, const MeshData& data) {
    // Points alone would not be shown, and a stage without a prim is no mesh to read again.
    if (data.mesh.triangles.empty() && data.lines.lines.empty())
        throw_error("USD", "there is nothing to write", "a mesh with triangles or lines");
    Animation animation;
    animation.name = "mesh";
    animation.millimetres_per_unit = 0;
    animation.frames = {0};
    animation.seconds = {0};
    animation.bodies = bodies_of_mesh(data, BodyKind::muscle);
    write_usda(out, animation);
}

} // namespace fascicle::io
