#include "fascicle/geometry/segment_query.hpp"
#include "fascicle/geometry/solid_query.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace fascicle;

TEST_CASE("segment query: ends on two sides of a surface always meet it, and near misses do not",
          "[geometry][segment]") {
    const TriMesh mesh = test::torus(3, 1, 48, 24);
    const SegmentQuery query(mesh);
    const SolidQuery solid(mesh);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-4.5, 4.5);
    int met = 0, missed = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a(number(random), number(random), number(random) / 3);
        const Vec3 b = i % 2 == 0 ? Vec3(number(random), number(random), number(random) / 3)
                                  : Vec3(a + 0.1 * Vec3(number(random), number(random), number(random)));
        // Finely sampled: a change of sides must be seen; all samples farther than half a step mean none.
        const int steps = 200;
        const double half = (b - a).norm() / steps;
        bool changes = false, far = true;
        const bool first = solid.inside(a);
        for (int k = 0; k <= steps; ++k) {
            const double d = solid.signed_distance(a + static_cast<double>(k) / steps * (b - a));
            changes = changes || (d < 0) != first;
            far = far && std::abs(d) > half;
        }
        if (changes)
            CHECK(query.meets(a, b));
        if (far)
            CHECK_FALSE(query.meets(a, b));
        met += changes ? 1 : 0;
        missed += far ? 1 : 0;
    }
    CHECK(met > 300);
    CHECK(missed > 300);
}

TEST_CASE("segment query: touching, in the plane, without length, empty", "[geometry][segment]") {
    const TriMesh one{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}};
    const SegmentQuery query(one);
    CHECK(query.meets(Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, -1)));
    CHECK(query.meets(Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, 0))); // ends on it
    CHECK_FALSE(query.meets(Vec3(0.2, 0.2, 1), Vec3(0.2, 0.2, 1e-9)));
    CHECK(query.meets(Vec3(0, 0, 1), Vec3(0, 0, -1))); // through a corner
    CHECK_FALSE(query.meets(Vec3(0.7, 0.7, 1), Vec3(0.7, 0.7, -1)));
    CHECK_FALSE(query.meets(Vec3(-1, 0.2, 1e-9), Vec3(2, 0.2, 1e-9))); // along it
    CHECK(query.meets(Vec3(-1, 0.2, 0), Vec3(2, 0.2, 0)));             // in it
    CHECK_FALSE(query.meets(Vec3(0.2, 0.2, 0.5), Vec3(0.2, 0.2, 0.5)));
    CHECK(query.meets(Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0), Vec3(0, 0, 0)));
    CHECK_FALSE(SegmentQuery().meets(Vec3(0, 0, 0), Vec3(1, 1, 1)));
    CHECK_FALSE(SegmentQuery(TriMesh{}).meets(Vec3(0, 0, 0), Vec3(1, 1, 1)));
}
