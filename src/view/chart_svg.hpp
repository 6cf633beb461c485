#pragma once
// A chart as a vector picture for papers and web pages.

#include "view/chart.hpp"

namespace fascicle::view {

/// A whole <svg> element of width x height CSS pixels (at least 120 x 80), sans-serif text, no scripts, no references to other
/// files; also right inside an HTML page. Numbers have a dot in every locale. dark: light text on a dark ground.
/// Points that no pixel could tell apart are left out: a curve has at most four per pixel column.
std::string chart_svg(const Chart& chart, int width, int height, bool dark = false);

/// `text` with <, >, & and quotes replaced for XML and HTML; control characters left out.
std::string xml_escaped(const std::string& text);

} // namespace fascicle::view
