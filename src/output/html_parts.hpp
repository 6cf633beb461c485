#pragma once
// What every HTML page of the program is made of.

#include "render/image.hpp"

#include <string>

namespace fascicle::output {

/// Content of <style>: light and dark, narrow screens, print.
const std::string& page_style();
/// The picture as a PNG in base64, for a data URI.
std::string picture_base64(const render::Image& image);
/// 12345 as "12,345".
std::string whole_number(std::size_t number);

} // namespace fascicle::output
