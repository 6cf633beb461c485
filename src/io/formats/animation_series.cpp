#include "io/formats/animation_series.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "io/formats/obj_bodies.hpp"
#include "io/formats/point_cache.hpp"
#include "io/formats/pvd.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/vtp.hpp"
#include "io/run_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fascicle::io {
namespace fs = std::filesystem;

namespace {

std::string numbered(const std::string& name, int frame, const char* extension) {
    char number[32];
    std::snprintf(number, sizeof number, "_%04d%s", frame, extension);
    return name + number;
}

std::vector<std::string> body_files(const Animation& animation) {
    std::vector<std::string> names;
    for (const AnimatedBody& body : animation.bodies)
        names.push_back(body.name);
    return unique_file_names(names);
}

double share(std::size_t done, std::size_t all) {
    return static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(1, all));
}

/// "hip_0012.obj": what stands before and behind the digits; no digits: not of a series.
struct Numbered {
    std::string before, digits;
    explicit Numbered(const fs::path& path) {
        const std::string stem = path.stem().string();
        std::size_t begin = stem.size();
        while (begin > 0 && stem[begin - 1] >= '0' && stem[begin - 1] <= '9' && stem.size() - begin < 9)
            --begin;
        before = stem.substr(0, begin);
        digits = stem.substr(begin);
    }
};

/// Number and file of every member of the series, ascending.
std::vector<std::pair<int, fs::path>> series_of(const fs::path& path) {
    const Numbered own(path);
    std::vector<std::pair<int, fs::path>> out;
    if (own.digits.empty())
        return out;
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const fs::path other = it->path().filename();
        const Numbered name(other);
        if (other.extension() == path.extension() && name.before == own.before && !name.digits.empty() &&
            it->is_regular_file(error))
            out.emplace_back(std::stoi(name.digits), path.has_parent_path() ? folder / other : other);
    }
    std::sort(out.begin(), out.end());
    return out;
}

bool same_topology(const AnimatedBody& a, const AnimatedBody& b) {
    return a.rest.size() == b.rest.size() && a.triangles == b.triangles && a.lines == b.lines;
}

} // namespace

void write_obj_series(const fs::path& folder, const Animation& animation, const AnimationOptions&,
                      const JobControl& control) {
    const std::string name = unique_file_names({animation.name})[0];
    for (std::size_t k = 0; k < animation.frame_count(); ++k) {
        control.checkpoint("writing", share(k, animation.frame_count()));
        AtomicFile file(folder / numbered(name, animation.frames[k], ".obj"));
        write_obj_bodies(file.stream(), animation, k);
        file.commit();
    }
}

bool is_obj_series(const fs::path& path) {
    return lower_case(path.extension().string()) == ".obj" && series_of(path).size() > 1;
}

Animation read_obj_series(const fs::path& path) {
    const std::vector<std::pair<int, fs::path>> files = series_of(path);
    if (files.empty())
        throw_error(path.string(), "not one of a numbered series of OBJ files", "NAME_0000.obj");
    Animation out = read_obj_bodies(read_file(files[0].second), files[0].second.string());
    out.name = Numbered(path).before;
    while (!out.name.empty() && (out.name.back() == '_' || out.name.back() == '.'))
        out.name.pop_back();
    out.frames.clear();
    out.seconds.clear();
    for (const auto& [number, file] : files) {
        if (!out.frames.empty() && number == out.frames.back())
            throw_error(file.string(), "there are two files of number " + std::to_string(number),
                        "one of each");
        const Animation then = read_obj_bodies(read_file(file), file.string());
        out.frames.push_back(number);
        out.seconds.push_back(then.seconds[0]);
        if (out.seconds.size() > 1 && !(out.seconds.back() > out.seconds[out.seconds.size() - 2]))
            throw_error(file.string(), "its time is not after that of the file before", "ascending times");
        bool same = then.bodies.size() == out.bodies.size();
        for (std::size_t b = 0; same && b < out.bodies.size(); ++b)
            same = same_topology(out.bodies[b], then.bodies[b]);
        if (!same)
            throw_error(file.string(),
                        "its points, faces or lines are not those of " + files[0].second.filename().string(),
                        "a series whose points alone move");
    }
    // Files are read again when they are asked for: a long series would not fit.
    for (std::size_t b = 0; b < out.bodies.size(); ++b) {
        AnimatedBody& body = out.bodies[b];
        body.poses.clear();
        body.points = [files, b, count = body.rest.size()](std::size_t k, Points& points) {
            Animation then = read_obj_bodies(read_file(files[k].second), files[k].second.string());
            if (b >= then.bodies.size() || then.bodies[b].rest.size() != count)
                throw_error(files[k].second.string(), "the file has changed while it was read");
            points = std::move(then.bodies[b].rest);
        };
    }
    return out;
}

