#include "editor/fibres/fibre_preview.hpp"

#include "fascicle/anatomy/fibre_methods.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/simulation/rest_fibres.hpp"

#include <algorithm>
#include <chrono>

namespace fascicle::editor {

namespace {

/// What fibres depend on besides the muscle itself.
constexpr const char* keys[] = {"fibres.method", "fibres.template", "fibres.count", "fibres.segments",
                                "attachment.distance_mm"};

bool same_attachments(const std::vector<Attachment>& a, const std::vector<Attachment>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Attachment& x, const Attachment& y) {
        return x.bone == y.bone && x.kind == y.kind && x.vertices == y.vertices;
    });
}

bool same_outlines(const std::vector<AttachmentOutline>& a, const std::vector<AttachmentOutline>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const AttachmentOutline& x, const AttachmentOutline& y) {
                          return x.bone == y.bone && x.kind == y.kind && x.points == y.points &&
                                 x.head == y.head && x.hole == y.hole;
                      });
}

/// Whether the fibres of one scene are those of the other.
bool same_fibres(const Scene& a, const Scene& b) {
    for (const char* key : keys)
        if (a.parameters.get(key) != b.parameters.get(key))
            return false;
    // Which end of a muscle is its insertion depends on what moves.
    for (int i = 0; i < static_cast<int>(std::min(a.bones.size(), b.bones.size())); ++i)
        if (a.timeline.moves(i) != b.timeline.moves(i))
            return false;
    const auto same_muscle = [](const Muscle& x, const Muscle& y) {
        return x.name == y.name && x.surface_fibres == y.surface_fibres &&
               x.fibre_template == y.fibre_template && x.attach_automatically == y.attach_automatically &&
               x.attach_to == y.attach_to && x.areas == y.areas &&
               same_attachments(x.attachments, y.attachments) && same_outlines(x.outlines, y.outlines);
    };
    return a.unit == b.unit && same_bodies(a, b) &&
           std::equal(a.muscles.begin(), a.muscles.end(), b.muscles.begin(), b.muscles.end(), same_muscle);
}

MuscleFibres make_one(const Scene& scene, std::size_t index, RestFibres& fibres, int threads) {
    const Muscle& muscle = scene.muscles[index];
    MuscleFibres result;
    result.muscle = muscle.name;
    try {
        result.fibres = fibres.make(index, threads);
        if (result.fibres != nullptr)
            result.architecture = muscle_architecture(
                result.fibres->rest, signed_volume(muscle.mesh->positions, muscle.mesh->triangles),
                millimetres_per_unit(scene.unit), muscle.name, threads);
    } catch (const std::exception& problem) { // one muscle without fibres must not take them from the others
        result.fibres = nullptr;
        result.problem = problem.what();
    }
    return result;
}

} // namespace

struct FibrePreview::Job {
    ScenePtr scene;
    std::atomic<bool> stop{false};
    std::future<std::vector<MuscleFibres>> result;

    explicit Job(ScenePtr of) : scene(std::move(of)) {
        result = std::async(std::launch::async, [this] {
            const int threads = std::max(1, hardware_threads() - 1);
            RestFibres fibres(*scene);
            std::vector<MuscleFibres> muscles;
            for (std::size_t i = 0; i < scene->muscles.size() && !stop; ++i)
                muscles.push_back(make_one(*scene, i, fibres, threads));
            return muscles;
        });
    }
    bool done() const { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
};

FibrePreview::FibrePreview() = default;

FibrePreview::~FibrePreview() {
    if (job_ != nullptr)
        job_->stop = true; // the future waits
}

void FibrePreview::document_replaced(EditorContext&) {
    if (job_ != nullptr)
        job_->stop = true;
    wanted_ = asked_ = scene_ = nullptr;
    muscles_.clear();
    version_ = 0;
}

void FibrePreview::take() {
    const std::unique_ptr<Job> job = std::move(job_);
    std::vector<MuscleFibres> made = job->result.get();
    if (job->stop)
        return;
    scene_ = job->scene;
    muscles_ = std::move(made);
}

void FibrePreview::update(EditorContext& context) {
    if (job_ != nullptr && job_->done())
        take();
    if (version_ != context.document.version()) {
        version_ = context.document.version();
        // The scratch, so that fibres follow a slider while it is held.
        const Scene& scene = context.document.scene();
        if (asked_ == nullptr || !same_fibres(*asked_, scene)) {
            wanted_ = asked_ = std::make_shared<const Scene>(scene);
            if (job_ != nullptr)
                job_->stop = true;
        }
    }
    if (wanted_ != nullptr && job_ == nullptr)
        job_ = std::make_unique<Job>(std::exchange(wanted_, nullptr));
}

std::optional<double> FibrePreview::redraw_after() const {
    return job_ == nullptr && wanted_ == nullptr ? std::nullopt : std::optional<double>(1.0 / 25);
}

std::vector<FibreModelPtr> FibrePreview::fibres_for(const Scene& shown) const {
    std::vector<FibreModelPtr> result;
    if (scene_ == nullptr || !same_bodies(*scene_, shown))
        return result;
    for (const MuscleFibres& muscle : muscles_)
        result.push_back(muscle.fibres);
    return result;
}

void FibrePreview::finish(EditorContext& context) {
    update(context);
    while (job_ != nullptr || wanted_ != nullptr) {
        if (job_ != nullptr)
            job_->result.wait();
        update(context);
    }
}

std::string why_not(const Scene& scene, const Muscle& muscle, std::string_view method) {
    for (const FibreMethod& row : fibre_methods())
        if (method == row.key && row.needs_surface_fibres && muscle.surface_fibres == nullptr)
            return muscle.name + " has no superficial fibres, which " + row.label + " starts from";
    const bool placed = !muscle.attachments.empty() || has_painted_areas(muscle) || !muscle.outlines.empty();
    if (method != "none" && !placed && (!muscle.attach_automatically || scene.bones.empty()))
        return muscle.name + " is not attached to any bone";
    return {};
}

} // namespace fascicle::editor
