#pragma once
// A GL context in memory, for programs without a window (command line, tests). The one place that knows
// OSMesa.

#include "render/gl_lookup.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace fascicle::render {

/// An OSMesa context, GL 3.3 core, current on the creating thread. The library is opened at run time, so a
/// program that never makes a picture runs without it. Its own buffer is a 64x64 dummy: draw into an
/// OffscreenTarget.
class OsmesaContext {
public:
    /// File names tried in turn when no others are given.
    static const std::vector<std::string>& default_libraries();

    /// Opens the library, makes the context current and fills the GL function table.
    /// Error saying which library is missing, or what the library could not do.
    explicit OsmesaContext(const std::vector<std::string>& libraries = default_libraries());
    ~OsmesaContext();
    OsmesaContext(const OsmesaContext&) = delete;
    OsmesaContext& operator=(const OsmesaContext&) = delete;

    /// Needed again only after another context was made current on this thread.
    void make_current();

private:
    void* context_ = nullptr;
    std::vector<std::uint8_t> dummy_;
};

} // namespace fascicle::render
