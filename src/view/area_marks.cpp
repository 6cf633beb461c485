#include "view/area_marks.hpp"

#include "view/attachment_marks.hpp"
#include "view/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace fascicle::view {

namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

render::Vec3f narrow(const Vec3& p) {
    return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

render::Rgba mixed(const render::Rgba& a, const render::Rgba& b, float share) {
    return {a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share, a[2] + (b[2] - a[2]) * share, a[3]};
}

/// The bits that differ, as vertices.
void differing(const SurfaceRegion& a, const SurfaceRegion& b, std::vector<int>& vertices) {
    ((a - b) | (b - a)).for_each([&](int v) { vertices.push_back(v); });
}

std::uint64_t edge_key(int a, int b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
}

} // namespace

AreaMarks::AreaMarks(MeshPtr mesh) : mesh_(std::move(mesh)) {
    starts_.assign(mesh_->positions.size() + 1, 0);
    for (const Tri& t : mesh_->triangles)
        for (const int v : t)
            ++starts_[z(v) + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i)
        starts_[i] += starts_[i - 1];
    around_.resize(z(starts_.back()));
    std::vector<int> next = starts_;
    for (std::size_t t = 0; t < mesh_->triangles.size(); ++t)
        for (const int v : mesh_->triangles[t])
            around_[z(next[z(v)]++)] = static_cast<int>(t);
    double edges = 0;
    const std::size_t step = mesh_->triangles.size() / 2000 + 1; // a sample tells the size of the triangles
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh_->triangles.size(); t += step, ++count)
        edges += (mesh_->positions[z(mesh_->triangles[t][0])] - mesh_->positions[z(mesh_->triangles[t][1])])
                     .norm();
    dash_ = count > 0 ? 2.5 * edges / double(count) : 1.0;
    points_ = std::make_shared<const std::vector<render::Vec3f>>();
    point_colours_ = std::make_shared<const std::vector<render::Rgba>>();
}

void AreaMarks::update(int bone, const std::vector<ShownArea>& areas,
                       const std::vector<BoneHighlight>& highlights, const render::Rgba& base) {
    std::vector<const ShownArea*> own;
    for (const ShownArea& shown : areas)
        if (shown.area.bone == bone && shown.area.vertices.vertex_count() == mesh_->vertex_count())
            own.push_back(&shown);
    std::vector<int> lit;
    render::Rgba lit_colour{};
    for (const BoneHighlight& highlight : highlights)
        if (highlight.bone == bone) {
            lit.insert(lit.end(), highlight.vertices.begin(), highlight.vertices.end());
            lit_colour = highlight.colour;
        }
    std::erase_if(lit, [&](int v) { return v < 0 || v >= mesh_->vertex_count(); });
    std::sort(lit.begin(), lit.end());
    lit.erase(std::unique(lit.begin(), lit.end()), lit.end());

    std::vector<int> changed;
    bool borders = own.size() != layers_.size();
    const auto same_place = [](const ShownArea& a, const ShownArea& b) {
        return a.muscle == b.muscle && a.area.kind == b.area.kind && a.area.head == b.area.head;
    };
    std::vector<Layer> layers;
    for (std::size_t i = 0; i < own.size(); ++i) {
        const auto old = std::find_if(layers_.begin(), layers_.end(),
                                      [&](const Layer& layer) { return same_place(layer.shown, *own[i]); });
        borders = borders || old == layers_.end() || old - layers_.begin() != static_cast<std::ptrdiff_t>(i);
        Layer layer;
        if (old != layers_.end())
            layer = std::move(*old);
        else
            layer.shown.area.vertices = SurfaceRegion(mesh_->vertex_count());
        std::vector<int> own_changes;
        differing(layer.shown.area.vertices, own[i]->area.vertices, own_changes);
        if (old != layers_.end() && layer.shown.faint != own[i]->faint) { // all of it has another colour
            const std::vector<int> all = own[i]->area.vertices.vertices();
            changed.insert(changed.end(), all.begin(), all.end());
            borders = true;
        }
        layer.shown = *own[i];
        if (!own_changes.empty()) {
            update_mixed(layer, own_changes);
            chain(layer);
            changed.insert(changed.end(), own_changes.begin(), own_changes.end());
            borders = true;
        }
        if (old != layers_.end())
            old->shown.muscle = -2; // taken
        layers.push_back(std::move(layer));
    }
    for (const Layer& gone : layers_)
        if (gone.shown.muscle != -2)
            gone.shown.area.vertices.for_each([&](int v) { changed.push_back(v); });
    layers_ = std::move(layers);
    if (lit != highlighted_ || (lit_colour != highlight_colour_ && !lit.empty())) {
        if (lit_colour != highlight_colour_) {
            changed.insert(changed.end(), lit.begin(), lit.end());
            changed.insert(changed.end(), highlighted_.begin(), highlighted_.end());
        } else {
            std::set_symmetric_difference(lit.begin(), lit.end(), highlighted_.begin(), highlighted_.end(),
                                          std::back_inserter(changed));
        }
        highlighted_ = std::move(lit);
        highlight_colour_ = lit_colour;
    }
    if (!any()) {
        colours_ = nullptr;
        shown_colours_ = nullptr;
    } else if (colours_ == nullptr || base != base_) {
        base_ = base;
        colours_ = std::make_shared<render::LiveColours>();
        colours_->colours.assign(mesh_->positions.size(), base);
        for (const Layer& layer : layers_)
            layer.shown.area.vertices.for_each([&](int v) { colours_->colours[z(v)] = colour_of(v); });
        for (const int v : highlighted_)
            colours_->colours[z(v)] = colour_of(v);
        shown_colours_ = colours_;
    } else if (!changed.empty()) {
        recolour(std::move(changed));
    }
    if (borders)
        draw_borders();
}

