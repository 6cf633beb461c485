#pragma once
// Names of bodies and of frames with an offset to them, as elements of a model point to them.

#include "fascicle/base/pose.hpp"
#include "io/osim/osim_document.hpp"

#include <optional>

namespace fascicle::io {

/// A frame that stands still in a body.
struct BodyFrame {
    int body = 0;
    Pose pose; ///< in the body
};

class OsimFrames {
public:
    explicit OsimFrames(const OsimDocument& document) : document_(document) {}

    /// path: "/ground", "/bodyset/pelvis". Error at `node` when there is one already.
    void add_body(const std::string& path, int body, pugi::xml_node node);
    /// A PhysicalOffsetFrame below `scope`, such as "/jointset/hip_r"; looked into only when it is asked for, since it may
    /// hang on frames that come later.
    void add_offset(const std::string& scope, pugi::xml_node node);

    /// What `reference`, written at `node` below `scope`, stands for: an absolute path, a relative one ("..", "../pelvis"),
    /// or the bare name of a body or frame. Error at `node` when there is none.
    BodyFrame resolve(std::string_view reference, const std::string& scope, pugi::xml_node node) const;

    /// What a socket of an element is connected to, in the spelling of any version; no node when it has none:
    /// <socket_x>, <socket_x_connectee_name>, <connectors> with a connectee_name.
    static pugi::xml_node socket(pugi::xml_node element, const char* name);

private:
    struct Offset {
        std::string scope;
        pugi::xml_node node;
    };
    std::optional<BodyFrame> find(const std::string& path, int depth) const;
    BodyFrame offset_frame(const Offset& offset, int depth) const;
    BodyFrame resolve(std::string_view reference, const std::string& scope, pugi::xml_node node,
                      int depth) const;

    const OsimDocument& document_;
    std::map<std::string, int> bodies_;
    std::map<std::string, Offset> offsets_;
    std::multimap<std::string, std::string> paths_by_name_; ///< last part -> path, of bodies and offsets
};

} // namespace fascicle::io
