#pragma once
// The pieces that the pages of a report are put together from.

#include "reproduce/charts.hpp"

namespace fascicle::reproduce {

/// Grows a page from its beginning to its end. Cells are HTML: the caller escapes.
class PageWriter {
public:
    std::string html;

    /// numbers_from: columns from here on are right-aligned.
    void row(const std::vector<std::string>& cells, const char* tag = "td", std::size_t numbers_from = 1000);
    void table() { html += "<div class=\"wide\"><table>\n"; }
    void end_table() { html += "</table></div>\n"; }
    /// who: of the pictures, for readers who do not see them.
    void pictures(const std::vector<Picture>& list, const std::string& who);
    /// findings: where the sentences of the plots are.
    void plots(const std::vector<Plot>& list, const std::vector<Finding>& findings);
    /// The sentence about a quantity, where there is one.
    void sentence(const std::vector<Finding>& findings, const std::string& about);

    static std::string badge(Verdict verdict);
    /// A number, a dash for what is not known.
    static std::string cell(double value, int digits = 3);
};

inline constexpr const char* page_dash = "\xE2\x80\x93";
/// Content of <style>.
std::string report_style();

/// The sections about finite elements, moment arms, mesh and passes, and speed.
void write_validation(PageWriter& page, const Results& results);

} // namespace fascicle::reproduce