void AreaMarks::update_mixed(Layer& layer, const std::vector<int>& changed) {
    const SurfaceRegion& region = layer.shown.area.vertices;
    for (const int v : changed)
        for (int k = starts_[z(v)]; k < starts_[z(v) + 1]; ++k) {
            const int t = around_[z(k)];
            const Tri& tri = mesh_->triangles[z(t)];
            const int inside =
                int(region.contains(tri[0])) + int(region.contains(tri[1])) + int(region.contains(tri[2]));
            if (inside == 1 || inside == 2)
                layer.mixed.insert(t);
            else
                layer.mixed.erase(t);
        }
}

// Through every mixed triangle the border runs from the middle of one cut edge to that of the other, with the inside on its
// left, so each middle is left once where the surface is oriented. Open ends (a rim of the surface) start lines first.
void AreaMarks::chain(Layer& layer) const {
    const SurfaceRegion& region = layer.shown.area.vertices;
    std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> next;
    std::unordered_map<std::uint64_t, int> arrivals;
    std::vector<std::uint64_t> starts;
    std::vector<int> triangles(layer.mixed.begin(), layer.mixed.end());
    std::sort(triangles.begin(), triangles.end());
    for (const int t : triangles) {
        const Tri& tri = mesh_->triangles[z(t)];
        const int inside =
            int(region.contains(tri[0])) + int(region.contains(tri[1])) + int(region.contains(tri[2]));
        for (std::size_t k = 0; k < 3; ++k) {
            const int corner = tri[k], after = tri[(k + 1) % 3], before = tri[(k + 2) % 3];
            if (region.contains(corner) != (inside == 1))
                continue; // not the odd one out
            const std::uint64_t a = edge_key(corner, after), b = edge_key(corner, before);
            next[inside == 1 ? a : b].push_back(inside == 1 ? b : a);
            ++arrivals[inside == 1 ? b : a];
            starts.push_back(inside == 1 ? a : b);
        }
    }
    std::stable_sort(starts.begin(), starts.end(), [&](std::uint64_t a, std::uint64_t b) {
        return (arrivals.count(a) == 0) > (arrivals.count(b) == 0);
    });
    const auto middle = [&](std::uint64_t key) {
        return narrow(0.5 * (mesh_->positions[key >> 32] + mesh_->positions[key & 0xFFFFFFFFu]));
    };
    layer.lines.clear();
    layer.closed.clear();
    for (const std::uint64_t start : starts) {
        std::vector<render::Vec3f> line;
        std::uint64_t at = start;
        for (auto it = next.find(at); it != next.end() && !it->second.empty(); it = next.find(at)) {
            line.push_back(middle(at));
            at = it->second.back();
            it->second.pop_back();
        }
        if (line.empty())
            continue;
        line.push_back(middle(at));
        layer.closed.push_back(at == start ? 1 : 0);
        layer.lines.push_back(std::move(line));
    }
}

