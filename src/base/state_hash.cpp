#include "fascicle/base/state_hash.hpp"

#include <cstdio>

namespace fascicle {

void StateHash::add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) {
        value_ ^= bytes[i];
        value_ *= 1099511628211ull;
    }
}

void StateHash::add_points(const Points& points) {
    for (const Vec3& p : points)
        for (int k = 0; k < 3; ++k) {
            const double c = p[k] + 0.0; // turns -0.0 into 0.0
            add_bytes(&c, sizeof c);
        }
}

std::string StateHash::hex() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value_));
    return text;
}

} // namespace fascicle
