#pragma once
// Round values along an axis, and how they are written.

#include <string>

namespace fascicle::view {

/// Ticks that people would choose: multiples of 1, 2 or 5 times a power of ten. At most `count` + 1 of them
/// within [low, high]. Empty when the range is empty or not finite.
struct Ticks {
    double first = 0;
    double step = 0;
    int count = 0;
    double at(int i) const { return first + step * i; }
};
Ticks nice_ticks(double low, double high, int count);
/// The same, but two at least where they are no closer than `closest`, a share of the range: one alone tells no scale.
Ticks scale_ticks(double low, double high, int count, double closest);
/// A number with just the decimals that tell ticks `step` apart.
std::string tick_text(double value, double step);

} // namespace fascicle::view
