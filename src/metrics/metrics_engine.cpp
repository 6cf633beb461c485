#include "fascicle/base/assert.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "fascicle/metrics/muscle_overlap.hpp"

namespace fascicle {

struct MetricsEngine::Impl {
    ScenePtr scene;
    std::vector<MuscleMeasure> muscles;
    MuscleOverlapMeasure overlap;

    Impl(ScenePtr of, const Frame& rest, const std::vector<std::vector<Attachment>>* attachments,
         const std::vector<FibreModelPtr>& fibres, int threads)
        : scene(std::move(of)), overlap(scene, rest, threads) {
        const auto bones = bone_solids(*scene);
        muscles.reserve(scene->muscles.size());
        for (std::size_t m = 0; m < scene->muscles.size(); ++m) {
            const Muscle& muscle = scene->muscles[m];
            std::optional<std::vector<Attachment>> fixed;
            if (attachments != nullptr && attachments->size() == scene->muscles.size())
                fixed = (*attachments)[m];
            else if (!muscle.attachments.empty() ||
                     (!has_painted_areas(muscle) && muscle.outlines.empty() && !muscle.attach_automatically))
                fixed = muscle.attachments;
            muscles.emplace_back(*scene, static_cast<int>(m), rest, bones, std::move(fixed), threads,
                                 m < fibres.size() ? fibres[m] : nullptr);
        }
    }
};

namespace {

FramePtr rest_of(const Recording& recording) {
    FramePtr rest = recording.frame(0);
    FASCICLE_ASSERT(rest != nullptr);
    return rest;
}

} // namespace

MetricsEngine::MetricsEngine(const Recording& recording, int threads) {
    const std::vector<std::vector<Attachment>> attachments = recording.attachments();
    impl_ = std::make_unique<Impl>(recording.scene_ptr(), *rest_of(recording), &attachments,
                                   recording.fibres(), threads);
}

MetricsEngine::MetricsEngine(ScenePtr scene, const Frame& rest, int threads)
    : impl_(std::make_unique<Impl>(std::move(scene), rest, nullptr, std::vector<FibreModelPtr>{}, threads)) {}

MetricsEngine::~MetricsEngine() = default;

std::vector<std::vector<double>> MetricsEngine::measure(const Frame& frame) {
    std::vector<std::vector<double>> values;
    const std::vector<double> overlaps = impl_->overlap.measure(frame);
    for (std::size_t m = 0; m < impl_->muscles.size(); ++m) {
        MuscleMeasure& muscle = impl_->muscles[m];
        muscle.measure(frame, overlaps[m]);
        std::vector<double>& row = values.emplace_back();
        for (const MetricRow& metric : metric_table())
            row.push_back(metric.value(muscle));
    }
    return values;
}

const MuscleMeasure& MetricsEngine::muscle(int index) const {
    return impl_->muscles.at(static_cast<std::size_t>(index));
}

} // namespace fascicle
