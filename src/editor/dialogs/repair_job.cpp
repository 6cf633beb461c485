#include "editor/dialogs/repair_job.hpp"

namespace fascicle::editor {

SurfaceFacts repaired_facts(RepairResult& result) {
    SurfaceFacts facts = facts_of(std::move(result.mesh), result.after);
    for (const auto& pair : result.first_crossings)
        for (const int t : pair) {
            const Tri& tri = facts.mesh->triangles[static_cast<std::size_t>(t)];
            for (std::size_t k = 0; k < 3; ++k)
                for (const int v : {tri[k], tri[(k + 1) % 3]})
                    facts.crossing.push_back(facts.mesh->positions[static_cast<std::size_t>(v)]);
        }
    return facts;
}

RepairJob::RepairJob(MeshPtr mesh, const RepairOptions& options) {
    future_ = std::async(std::launch::async, [this, mesh = std::move(mesh), options] {
        JobControl control;
        control.cancel = &cancel_;
        control.report = [this](std::string_view, double fraction) { fraction_ = fraction; };
        RepairOutcome outcome;
        outcome.result = repair(*mesh, options, control);
        outcome.after = repaired_facts(outcome.result);
        outcome.before = facts_of(*mesh, outcome.result.before);
        return outcome;
    });
}

} // namespace fascicle::editor
