#include "editor/frame_axis.hpp"

#include <cstdio>
#include <numbers>

namespace fascicle::editor {

double frame_seconds(const Scene& scene) {
    return scene.parameters.get("solver.frame_time");
}

std::string frame_text(const Scene& scene, RulerUnit unit, double frame) {
    char buffer[40];
    switch (unit) {
    case RulerUnit::frame:
        std::snprintf(buffer, sizeof buffer, "%.0f", frame);
        break;
    case RulerUnit::seconds:
        std::snprintf(buffer, sizeof buffer, "%.2f", frame * frame_seconds(scene));
        break;
    case RulerUnit::angle:
        std::snprintf(buffer, sizeof buffer, "%.0f",
                      scene.timeline.angle_rad(frame) * 180 / std::numbers::pi + 0.0);
        break;
    }
    return std::string(buffer) == "-0" ? "0" : buffer;
}

const char* axis_label(RulerUnit unit) {
    switch (unit) {
    case RulerUnit::frame:
        return "frame";
    case RulerUnit::seconds:
        return "time [s]";
    case RulerUnit::angle:
        return "angle [\xC2\xB0]";
    }
    return "";
}

} // namespace fascicle::editor
