#pragma once
// Fields of a muscle at rest that take too long for a frame: made once, beside the interface when it asks for that.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/scene/recording.hpp"

#include <future>

namespace fascicle::view {

using VertexValues = std::shared_ptr<const std::vector<double>>;

enum class RestField {
    stiffness, ///< mean of edge_stiffness (scene/muscle_stiffness.hpp) over the edges at a vertex
    harmonic,  ///< origin_to_insertion_field
};

/// Keeps one array per muscle and field, and makes it anew only when what it comes from has changed. Not thread-safe; the threads
/// that it starts share nothing with it.
class RestFields {
public:
    /// What the fields come from: the scene, one of its muscles, what is in force for it.
    struct Source {
        const ScenePtr& scene;
        std::size_t muscle;
        const std::vector<Attachment>& attachments;
        FibreModelPtr fibres; ///< null: none
    };

    /// In the background values() never waits: it gives what it has, of the same mesh, until there is something newer.
    void set_background(bool on) { background_ = on; }
    /// V values; null while there are none yet, and where the muscle has no such field (no origin or no insertion).
    VertexValues values(RestField field, const Source& source);

    /// Something is on its way.
    bool waiting() const;
    /// Takes in what has come; true when something has.
    bool collect();
    /// Arrays made so far.
    int computed() const { return computed_; }

private:
    struct Key {
        MeshPtr mesh;
        std::vector<Attachment> attachments;
        std::vector<AttachmentKind> ends;
        FibreModelPtr fibres;
        std::shared_ptr<const Polylines> surface_fibres;
        int method = 0;
        double stiffness = 0, anisotropy = 0;
        bool operator==(const Key& other) const;
    };
    struct Slot {
        Key key;
        VertexValues values;
        Key pending_key;
        std::future<VertexValues> pending;
        bool has = false; ///< `values` are what `key` gives
    };
    static Key key_of(const Source& source, RestField field);
    static VertexValues make(RestField field, const Scene& scene, std::size_t muscle,
                             const std::vector<Attachment>& attachments, const FibreModelPtr& fibres);
    void take(Slot& slot);

    std::vector<std::array<Slot, 2>> slots_; ///< by muscle, by field
    bool background_ = false;
    int computed_ = 0;
};

} // namespace fascicle::view
