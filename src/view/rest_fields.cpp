#include "view/rest_fields.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/scene/muscle_stiffness.hpp"
#include "view/vertex_means.hpp"

#include <algorithm>

namespace fascicle::view {

namespace {

bool same(const std::vector<Attachment>& a, const std::vector<Attachment>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Attachment& x, const Attachment& y) {
        return x.kind == y.kind && x.bone == y.bone && x.vertices == y.vertices;
    });
}

bool ready(const std::future<VertexValues>& pending) {
    return pending.valid() && pending.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

} // namespace

bool RestFields::Key::operator==(const Key& other) const {
    return mesh == other.mesh && fibres == other.fibres && surface_fibres == other.surface_fibres &&
           method == other.method && stiffness == other.stiffness && anisotropy == other.anisotropy &&
           ends == other.ends && same(attachments, other.attachments);
}

RestFields::Key RestFields::key_of(const Source& source, RestField field) {
    const Muscle& muscle = source.scene->muscles[source.muscle];
    Key key;
    key.mesh = muscle.mesh;
    key.attachments = source.attachments;
    for (const Attachment& attachment : source.attachments)
        key.ends.push_back(attachment_end(*source.scene, attachment));
    if (field == RestField::harmonic)
        return key;
    key.fibres = source.fibres;
    key.surface_fibres = muscle.surface_fibres;
    key.method = static_cast<int>(source.scene->parameters.get("solver.method"));
    key.stiffness = source.scene->parameters.get("solver.stiffness");
    key.anisotropy = source.scene->parameters.get("solver.anisotropy");
    return key;
}

VertexValues RestFields::make(RestField field, const Scene& scene, std::size_t index,
                              const std::vector<Attachment>& attachments, const FibreModelPtr& fibres) {
    const Muscle& muscle = scene.muscles[index];
    const MeshTopology topology(muscle.mesh->vertex_count(), muscle.mesh->triangles);
    std::vector<double> values;
    try {
        if (field == RestField::stiffness)
            values = vertex_means(topology,
                                  edge_stiffness(scene, muscle, topology, attachments, fibres.get()), 0.0);
        else
            values = origin_to_insertion_field(scene, muscle, topology, attachments);
    } catch (const Error&) {
        return nullptr; // a surface that no field can be solved on; the run says so, too
    }
    return values.empty() ? nullptr : std::make_shared<const std::vector<double>>(std::move(values));
}

void RestFields::take(Slot& slot) {
    slot.values = slot.pending.get();
    slot.key = std::move(slot.pending_key);
    slot.has = true;
    ++computed_;
}

VertexValues RestFields::values(RestField field, const Source& source) {
    FASCICLE_ASSERT(source.scene != nullptr && source.muscle < source.scene->muscles.size());
    if (source.muscle >= slots_.size())
        slots_.resize(source.scene->muscles.size());
    Slot& slot = slots_[source.muscle][static_cast<std::size_t>(field)];
    if (ready(slot.pending))
        take(slot);
    Key key = key_of(source, field);
    if (slot.has && slot.key == key)
        return slot.values;
    if (!background_ && slot.pending.valid()) { // from when it was in the background
        take(slot);
        if (slot.key == key)
            return slot.values;
    }
    if (!slot.pending.valid()) { // an older task is left to end first
        slot.pending_key = key;
        slot.pending =
            std::async(background_ ? std::launch::async : std::launch::deferred,
                       [field, scene = source.scene, muscle = source.muscle, attachments = source.attachments,
                        fibres = source.fibres] { return make(field, *scene, muscle, attachments, fibres); });
    }
    if (!background_) {
        take(slot);
        return slot.values;
    }
    return slot.has && slot.key.mesh == key.mesh ? slot.values : nullptr;
}

bool RestFields::waiting() const {
    for (const auto& fields : slots_)
        for (const Slot& slot : fields)
            if (slot.pending.valid())
                return true;
    return false;
}

bool RestFields::collect() {
    bool any = false;
    for (auto& fields : slots_)
        for (Slot& slot : fields)
            if (ready(slot.pending)) {
                take(slot);
                any = true;
            }
    return any;
}

} // namespace fascicle::view
