#include "io/formats/usda_read.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "io/formats/mesh_bodies.hpp"
#include "io/formats/usda_parser.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace fascicle::io {

namespace {

using Chain = std::vector<const UsdaPrim*>; ///< a prim and those around it, outermost first

class UsdaReader {
public:
    UsdaReader(std::string_view bytes, const std::string& file)
        : file_(file), scanner_(bytes, file), layer_(std::make_shared<UsdaLayer>(parse_usda(bytes, file))) {}
    Animation read();

private:
    void walk(const UsdaPrim& prim, Chain& chain);
    void add_body(const UsdaPrim& prim, const Chain& chain);
    void read_faces(const UsdaPrim& prim, std::size_t points, AnimatedBody& body) const;
    void read_curves(const UsdaPrim& prim, std::size_t points, AnimatedBody& body) const;
    std::vector<int> whole_numbers(const UsdaPrim& prim, const char* name) const;
    double number_of(const char* key, double otherwise) const;
    double scale_of(const char* key, double otherwise) const;
    void note_times(const UsdaAttribute& attribute) {
        for (const auto& [time, value] : attribute.samples)
            times_.insert(time);
    }

    std::string file_;
    TextScanner scanner_;
    std::shared_ptr<const UsdaLayer> layer_;
    Animation animation_;
    std::set<double> times_;
    std::set<std::string> foreign_;
    std::shared_ptr<std::vector<double>> codes_ =
        std::make_shared<std::vector<double>>(); ///< time of each frame
};

/// Values at a time: linear between two samples, held before the first and after the last.
std::vector<double> numbers_at(const UsdaAttribute& attribute, double time) {
    if (attribute.samples.empty())
        return attribute.value.numbers;
    const auto after = attribute.samples.upper_bound(time);
    if (after == attribute.samples.begin())
        return after->second.numbers;
    const auto before = std::prev(after);
    if (after == attribute.samples.end() || before->first == time)
        return before->second.numbers;
    std::vector<double> out = before->second.numbers;
    const std::vector<double>& next = after->second.numbers;
    const double share = (time - before->first) / (after->first - before->first);
    double along = 0;
    const bool turn = attribute.type == "quatd" || attribute.type == "quatf" || attribute.type == "quath";
    for (std::size_t i = 0; turn && i < std::min(out.size(), next.size()); ++i)
        along += out[i] * next[i];
    for (std::size_t i = 0; i < std::min(out.size(), next.size()); ++i)
        out[i] += share * ((along < 0 ? -next[i] : next[i]) - out[i]);
    return out;
}

const UsdaAttribute* find(const UsdaPrim& prim, const std::string& name) {
    const auto found = prim.attributes.find(name);
    return found == prim.attributes.end() ? nullptr : &found->second;
}

/// Place of a prim in the one around it. `fail` is told what is not known.
Eigen::Affine3d local_place(const UsdaPrim& prim, double time,
                            const std::function<void(const std::string&)>& fail) {
    Eigen::Affine3d place = Eigen::Affine3d::Identity();
    const UsdaAttribute* order = find(prim, "xformOpOrder");
    if (order == nullptr)
        return place;
    for (const std::string& op : order->value.texts) {
        const UsdaAttribute* attribute = find(prim, op);
        const std::vector<double> v =
            attribute == nullptr ? std::vector<double>{} : numbers_at(*attribute, time);
        const std::string kind = op.substr(0, op.find(':', 8));
        const auto want = [&](std::size_t count) {
            if (v.size() != count ||
                !std::all_of(v.begin(), v.end(), [](double x) { return std::abs(x) < 1e30; }))
                fail("the transform " + shown(op) + " of " + shown(prim.name) + " has bad numbers");
        };
        const double degree = std::numbers::pi / 180;
        const auto about = [&](int axis, double degrees) {
            place = place * Eigen::AngleAxisd(degrees * degree, Vec3::Unit(axis));
        };
        if (kind == "xformOp:translate") {
            want(3);
            place = place * Eigen::Translation3d(v[0], v[1], v[2]);
        } else if (kind == "xformOp:scale") {
            want(3);
            place = place * Eigen::Scaling(v[0], v[1], v[2]);
        } else if (kind == "xformOp:orient") {
            want(4);
            const Eigen::Quaterniond q(v[0], v[1], v[2], v[3]);
            if (!(q.norm() > 1e-6))
                fail("the turn of " + shown(prim.name) + " is none");
            place = place * q.normalized();
        } else if (kind == "xformOp:rotateX" || kind == "xformOp:rotateY" || kind == "xformOp:rotateZ") {
            want(1);
            about(kind.back() - 'X', v[0]);
        } else if (kind == "xformOp:rotateXYZ") { // x first: the last of the product
            want(3);
            about(2, v[2]), about(1, v[1]), about(0, v[0]);
        } else if (kind == "xformOp:transform") { // rows are what vectors are multiplied with from the left
            want(16);
            Eigen::Affine3d m = Eigen::Affine3d::Identity();
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 4; ++column)
                    m.matrix()(row, column) = v[static_cast<std::size_t>(4 * column + row)];
            place = place * m;
        } else {
            fail("the transform " + shown(op) + " is not known");
        }
    }
    return place;
}