void write_vtp_series(const fs::path& folder, const Animation& animation, const AnimationOptions&,
                      const JobControl& control) {
    const std::vector<std::string> names = body_files(animation);
    std::vector<std::vector<std::pair<double, std::string>>> series(names.size());
    Points points;
    MeshStamp stamp;
    if (animation.millimetres_per_unit > 0)
        stamp.hints.millimetres = animation.millimetres_per_unit;
    stamp.up = animation.up;
    for (std::size_t k = 0; k < animation.frame_count(); ++k)
        for (std::size_t b = 0; b < names.size(); ++b) {
            control.checkpoint("writing",
                               share(k * names.size() + b, animation.frame_count() * names.size()));
            const AnimatedBody& body = animation.bodies[b];
            points_in_frame(body, k, points);
            MeshData data;
            if (!body.lines.empty())
                data.lines = {points, body.lines};
            if (!body.triangles.empty() || body.lines.empty())
                data.mesh = {points, body.triangles};
            const std::string name = numbered(names[b], animation.frames[k], ".vtp");
            write_stamped_file(folder / name, data, stamp);
            series[b].emplace_back(animation.seconds[k], name);
        }
    for (std::size_t b = 0; b < names.size(); ++b) {
        AtomicFile file(folder / (names[b] + ".pvd"));
        write_pvd(file.stream(), series[b]);
        file.commit();
    }
}

Animation read_vtp_series(const fs::path& path) {
    const std::string text = read_file(path, std::size_t{64} << 20);
    const std::vector<std::pair<double, std::string>> steps = read_pvd(text, path.string());
    Animation out;
    out.name = path.stem().string();
    out.millimetres_per_unit = 0;
    std::vector<fs::path> files;
    if (steps.empty())
        throw_error(path.string(), "the series names no files", "DataSet elements");
    for (const auto& [time, name] : steps) {
        const fs::path file = name;
        if (file.is_absolute() || std::find(file.begin(), file.end(), "..") != file.end())
            throw_error(path.string(), "the file " + shown(name) + " is not below the series' folder",
                        "a relative name");
        if (!out.seconds.empty() && !(time > out.seconds.back()))
            throw_error(path.string(), "the time of " + shown(name) + " is not after the one before",
                        "ascending times, one part each");
        files.push_back(path.parent_path() / file);
        out.seconds.push_back(time);
    }
    bool numbers = true; // the numbers of the files' names, where they rise
    for (std::size_t k = 0; k < files.size(); ++k) {
        const Numbered name(files[k]);
        const int number = name.digits.empty() ? -1 : std::stoi(name.digits);
        numbers = numbers && number >= 0 && (k == 0 || number > out.frames.back());
        out.frames.push_back(number);
    }
    for (std::size_t k = 0; k < files.size() && !numbers; ++k)
        out.frames[k] = static_cast<int>(k);
    const auto read = [](const fs::path& file) {
        const std::string bytes = read_file(file);
        const MeshFormat* format = recognise_format(bytes, file);
        if (format == nullptr)
            throw_error(file.string(), "the file is of no known format", "VTP");
        MeshData data = format->read(bytes, file.string());
        AnimatedBody body;
        body.rest =
            data.mesh.positions.empty() ? std::move(data.lines.points) : std::move(data.mesh.positions);
        body.triangles = std::move(data.mesh.triangles);
        body.lines = std::move(data.lines.lines);
        if (body.rest.empty())
            throw_error(file.string(), "the file holds no points", "a mesh");
        return body;
    };
    const MeshStamp stamp =
        find_mesh_stamp(read_file(files[0])); // of all: one series, one frame of reference
    out.millimetres_per_unit = stamp.hints.millimetres.value_or(0);
    out.up = stamp.up.value_or('z');
    AnimatedBody body = read(files[0]);
    body.name = out.name;
    body.kind = body.triangles.empty() ? BodyKind::fibres : BodyKind::muscle;
    AnimatedBody first = body;
    body.points = [files, read, first](std::size_t k, Points& points) {
        AnimatedBody then = read(files[k]);
        if (!same_topology(first, then))
            throw_error(files[k].string(),
                        "its points, faces or lines are not those of " + files[0].filename().string(),
                        "a series whose points alone move");
        points = std::move(then.rest);
    };
    out.bodies.push_back(std::move(body));
    return out;
}

