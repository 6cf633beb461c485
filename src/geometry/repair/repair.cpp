#include "fascicle/geometry/repair/repair.hpp"

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/repair/taubin.hpp"
#include "fascicle/geometry/volume.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

std::string count(int n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string number(const char* format, double value) {
    std::array<char, 40> buffer;
    std::snprintf(buffer.data(), buffer.size(), format, value);
    std::string text = buffer.data();
    std::replace(text.begin(), text.end(), ',', '.'); // whatever the locale writes
    return text;
}

std::string percent(double share) {
    return number("%.3g", 100 * share) + " %";
}

SurfaceMeasures measure(const TriMesh& mesh, bool closed) {
    SurfaceMeasures out;
    std::vector<char> used(mesh.positions.size(), 0);
    for (const Tri& t : mesh.triangles)
        for (const int v : t)
            used[static_cast<std::size_t>(v)] = 1;
    out.vertices = static_cast<int>(std::count(used.begin(), used.end(), 1));
    out.triangles = mesh.triangle_count();
    out.area = surface_area(mesh.positions, mesh.triangles);
    out.closed = closed;
    out.volume = closed ? signed_volume(mesh.positions, mesh.triangles) : 0;
    return out;
}

constexpr std::size_t most_pairs = 1000; ///< of crossing triangles that are named

class Repairer {
public:
    Repairer(TriMesh mesh, const RepairOptions& options, const JobControl& control)
        : options_(options), control_(control), m_(std::move(mesh)) {}

    RepairResult run() {
        begin();
        // What filling and parting made may lie on something else in turn.
        constexpr int most_rounds = 4;
        for (int round = 0; round < most_rounds; ++round)
            if (!weld(round) || !part_and_close())
                break;
        tell_what_was_done();
        if (detail::closed_and_paired(m_.mesh))
            reshape();
        end();
        return std::move(result_);
    }

private:
    std::string length(const char* format, double value) const {
        return number(format, value) + (options_.unit.empty() ? "" : " ") + options_.unit;
    }
    void step(const char* key, int found, int done, const std::string& text) {
        if (found > 0 || done > 0)
            result_.steps.push_back({key, text, found, done});
    }

    void begin() {
        control_.checkpoint("check", 0);
        const int unusable = detail::drop_unusable(m_.mesh);
        // Places that no triangle uses may be anything; the rest of the program counts on numbers.
        for (Vec3& p : m_.mesh.positions)
            if (!p.allFinite())
                p.setZero();
        result_.before = check_mesh(m_.mesh);
        result_.measured_before = measure(m_.mesh, result_.before.closed());
        input_ = m_.mesh;
        step("unusable", unusable, unusable,
             count(unusable, "triangle without usable corners dropped",
                   "triangles without usable corners dropped"));
        if (const int unused = detail::drop_unused_vertices(m_); unused > 0)
            step("unused", unused, unused,
                 count(unused, "vertex without triangles dropped", "vertices without triangles dropped"));
    }

    /// Whether what follows has something to do: always in the first round.
    bool weld(int round) {
        control_.checkpoint("weld", 0.05 + 0.1 * round);
        if (round == 0) {
            mean_edge_ = detail::mean_edge_length(m_.mesh);
            tolerance_ = options_.weld >= 0 ? options_.weld : 1e-3 * mean_edge_;
        }
        const detail::WeldCounts now = detail::weld_and_drop_doubles(m_, tolerance_);
        weld_.welded += now.welded;
        weld_.repeated += now.repeated;
        weld_.doubled += now.doubled;
        weld_.back_to_back += now.back_to_back;
        return round == 0 || now.welded + now.repeated + now.doubled + now.back_to_back > 0;
    }

    /// Whether triangles or vertices are new.
    bool part_and_close() {
        control_.checkpoint("sheets", 0.2);
        orient();
        const detail::SheetCounts sheets = detail::part_sheets(m_);
        sheets_.edges += sheets.edges;
        sheets_.vertices += sheets.vertices;
        sheets_.middles += sheets.middles;
        control_.checkpoint("orientation", 0.35);
        orient();
        control_.checkpoint("islands", 0.45);
        const detail::IslandCounts islands = detail::drop_islands(m_, sheets.hanging, options_.island_share);
        islands_.sheets += islands.sheets;
        islands_.islands += islands.islands;
        control_.checkpoint("holes", 0.5);
        detail::FillCounts fill;
        if (options_.fill_edges > 0)
            fill = detail::fill_and_fair(m_, options_.fill_edges, options_.fill_share);
        fill_.holes = fill_.filled + fill.holes;
        fill_.filled += fill.filled;
        fill_.too_large = fill.too_large;
        fill_.triangles += fill.triangles;
        fill_.area += fill.area;
        islands_.flat += detail::drop_flat_parts(m_).flat;
        return sheets.vertices > 0 || sheets.middles > 0 || fill.filled > 0;
    }
    void orient() {
        const detail::OrientCounts now = detail::orient_outwards(m_);
        turned_.turned_triangles += now.turned_triangles;
        turned_.turned_parts += now.turned_parts;
    }

    void tell_what_was_done() {
        const auto say = [&](const char* key, int n, const char* one, const char* many,
                             const std::string& rest = {}) { step(key, n, n, count(n, one, many) + rest); };
        say("weld", weld_.welded, "border vertex welded to another", "border vertices welded to others",
            ", within " + length("%.3g", tolerance_));
        say("repeated", weld_.repeated, "triangle with a repeated vertex dropped",
            "triangles with a repeated vertex dropped");
        say("doubled", weld_.doubled, "doubled triangle dropped", "doubled triangles dropped");
        say("back_to_back", weld_.back_to_back, "triangle back to back on another dropped",
            "triangles back to back on others dropped");
        say("edges", sheets_.edges, "edge with more than two triangles parted into sheets",
            "edges with more than two triangles parted into sheets",
            sheets_.middles > 0
                ? ", with " + count(sheets_.middles, "new vertex", "new vertices") + " in their middles"
                : std::string());
        say("fans", sheets_.vertices, "copy of a vertex made, one for each of its fans",
            "copies of vertices made, one for each of their fans");
        say("orientation", turned_.turned_triangles, "triangle that faced the wrong way turned",
            "triangles that faced the wrong way turned");
        say("hanging", islands_.sheets, "sheet that hung on the surface dropped",
            "sheets that hung on the surface dropped");
        say("islands", islands_.islands, "island below ", "islands below ",
            percent(options_.island_share) + " of the largest part's area dropped");
        step("holes", fill_.holes, fill_.filled,
             fill_.filled == 0 ? count(fill_.holes, "hole left open", "holes left open")
                               : count(fill_.filled, "hole filled with ", "holes filled with ") +
                                     count(fill_.triangles, "triangle", "triangles") + ", " +
                                     percent(fill_.area / std::max(1e-300, surface_area(m_.mesh.positions,
                                                                                        m_.mesh.triangles))) +
                                     " of the area");
        say("flat", islands_.flat, "flat part that encloses nothing dropped",
            "flat parts that enclose nothing dropped");
    }

    void reshape() {
        control_.checkpoint("slivers", 0.6);
        const double shortest = 1e-3 * mean_edge_;
        const detail::SliverCounts slivers = detail::remove_slivers(m_, shortest);
        step("slivers", slivers.found, slivers.found - slivers.left,
             count(slivers.found, "triangle or edge without size", "triangles or edges without size") + ": " +
                 std::to_string(slivers.collapsed) + " collapsed, " + std::to_string(slivers.flipped) +
                 " flipped" +
                 (slivers.left > 0 ? ", " + std::to_string(slivers.left) + " left" : std::string()));
        smooth();
        resample();
        control_.checkpoint("separate", 0.85);
        const int moved = detail::separate_sheets(m_, 1e-4 * detail::mean_edge_length(m_.mesh));
        step("separate", moved, moved,
             count(moved, "vertex that lay on another sheet's moved off it by a thousandth of an edge",
                   "vertices that lay on those of other sheets moved off them by a thousandth of an edge"));
        control_.checkpoint("crossings", 0.88);
        crossings_ = find_crossings(m_.mesh, options_.threads, control_, most_pairs);
        if (options_.untangle && crossings_.pairs > 0) {
            const int before = crossings_.pairs;
            crossings_ = detail::untangle(m_, crossings_, options_.threads, control_);
            step("untangle", before, before - crossings_.pairs,
                 count(before, "pair of crossing triangles", "pairs of crossing triangles") + ", " +
                     std::to_string(before - crossings_.pairs) + " parted by smoothing around them");
        }
    }

    void smooth() {
        if (options_.smooth_passes <= 0)
            return;
        const double before = signed_volume(m_.mesh.positions, m_.mesh.triangles);
        TaubinOptions taubin;
        taubin.passes = options_.smooth_passes;
        taubin_smooth(m_.mesh, taubin, control_);
        const double after = signed_volume(m_.mesh.positions, m_.mesh.triangles);
        step("smooth", options_.smooth_passes, options_.smooth_passes,
             count(options_.smooth_passes, "pass", "passes") + " of smoothing, volume " +
                 number("%+.3g", before != 0 ? 100 * (after / before - 1) : 0) + " %");
    }

    void resample() {
        const double area = surface_area(m_.mesh.positions, m_.mesh.triangles);
        int wanted = options_.triangles;
        if (options_.edge_length > 0) {
            // As many equilateral triangles of that side as cover the area.
            const double fit = 4 / std::sqrt(3.0) * area / (options_.edge_length * options_.edge_length);
            constexpr double most = 2e7;
            if (!(fit <= most))
                throw_error("repair",
                            "edges of " + length("%.3g", options_.edge_length) +
                                " make more than 20 million triangles",
                            "a larger edge length");
            wanted = std::max(4, static_cast<int>(std::lround(fit)));
        }
        if (wanted <= 0)
            return;
        control_.checkpoint("remesh", 0.65);
        const int before = m_.mesh.triangle_count();
        const detail::ResampleCounts counts =
            detail::resample(m_, input_, wanted, options_.threads, control_);
        const double change = counts.volume_before != 0 ? counts.volume_after / counts.volume_before - 1 : 0;
        step("remesh", before, before,
             "remeshed to " + count(m_.mesh.triangle_count(), "triangle", "triangles") + " with edges of " +
                 length("%.4g", counts.edge_length) +
                 (std::abs(change) < 5e-7 ? ", volume kept by"
                                          : ", volume " + number("%+.2g", 100 * change) + " % after") +
                 " an offset by " + length("%.3g", counts.offset));
        if (!(std::abs(change) <= options_.volume_share))
            result_.reason = "remeshing changed the volume by " + percent(std::abs(change)) + ", more than " +
                             percent(options_.volume_share);
    }

    void end() {
        control_.checkpoint("check", 0.95);
        const detail::OrientCounts last = detail::orient_outwards(m_);
        const int parts = turned_.turned_parts + last.turned_parts;
        step("outwards", parts, parts,
             count(parts, "part that was inside out turned", "parts that were inside out turned"));
        detail::drop_unused_vertices(m_);
        result_.after = check_mesh(m_.mesh);
        result_.measured_after = measure(m_.mesh, result_.after.closed());
        result_.crossings = crossings_.pairs;
        result_.first_crossings = crossings_.first;
        tell_what_is_left();
        if (result_.reason.empty())
            result_.reason = why_not();
        result_.mesh = std::move(m_.mesh);
        result_.origins = std::move(m_.origins);
        result_.new_of_old = std::move(m_.now);
        control_.checkpoint("done", 1);
    }

    void tell_what_is_left() {
        const MeshReport& r = result_.after;
        if (crossings_.pairs > 0)
            result_.left.push_back(
                (crossings_.complete ? "" : "at least ") +
                count(crossings_.pairs, "pair of triangles crosses", "pairs of triangles cross") +
                ", the first are triangles " + std::to_string(crossings_.first[0][0]) + " and " +
                std::to_string(crossings_.first[0][1]));
        if (r.zero_area_triangles > 0)
            result_.left.push_back(
                count(r.zero_area_triangles, "triangle of no area", "triangles of no area"));
        if (r.components > 1)
            result_.left.push_back("the surface has " + std::to_string(r.components) + " parts");
        if (r.cavities > 0)
            result_.left.push_back(count(r.cavities, "cavity inside", "cavities inside"));
    }

    std::string why_not() const {
        const MeshReport& r = result_.after;
        if (r.triangles == 0)
            return "no surface is left that encloses anything";
        if (r.non_orientable_patches > 0)
            return "the surface has " + count(r.non_orientable_patches, "part", "parts") +
                   " without an inside and an outside, as a Moebius strip";
        if (r.boundary_edges > 0) {
            std::string text = "the surface has " + count(r.holes, "hole", "holes") + " that " +
                               (r.holes == 1 ? "was" : "were") + " not filled (" +
                               count(r.boundary_edges, "edge", "edges") + " in all)";
            if (fill_.too_large > 0)
                text += ", " + std::to_string(fill_.too_large) + " larger than " +
                        percent(options_.fill_share) + " of its part";
            return text;
        }
        if (r.nonmanifold_edges > 0 || r.nonmanifold_vertices > 0 || !r.closed())
            return "the surface does not close at " +
                   count(std::max(r.unbalanced_edges, r.nonmanifold_edges), "edge", "edges");
        if (!(result_.measured_after.volume > 0))
            return "the surface encloses no volume";
        return {};
    }

    const RepairOptions& options_;
    const JobControl& control_;
    detail::RepairMesh m_;
    TriMesh input_; ///< its usable triangles
    RepairResult result_;
    double mean_edge_ = 0, tolerance_ = 0;
    detail::WeldCounts weld_;
    detail::SheetCounts sheets_;
    detail::IslandCounts islands_;
    detail::OrientCounts turned_;
    detail::FillCounts fill_;
    CrossingReport crossings_;
};

} // namespace

RepairResult repair(TriMesh mesh, const RepairOptions& options, const JobControl& control) {
    if (options.triangles > 0 && options.edge_length > 0)
        throw_error("repair", "both an edge length and a number of triangles", "one of them");
    if (options.fill_edges > RepairOptions::longest_hole)
        throw_error("repair", "holes of up to " + std::to_string(options.fill_edges) + " edges",
                    "at most " + std::to_string(RepairOptions::longest_hole));
    return Repairer(std::move(mesh), options, control).run();
}

} // namespace fascicle