double UsdaReader::number_of(const char* key, double otherwise) const {
    const auto found = layer_->metadata.find(key);
    return found != layer_->metadata.end() && found->second.numbers.size() == 1 &&
                   std::isfinite(found->second.numbers[0]) && found->second.numbers[0] > 0
               ? found->second.numbers[0]
               : otherwise;
}

/// The same of one that others are multiplied with or divided by.
double UsdaReader::scale_of(const char* key, double otherwise) const {
    const double value = number_of(key, otherwise);
    if (!is_usda_scale(value))
        throw_error(file_, std::string(key) + " is " + number_text(value), "a number from 1e-9 to 1e9");
    return value;
}

std::vector<int> UsdaReader::whole_numbers(const UsdaPrim& prim, const char* name) const {
    std::vector<int> out;
    const UsdaAttribute* attribute = find(prim, name);
    if (attribute == nullptr)
        return out;
    if (!attribute->samples.empty())
        scanner_.fail_at(attribute->place, std::string(name) + " changes with time",
                         "one surface for all frames");
    for (const double value : attribute->value.numbers) {
        if (!(value >= 0 && value < double(max_elements) && value == std::floor(value)))
            scanner_.fail_at(attribute->place, std::string(name) + " has a bad number",
                             "whole numbers from 0");
        out.push_back(static_cast<int>(value));
    }
    return out;
}

void UsdaReader::read_faces(const UsdaPrim& prim, std::size_t points, AnimatedBody& body) const {
    const std::vector<int> counts = whole_numbers(prim, "faceVertexCounts"),
                           corners = whole_numbers(prim, "faceVertexIndices");
    const UsdaAttribute* orientation = find(prim, "orientation");
    const bool left =
        orientation != nullptr && orientation->value.texts == std::vector<std::string>{"leftHanded"};
    for (const int corner : corners)
        if (static_cast<std::size_t>(corner) >= points)
            scanner_.fail_at(prim.place, "vertex " + std::to_string(corner) + " is out of range",
                             "0 to " + std::to_string(points) + " - 1");
    std::size_t at = 0;
    for (const int count : counts) {
        const auto n = static_cast<std::size_t>(count);
        if (n > corners.size() - at)
            scanner_.fail_at(prim.place, "faceVertexCounts asks for more than faceVertexIndices has",
                             "as many");
        for (std::size_t i = 1; i + 1 < n; ++i) {
            Tri t{corners[at], corners[at + i], corners[at + i + 1]};
            if (left)
                std::swap(t[1], t[2]);
            body.triangles.push_back(t);
        }
        at += n;
    }
}

void UsdaReader::read_curves(const UsdaPrim& prim, std::size_t points, AnimatedBody& body) const {
    std::size_t at = 0;
    for (const int count : whole_numbers(prim, "curveVertexCounts")) {
        const auto n = static_cast<std::size_t>(count);
        if (n > points - at)
            scanner_.fail_at(prim.place, "curveVertexCounts asks for more than points has", "as many");
        std::vector<int> line;
        for (std::size_t i = 0; i < n; ++i)
            line.push_back(static_cast<int>(at + i));
        if (n > 1) // one point is no line
            body.lines.push_back(std::move(line));
        at += n;
    }
}

