#include "reproduce/words.hpp"

#include "output/report_charts.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::reproduce {

std::string told_number(double value, int digits) {
    const double least = 1e-4; // what is less than this is rounding, in every unit that is told
    if (value != 0 && std::abs(value) < least)
        return value > 0 ? "<0.0001" : ">-0.0001";
    return output::short_number(value, digits);
}

std::string told_name(const std::string& key) {
    std::string words = key;
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

std::string told_figures(const std::string& figures) {
    if (figures.empty())
        return {};
    return (figures.find(',') == std::string::npos ? "Figure " : "Figures ") + figures;
}

} // namespace fascicle::reproduce