namespace {

using WriteCache = void (*)(std::ostream&, const AnimatedBody&, const Animation&, const JobControl&,
                            const std::string&);

void write_caches(const fs::path& folder, const Animation& animation, const JobControl& control,
                  const char* extension, WriteCache write) {
    if (!evenly_spaced(animation.frames))
        throw_error(folder.string(), "the frames are not at equal distances, which the format cannot say",
                    "frames in equal steps");
    const std::vector<std::string> names = body_files(animation);
    for (std::size_t b = 0; b < names.size(); ++b) {
        control.checkpoint("writing", share(b, names.size()));
        const AnimatedBody& body = animation.bodies[b];
        Animation alone;
        alone.name = animation.name;
        alone.millimetres_per_unit = animation.millimetres_per_unit;
        alone.up = animation.up;
        alone.frames = animation.frames;
        alone.seconds = animation.seconds;
        alone.bodies = {body};
        AtomicFile mesh(folder / (names[b] + ".obj"));
        write_obj_bodies(mesh.stream(), alone, 0);
        mesh.commit();
        const bool still =
            !body.poses.empty() && std::all_of(body.poses.begin(), body.poses.end(), [&](const Pose& pose) {
                return pose.rotation == body.poses[0].rotation &&
                       pose.translation == body.poses[0].translation;
            });
        if (still)
            continue;
        const JobControl part{[&](std::string_view stage, double done) {
                                  if (control.report)
                                      control.report(stage, (static_cast<double>(b) + done) /
                                                                static_cast<double>(names.size()));
                              },
                              control.cancel};
        const fs::path path = folder / (names[b] + extension);
        AtomicFile cache(path);
        write(cache.stream(), body, animation, part, shown_path(path));
        cache.commit();
    }
}

Animation read_cache(const fs::path& path, PointCache (*read)(std::string_view, const std::string&)) {
    const auto bytes = std::make_shared<const std::string>(read_file(path));
    const PointCache cache = read(*bytes, path.string());
    fs::path mesh = path;
    mesh.replace_extension(".obj");
    std::error_code error;
    if (!fs::exists(mesh, error))
        throw_error(path.string(),
                    "there is no " + mesh.filename().string() + " beside it, which has the triangles",
                    "an OBJ of the same name");
    const std::string text = read_file(mesh);
    Animation out = read_obj_bodies(text, mesh.string());
    if (out.bodies.size() != 1 || out.bodies[0].rest.size() != cache.points)
        throw_error(path.string(),
                    std::to_string(cache.points) + " points, but " + mesh.filename().string() + " has " +
                        std::to_string(out.bodies[0].rest.size()) +
                        (out.bodies.size() > 1 ? " in the first of its objects" : ""),
                    "as many, in one object");
    AnimatedBody& body = out.bodies[0];
    body.poses.clear();
    body.points = [bytes, cache, file = path.string()](std::size_t k, Points& points) {
        cache.read(k, points, file);
    };
    body.points(0, body.rest);
    out.name = path.stem().string();
    // Frames of PC2 are numbers alone: their time is what our OBJ says of a step, else a frame counts as a second. MDD has times alone.
    const std::string_view head = std::string_view(text).substr(0, 4096);
    double step_frames = 1, step_seconds = 1;
    if (const std::size_t at = head.find("# frame step "); at != std::string_view::npos) {
        double frames = 0, seconds = 0;
        TextScanner scanner(head.substr(at + 13, head.find('\n', at) - at - 13), mesh.string());
        if (to_double(scanner.next_word(), frames) == NumberCheck::ok && scanner.next_word() == "of" &&
            to_double(scanner.next_word(), seconds) == NumberCheck::ok && frames > 0 && frames < 1e6 &&
            seconds > 0 && seconds < 1e6)
            step_frames = frames, step_seconds = seconds;
    }
    const double start = cache.seconds.empty() ? cache.first_frame : out.frames[0];
    const double step = cache.seconds.empty() ? cache.frame_step : step_frames;
    const double first_second = out.seconds[0];
    out.frames.clear();
    out.seconds.clear();
    bool whole = true;
    for (std::size_t k = 0; k < cache.samples; ++k) {
        const double frame = start + static_cast<double>(k) * step;
        whole = whole && frame == std::floor(frame) && frame >= 0 && frame < 1e9;
        out.frames.push_back(whole ? static_cast<int>(frame) : 0);
        out.seconds.push_back(!cache.seconds.empty() ? cache.seconds[k]
                                                     : first_second + static_cast<double>(k) * step *
                                                                          step_seconds / step_frames);
    }
    for (std::size_t k = 0; k < cache.samples && !whole; ++k)
        out.frames[k] = static_cast<int>(k);
    return out;
}

} // namespace

void write_pc2_files(const fs::path& folder, const Animation& animation, const AnimationOptions&,
                     const JobControl& control) {
    write_caches(folder, animation, control, ".pc2", write_pc2);
}

void write_mdd_files(const fs::path& folder, const Animation& animation, const AnimationOptions&,
                     const JobControl& control) {
    write_caches(folder, animation, control, ".mdd", write_mdd);
}

Animation read_pc2_file(const fs::path& path) {
    return read_cache(path, read_pc2);
}

Animation read_mdd_file(const fs::path& path) {
    return read_cache(path, read_mdd);
}

} // namespace fascicle::io
