#pragma once
// Numbers and names as people read them.

#include <string>

namespace fascicle::reproduce {

/// Significant digits, never an exponent: "0.0124", "<0.0001", ">-0.0001", "0". Plain text: a page escapes it. "nan" for what is no number.
std::string told_number(double value, int digits = 3);

/// A key as words: "gluteus_maximus" is "gluteus maximus".
std::string told_name(const std::string& key);

/// "Figure 7", "Figures 3, 4"; empty for none.
std::string told_figures(const std::string& figures);

} // namespace fascicle::reproduce
