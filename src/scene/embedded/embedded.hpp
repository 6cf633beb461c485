#pragma once
// One maker per embedded scene; the table that lists them is in embedded_scenes.cpp.

#include "fascicle/scene/scene.hpp"

namespace fascicle::embedded {

Scene make_squish_box(int threads);
Scene make_cylinder(int threads);
Scene make_hip(int threads);
Scene make_two_heads(int threads);

} // namespace fascicle::embedded
