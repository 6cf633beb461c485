#pragma once
// The report as one HTML page.

#include "reproduce/results.hpp"

#include <string>

namespace fascicle::reproduce {

/// UTF-8, well-formed as XML too; needs no other file, no script and no network. Numbers have a dot in every locale. date: as it is shown.
std::string report_page(const Results& results, const std::string& date);

} // namespace fascicle::reproduce
