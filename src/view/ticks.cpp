#include "view/ticks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace fascicle::view {

namespace {

/// With a dot, whatever the locale.
std::string print(double value, std::chars_format format, int digits) {
    char buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, format, digits).ptr;
    return {buffer, end};
}

} // namespace

Ticks nice_ticks(double low, double high, int count) {
    if (!(high > low) || !std::isfinite(high - low) || count < 1)
        return {};
    const double raw = (high - low) / count;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= raw * (1 - 1e-9)) {
            step = factor * power;
            break;
        }
    const double first = std::ceil(low / step - 1e-9) * step;
    return {first, step, static_cast<int>(std::floor((high - first) / step + 1e-9)) + 1};
}

Ticks scale_ticks(double low, double high, int count, double closest) {
    const Ticks ticks = nice_ticks(low, high, count);
    constexpr int always_two = 5; // from here on steps are no longer than half of the range
    for (int finer = count + 1; ticks.count < 2 && finer <= std::max(count, always_two); ++finer)
        if (const Ticks more = nice_ticks(low, high, finer);
            more.count > 1 && more.step >= closest * (high - low))
            return more;
    return ticks;
}

std::string tick_text(double value, double step) {
    if (std::abs(value) < step * 1e-6)
        value = 0; // not "-0"
    if (step >= 1e6 || step < 1e-6)
        return print(value, std::chars_format::scientific, 1);
    return print(value, std::chars_format::fixed,
                 std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9))));
}

} // namespace fascicle::view