void AreaMarks::draw_borders() {
    auto points = std::make_shared<std::vector<render::Vec3f>>();
    auto colours = std::make_shared<std::vector<render::Rgba>>();
    const auto add = [&](const Vec3& a, const Vec3& b, const render::Rgba& colour) {
        points->push_back(narrow(a));
        points->push_back(narrow(b));
        colours->insert(colours->end(), 2, colour);
    };
    const auto wide = [](const render::Vec3f& p) { return Vec3(p[0], p[1], p[2]); };
    for (const Layer& layer : layers_) {
        render::Rgba colour = attachment_colour(layer.shown.area.kind);
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] *= 0.55f; // darker than the area it encloses
        if (layer.shown.faint)
            colour[3] = 0.6f;
        const bool solid = layer.shown.area.kind == AttachmentKind::origin;
        // Dashes take 60 % of their period, those of an unknown kind 30 %.
        const double period = dash_, drawn = layer.shown.area.kind == AttachmentKind::insertion ? 0.6 : 0.3;
        for (const std::vector<render::Vec3f>& line : layer.lines) {
            double along = 0;
            for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                const Vec3 a = wide(line[i]), b = wide(line[i + 1]);
                const double length = (b - a).norm();
                if (solid || !(length > 0)) {
                    add(a, b, colour);
                    continue;
                }
                for (double s = 0; s < length;) {
                    const double phase = std::fmod(along + s, period);
                    const bool on = phase < drawn * period;
                    const double left = (on ? drawn * period : period) - phase;
                    const double end = std::min(length, s + std::max(left, 1e-3 * period));
                    if (on)
                        add(a + (b - a) * (s / length), a + (b - a) * (end / length), colour);
                    s = end;
                }
                along += length;
            }
        }
    }
    points_ = points;
    point_colours_ = colours;
}

render::Rgba AreaMarks::colour_of(int vertex) const {
    render::Rgba colour = base_;
    for (const Layer& layer : layers_)
        if (layer.shown.area.vertices.contains(vertex))
            colour =
                mixed(base_, attachment_colour(layer.shown.area.kind), layer.shown.faint ? 0.35f : 0.85f);
    if (std::binary_search(highlighted_.begin(), highlighted_.end(), vertex))
        colour = mixed(colour, highlight_colour_, highlight_colour_[3]);
    colour[3] = 1.0f;
    return colour;
}

/// Vertices near each other in number become one range: numbers of neighbours on the surface mostly are.
void AreaMarks::recolour(std::vector<int> vertices) {
    constexpr int gap = 48, most_ranges = 160;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const int v : vertices)
        colours_->colours[z(v)] = colour_of(v);
    ++colours_->revision;
    std::vector<render::LiveColours::Change>& changes = colours_->changes;
    for (int reach = gap;; reach *= 4) {
        std::vector<render::LiveColours::Change> ranges;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            if (i == 0 || vertices[i] - vertices[i - 1] > reach)
                ranges.push_back({colours_->revision, z(vertices[i]), 1});
            else
                ranges.back().count = z(vertices[i]) - ranges.back().first + 1;
        }
        if (ranges.size() > most_ranges)
            continue;
        changes.insert(changes.end(), ranges.begin(), ranges.end());
        break;
    }
    while (changes.size() > render::LiveColours::kept_changes) {
        colours_->known_from = changes.front().revision;
        const std::uint64_t gone = changes.front().revision;
        std::erase_if(changes, [&](const auto& change) { return change.revision == gone; });
    }
}

ShownAreas shown_areas(const std::vector<std::vector<AttachmentArea>>& by_muscle, int on_top) {
    auto list = std::make_shared<std::vector<ShownArea>>();
    const int count = static_cast<int>(by_muscle.size());
    const auto add = [&](int m) {
        for (const AttachmentArea& area : by_muscle[z(m)])
            if (!area.vertices.empty())
                list->push_back({m, area, on_top >= 0 && m != on_top});
    };
    for (int m = 0; m < count; ++m)
        if (m != on_top)
            add(m);
    if (on_top >= 0 && on_top < count)
        add(on_top);
    return list;
}

} // namespace fascicle::view
