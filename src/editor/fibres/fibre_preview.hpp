#pragma once
// The fibres of the document's scene at rest, made in the background as soon as anything that they depend on has changed, so
// that they are seen before a run has them. The newest request wins; nothing here waits.

#include "editor/feature.hpp"
#include "fascicle/anatomy/fibre_architecture.hpp"

#include <atomic>
#include <future>

namespace fascicle::editor {

/// Of one muscle: fibres and their numbers, or one line on why there are none.
struct MuscleFibres {
    std::string muscle;
    FibreModelPtr fibres; ///< null: none are asked for, or they cannot be made
    MuscleArchitecture architecture;
    std::string problem;
};

class FibrePreview : public Feature {
public:
    FibrePreview();
    ~FibrePreview() override;

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

    /// One per muscle of scene(), in its order; those of the last request that was finished.
    const std::vector<MuscleFibres>& muscles() const { return muscles_; }
    /// The scene that muscles() were made from; null before the first.
    const ScenePtr& scene() const { return scene_; }
    bool busy() const { return job_ != nullptr; }
    /// Whether muscles() are what the document asks for now.
    bool current() const { return scene_ != nullptr && wanted_ == nullptr && job_ == nullptr; }
    /// For the view: one a muscle, when the shown scene has the same meshes; empty otherwise.
    std::vector<FibreModelPtr> fibres_for(const Scene& shown) const;
    /// Waits for all that is asked for; for pictures and tests.
    void finish(EditorContext& context);

private:
    struct Job;
    void take();

    std::unique_ptr<Job> job_;
    ScenePtr wanted_; ///< begun as soon as the job under way is over
    ScenePtr asked_;  ///< last scene that was asked for
    std::uint64_t version_ = 0;
    ScenePtr scene_;
    std::vector<MuscleFibres> muscles_;
};

/// Why a muscle cannot have fibres by this method (`fibres.method`), as far as it can be told without making them; empty when
/// nothing speaks against it.
std::string why_not(const Scene& scene, const Muscle& muscle, std::string_view method);

} // namespace fascicle::editor
