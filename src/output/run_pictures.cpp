#include "output/run_pictures.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/io/png.hpp"
#include "render/image.hpp"

#include <algorithm>
#include <numbers>

namespace fascicle::output {

namespace {

const int strip_pictures = 7;
const int strip_width = 360, strip_height = 400;

/// Where the corners of the bones' boxes go from rest, scene units.
std::vector<Vec3> corner_moves(const Scene& scene, const Frame& frame) {
    std::vector<Vec3> moves;
    for (std::size_t b = 0; b < scene.bones.size(); ++b) {
        const TriMesh& mesh = *scene.bones[b].mesh;
        const BoundingBox box = bounding_box(mesh.positions, mesh.triangles);
        for (int corner = 0; corner < 8 && !box.empty(); ++corner) {
            Vec3 p;
            for (int k = 0; k < 3; ++k)
                p[k] = (corner >> k & 1) != 0 ? box.max[k] : box.min[k];
            moves.push_back(frame.bone_poses[b].apply(p) - p);
        }
    }
    return moves;
}

double furthest(const std::vector<Vec3>& moves) {
    double way = 0;
    for (const Vec3& move : moves)
        way = std::max(way, move.norm());
    return way;
}

/// Share of the moves that an eye looking along `direction` (unit) sees: 1 across, 0 straight at it; 1 without moves.
double seen_share(const std::vector<Vec3>& moves, const Vec3& direction) {
    double seen = 0, all = 0;
    for (const Vec3& move : moves) {
        all += move.norm();
        seen += move.cross(direction).norm();
    }
    return all > 0 ? seen / all : 1;
}

} // namespace

const std::vector<std::string>& standard_view_names() {
    static const std::vector<std::string> names{"anterior", "posterior", "left",
                                                "right",    "superior",  "inferior"};
    return names;
}

int most_flexed_frame(const Recording& recording) {
    int best = 0;
    double most = 0;
    for (int k = 0; k < recording.frame_count(); ++k) {
        const double way = furthest(corner_moves(recording.scene(), *recording.frame(k)));
        // A turn back through the same angle differs in the last bits only.
        if (way > most * (1 + 1e-9)) {
            most = way;
            best = k;
        }
    }
    return best;
}

Pictures::Pictures(const Recording& recording, const PictureOptions& options)
    : recording_(recording), options_(options) {
    FASCICLE_ASSERT(recording.frame_count() > 0);
    view_.colouring = options.colouring;
    view_.occlusion = true;
    const int flexed = most_flexed_frame(recording);
    for (const int k : {0, flexed, recording.frame_count() - 1})
        box_.add(view::visible_bounds(view::subject_of(recording, k), view_));
    camera_.set_scene_bounds(box_);
    if (options.from)
        camera_.look_from(*options.from);
    else
        choose_side(flexed);
}

/// The camera turns to where most of the muscles is seen at rest and flexed, and most of the motion.
void Pictures::choose_side(int flexed) {
    const int sides = 16, size = 128;
    const double pitch = 12 * std::numbers::pi / 180;
    const std::vector<Vec3> moves = corner_moves(recording_.scene(), *recording_.frame(flexed));
    const view::Camera start = camera_;
    double best = -1;
    for (int i = 0; i < sides; ++i) {
        view::Camera candidate = start;
        const bool oblique =
            i % 2 == 1; // half way between the standard views and their diagonals depth shows best
        candidate.orbit_by(i * 2 * std::numbers::pi / sides, pitch);
        candidate.frame(box_, 1.0);
        const int pixels = muscle_pixels(0, candidate, size) + muscle_pixels(flexed, candidate, size);
        const double score = (oblique ? 1.5 : 1.0) * pixels * seen_share(moves, candidate.backward());
        if (score > best) {
            best = score;
            camera_ = candidate;
        }
    }
}

/// Pixels of a small square picture in which a muscle is seen: muscles are drawn red, bones blue.
int Pictures::muscle_pixels(int frame, const view::Camera& camera, int size) {
    view::ViewOptions plain = view_;
    plain.attachments = plain.joint_axis = plain.occlusion = false;
    plain.colouring = view::Colouring::anatomy;
    render::DrawList list =
        view::build_draw_list(view::subject_of(recording_, frame), plain, camera.pose(1.0), cache_);
    const std::size_t muscles = recording_.scene().muscles.size();
    for (render::SurfaceItem& item : list.surfaces) {
        bool muscle = false;
        for (std::size_t m = 0; m < muscles; ++m)
            muscle = muscle || item.id == view::muscle_item_id(m);
        item.vertex_colours = nullptr;
        item.colour = muscle ? render::Rgba{1, 0, 0, 1} : render::Rgba{0, 0, 1, 1};
        item.gloss = 0;
    }
    list.background_top = list.background_bottom = {0, 0, 0, 1};
    const render::Image image = renderer_.draw(list, size, size);
    int pixels = 0;
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
        pixels += image.rgba[i] > image.rgba[i + 2] + 20 ? 1 : 0;
    return pixels;
}

view::Camera Pictures::camera(double aspect) const {
    view::Camera camera = camera_;
    camera.frame(box_, aspect);
    return camera;
}

render::Image Pictures::draw(int frame, int width, int height) {
    const double aspect = double(width) / height;
    render::DrawList list = view::build_draw_list(view::subject_of(recording_, frame), view_,
                                                  camera(aspect).pose(aspect), cache_);
    if (transparent_)
        list.background_top[3] = list.background_bottom[3] = 0;
    return renderer_.draw(list, width, height);
}

void write_picture(const std::filesystem::path& path, const render::Image& image) {
    write_png(path, image.width, image.height, image.rgba.data());
}

void write_run_pictures(const Recording& recording, const std::filesystem::path& folder) {
    Pictures pictures(recording, {});
    const int last = recording.frame_count() - 1;
    const auto write = [&](const char* name, int frame) {
        write_picture(folder / name, pictures.draw(frame));
    };
    write("rest.png", 0);
    write("flexed.png", most_flexed_frame(recording));
    write("last.png", last);
    std::vector<render::Image> strip;
    for (int i = 0; i < strip_pictures; ++i)
        strip.push_back(pictures.draw(i * last / (strip_pictures - 1), strip_width, strip_height));
    write_picture(folder / "film_strip.png", render::film_strip(strip));
}

} // namespace fascicle::output
