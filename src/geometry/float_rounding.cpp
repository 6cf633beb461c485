#include "fascicle/geometry/float_rounding.hpp"

namespace fascicle {

double rounded_to_float(double x) {
    const volatile auto stored =
        static_cast<float>(x); // must go through memory: no conversion can be left out
    return static_cast<double>(stored);
}

void round_to_floats(Points& points) {
    for (Vec3& p : points)
        for (int k = 0; k < 3; ++k)
            p[k] = rounded_to_float(p[k]);
}

} // namespace fascicle