void UsdaReader::add_body(const UsdaPrim& prim, const Chain& chain) {
    const UsdaAttribute* attribute = find(prim, "points");
    if (attribute == nullptr)
        return;
    const auto check = [&](const UsdaValue& value) {
        if (value.numbers.size() % 3 != 0 || value.numbers.size() / 3 > max_elements)
            scanner_.fail_at(attribute->place,
                             "points has " + std::to_string(value.numbers.size()) + " numbers",
                             "three a point");
        for (const double x : value.numbers)
            if (!std::isfinite(x))
                scanner_.fail_at(attribute->place, "points has a coordinate that is not finite",
                                 "finite coordinates");
        return value.numbers.size();
    };
    const std::size_t numbers =
        attribute->samples.empty() ? check(attribute->value) : check(attribute->samples.begin()->second);
    for (const auto& [time, value] : attribute->samples)
        if (check(value) != numbers)
            scanner_.fail_at(attribute->place, "the number of points changes with time",
                             "the same points in all frames");
    if (numbers == 0)
        return;
    AnimatedBody body;
    const UsdaPrim& named = chain.size() > 2 && prim.metadata.count("displayName") == 0 &&
                                    chain[chain.size() - 2]->children.size() == 1
                                ? *chain[chain.size() - 2]
                                : prim;
    const auto display = named.metadata.find("displayName");
    body.name = display != named.metadata.end() && display->second.texts.size() == 1
                    ? display->second.texts[0]
                    : named.name;
    if (prim.type == "Mesh")
        read_faces(prim, numbers / 3, body);
    else
        read_curves(prim, numbers / 3, body);
    body.kind = prim.type != "Mesh"          ? BodyKind::fibres
                : attribute->samples.empty() ? BodyKind::bone
                                             : BodyKind::muscle;
    note_times(*attribute);
    for (const UsdaPrim* around : chain)
        for (const auto& [name, op] : around->attributes)
            if (name.rfind("xformOp:", 0) == 0)
                note_times(op);
    body.points = [layer = layer_, codes = codes_, attribute, chain, file = file_](std::size_t k,
                                                                                   Points& points) {
        const double time = (*codes)[k];
        const std::vector<double> numbers_then = numbers_at(*attribute, time);
        points.resize(numbers_then.size() / 3);
        for (std::size_t i = 0; i < points.size(); ++i)
            points[i] = Vec3(numbers_then[3 * i], numbers_then[3 * i + 1], numbers_then[3 * i + 2]);
        Eigen::Affine3d place = Eigen::Affine3d::Identity();
        for (const UsdaPrim* around : chain)
            place = place * local_place(*around, time, [&](const std::string& what) {
                        throw_error(file, what, "transforms as UsdGeom has them");
                    });
        if (!(place.matrix().cwiseAbs().maxCoeff() < 1e100))
            throw_error(file, "a prim is placed out of all range", "finite places");
        if (!place.matrix().isIdentity(0))
            for (Vec3& p : points)
                p = place * p;
        want_finite(points, file);
    };
    animation_.bodies.push_back(std::move(body));
}

void UsdaReader::walk(const UsdaPrim& prim, Chain& chain) {
    chain.push_back(&prim);
    if (prim.type == "Mesh" || prim.type == "BasisCurves")
        add_body(prim, chain);
    else if (!prim.type.empty() && prim.type != "Xform" && prim.type != "Scope")
        foreign_.insert(prim.type);
    for (const auto& child : prim.children)
        walk(*child, chain);
    chain.pop_back();
}

Animation UsdaReader::read() {
    animation_.millimetres_per_unit = 1000 * scale_of("metersPerUnit", 0.01); // USD's own default
    const auto up = layer_->metadata.find("upAxis");
    animation_.up =
        up != layer_->metadata.end() && up->second.texts == std::vector<std::string>{"Z"} ? 'z' : 'y';
    Chain chain;
    for (const auto& prim : layer_->prims) {
        if (animation_.name.empty()) {
            const auto display = prim->metadata.find("displayName");
            animation_.name = display != prim->metadata.end() && display->second.texts.size() == 1
                                  ? display->second.texts[0]
                                  : prim->name;
            if (const auto about = prim->metadata.find("customData");
                about != prim->metadata.end() && about->second.texts.size() == 1)
                animation_.provenance = about->second.texts[0];
        }
        walk(*prim, chain);
    }
    if (animation_.bodies.empty())
        throw_error(file_, "it holds no mesh and no curves", "a Mesh or BasisCurves with points");
    codes_->assign(times_.begin(), times_.end());
    if (codes_->empty())
        codes_->push_back(number_of("startTimeCode", 0));
    bool whole = true;
    const double speed = scale_of("timeCodesPerSecond", 24);
    for (const double code : *codes_) {
        whole = whole && code == std::floor(code) && code >= 0 && code < 1e9;
        const double seconds = code / speed;
        if (!std::isfinite(seconds) ||
            (!animation_.seconds.empty() && !(seconds > animation_.seconds.back())))
            throw_error(file_, "the times of its samples are too large or too close", "ascending seconds");
        animation_.seconds.push_back(seconds);
    }
    for (std::size_t k = 0; k < codes_->size(); ++k)
        animation_.frames.push_back(static_cast<int>(whole ? (*codes_)[k] : static_cast<double>(k)));
    for (AnimatedBody& body : animation_.bodies)
        body.points(0, body.rest);
    for (const std::string& type : foreign_) {
        animation_.notes.push_back("Prims of the type " + shown(type) + " are passed over.");
        if (animation_.notes.size() == 10)
            break;
    }
    return std::move(animation_);
}

} // namespace

bool looks_like_usda(std::string_view bytes) {
    return trimmed(bytes.substr(0, 4096)).substr(0, 5) == "#usda";
}

Animation read_usda(std::string_view bytes, const std::string& file) {
    return UsdaReader(bytes, file).read();
}

MeshData read_usda_mesh(std::string_view bytes, const std::string& file) {
    return first_frame(read_usda(bytes, file));
}

} // namespace fascicle::io
