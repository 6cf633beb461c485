#pragma once
// Moving points beside a mesh that has their triangles: PC2 (little-endian) and MDD (big-endian), as Blender, Maya and Houdini read them.

#include "fascicle/io/animation.hpp"

#include <ostream>
#include <string>
#include <string_view>

namespace fascicle::io {

/// "POINTCACHE2\0", version 1, points, first frame, frames a sample, samples; then x, y, z of every point and sample as floats.
/// The frames must lie at equal distances. Error naming `where` when a number is beyond what a float holds.
void write_pc2(std::ostream& out, const AnimatedBody& body, const Animation& animation,
               const JobControl& control, const std::string& where);
/// Samples, points, the time of every sample in seconds, then as above; all numbers big-endian. Error also when two times are one as
/// floats.
void write_mdd(std::ostream& out, const AnimatedBody& body, const Animation& animation,
               const JobControl& control, const std::string& where);

/// What a point cache holds; `bytes` of the reader must outlive it.
struct PointCache {
    std::size_t samples = 0, points = 0;
    double first_frame = 0, frame_step = 1; ///< PC2
    std::vector<double> seconds;            ///< MDD, one a sample; empty for PC2
    std::string_view values;                ///< 12 bytes a point
    bool big_endian = false;

    /// Points of sample k. Error naming `file` when one is not finite.
    void read(std::size_t k, Points& out, const std::string& file) const;
};

/// Error naming file and byte.
PointCache read_pc2(std::string_view bytes, const std::string& file);
PointCache read_mdd(std::string_view bytes, const std::string& file);

} // namespace fascicle::io
