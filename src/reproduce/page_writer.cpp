#include "reproduce/page_writer.hpp"

#include "output/html_parts.hpp"
#include "reproduce/words.hpp"
#include "view/chart_svg.hpp"

#include <cmath>

namespace fascicle::reproduce {

namespace {

using view::xml_escaped;

/// Beside the style of all pages. One drawing serves both grounds: on a dark one its colours are inverted, hues kept.
const char* const own_style = R"(
.pictures.small { grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 8px; margin-bottom: 14px; }
.pictures.small.many { grid-template-columns: repeat(4, minmax(0, 1fr)); }
.pictures.small figcaption { font-size: 12px; margin-top: 3px; }
.plots { margin-top: 18px; }
.verdict { display: inline-block; border-radius: 4px; padding: 0 7px; font-size: 12.5px; font-weight: 600; border: 1px solid var(--line); }
.verdict.better { color: #0a7a4b; } .verdict.worse { color: #b3402e; } .verdict.kept { color: #0068a8; }
h3 { font-size: 15px; margin: 20px 0 8px; }
@media (prefers-color-scheme: dark) {
  figure svg { filter: invert(0.91) hue-rotate(180deg); }
  .verdict.better { color: #4cd39b; } .verdict.worse { color: #ff8a70; } .verdict.kept { color: #6fbdf2; }
}
@media (max-width: 720px) { .pictures.small, .pictures.small.many { grid-template-columns: repeat(2, minmax(0, 1fr)); } }
@media print { figure svg { filter: none; } }
)";

const Finding* finding_of(const std::vector<Finding>& findings, const std::string& about) {
    for (const Finding& finding : findings)
        if (!about.empty() && finding.about == about)
            return &finding;
    return nullptr;
}

} // namespace

std::string report_style() {
    return output::page_style() + own_style;
}

std::string PageWriter::badge(Verdict verdict) {
    const std::string word = to_text(verdict);
    return "<span class=\"verdict " + word + "\">" + word + "</span>";
}

std::string PageWriter::cell(double value, int digits) {
    return std::isfinite(value) ? xml_escaped(told_number(value, digits)) : page_dash;
}

void PageWriter::row(const std::vector<std::string>& cells, const char* tag, std::size_t numbers_from) {
    html += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
        html += std::string("<") + tag + (i >= numbers_from ? " class=\"n\">" : ">") + cells[i] + "</" + tag +
                ">";
    html += "</tr>\n";
}

void PageWriter::pictures(const std::vector<Picture>& list, const std::string& who) {
    if (list.empty())
        return;
    html += list.size() > 6 ? "<div class=\"pictures small many\">\n" : "<div class=\"pictures small\">\n";
    for (const Picture& picture : list)
        html += "<figure><img width=\"" + std::to_string(picture.image.width) + "\" height=\"" +
                std::to_string(picture.image.height) + "\" alt=\"" +
                xml_escaped(who + ", " + picture.caption) + "\" src=\"data:image/png;base64," +
                output::picture_base64(picture.image) + "\"/><figcaption>" + xml_escaped(picture.caption) +
                "</figcaption></figure>\n";
    html += "</div>\n";
}

void PageWriter::sentence(const std::vector<Finding>& findings, const std::string& about) {
    if (const Finding* finding = finding_of(findings, about))
        html += "<p>" + (finding->figure.empty() ? "" : "<b>Fig. " + xml_escaped(finding->figure) + "</b> ") +
                badge(finding->verdict) + " " + xml_escaped(finding->text) + "</p>\n";
}

void PageWriter::plots(const std::vector<Plot>& list, const std::vector<Finding>& findings) {
    if (list.empty())
        return;
    html += "<div class=\"plots\">\n";
    for (const Plot& plot : list) {
        html += "<figure>" + view::chart_svg(plot.chart, 520, 280) + "<figcaption>";
        if (!plot.figures.empty())
            html += "<b>Fig. " + xml_escaped(plot.figures) + "</b> ";
        html += xml_escaped(plot.caption);
        if (const Finding* finding = finding_of(findings, plot.about))
            html += " " + badge(finding->verdict) + " " + xml_escaped(finding->text);
        html += "</figcaption></figure>\n";
    }
    html += "</div>\n";
}

} // namespace fascicle::reproduce
