#pragma once
// The rival: Bullet's soft body on the same surfaces, with the same vertices fixed to the same bones.

#include "bench/bench_body.hpp"

namespace fascicle::bench {

/// Why this program cannot measure Bullet; empty when it can.
std::string bullet_missing();

/// One soft body per muscle in one world without gravity: a link per edge, `iterations` position iterations, volume
/// conservation, fixed vertices of no mass moved with their bones, one step a frame; no bending, no contact.
/// Null when bullet_missing().
std::unique_ptr<BenchBody> make_bullet_body(const PreparedScene& prepared, int iterations);

} // namespace fascicle::bench
