#include "reproduce/page.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "output/html_parts.hpp"
#include "output/report_charts.hpp"
#include "reproduce/charts.hpp"
#include "reproduce/published.hpp"
#include "view/chart_svg.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::reproduce {

namespace {

using output::short_number;
using output::whole_number;
using view::xml_escaped;

/// Beside the style of all pages. One drawing serves both grounds: on a dark one its colours are inverted, hues kept.
const char* const own_style = R"(
.pictures.small { grid-template-columns: repeat(6, minmax(0, 1fr)); gap: 8px; margin-bottom: 14px; }
.pictures.small figcaption { font-size: 12px; margin-top: 3px; }
.plots { margin-top: 18px; }
.verdict { display: inline-block; border-radius: 4px; padding: 0 7px; font-size: 12.5px; font-weight: 600; border: 1px solid var(--line); }
.verdict.better { color: #0a7a4b; } .verdict.worse { color: #b3402e; } .verdict.kept { color: #0068a8; }
h3 { font-size: 15px; margin: 20px 0 8px; }
nav ol { columns: 2; padding-left: 22px; }
@media (prefers-color-scheme: dark) {
  figure svg { filter: invert(0.91) hue-rotate(180deg); }
  .verdict.better { color: #4cd39b; } .verdict.worse { color: #ff8a70; } .verdict.kept { color: #6fbdf2; }
}
@media (max-width: 720px) { .pictures.small { grid-template-columns: repeat(3, minmax(0, 1fr)); } nav ol { columns: 1; } }
@media print { figure svg { filter: none; } }
)";

const char* const dash = "\xE2\x80\x93";

class Page {
public:
    Page(const Results& results, const std::string& date) : results_(results), date_(date) {}

    std::string write() {
        head();
        findings();
        for (const ExperimentResult& result : results_.experiments)
            if (result.missing.empty())
                experiment(result);
        distances();
        arms();
        sensitivity();
        speed();
        left_out();
        html_ +=
            "<footer>Made by fascicle " + xml_escaped(program_version()) + " on " + xml_escaped(date_) +
            " in " + short_number(results_.seconds) +
            " s. This page needs no other file. All numbers: results.json and the tables beside it; times: "
            "timings.json.</footer>\n</main>\n</body>\n</html>\n";
        return std::move(html_);
    }

private:
    void row(const std::vector<std::string>& cells, const char* tag = "td", std::size_t numbers_from = 1000) {
        html_ += "<tr>";
        for (std::size_t i = 0; i < cells.size(); ++i)
            html_ += std::string("<") + tag + (i >= numbers_from ? " class=\"n\">" : ">") + cells[i] + "</" +
                     tag + ">";
        html_ += "</tr>\n";
    }
    void table() { html_ += "<div class=\"wide\"><table>\n"; }
    void end_table() { html_ += "</table></div>\n"; }
    static std::string badge(Verdict verdict) {
        const std::string word = to_text(verdict);
        return "<span class=\"verdict " + word + "\">" + word + "</span>";
    }
    static std::string cell(double value, int digits = 3) {
        return std::isfinite(value) ? short_number(value, digits) : dash;
    }

    void head() {
        std::string methods;
        for (const std::string& name : results_.methods)
            methods += (methods.empty() ? "" : ", ") + name;
        html_ += "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
                 "<meta charset=\"utf-8\"/>\n"
                 "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                 "<meta name=\"generator\" content=\"fascicle " +
                 xml_escaped(program_version()) +
                 "\"/>\n<title>Cervenka &amp; Kohout 2020, reproduced</title>\n<style>" +
                 output::page_style() + own_style +
                 "</style>\n</head>\n<body>\n<main>\n<h1>Cervenka &amp; Kohout 2020, reproduced</h1>\n"
                 "<p class=\"dim\">" +
                 xml_escaped(date_) + " \xC2\xB7 fascicle " + xml_escaped(program_version()) +
                 " \xC2\xB7 methods: " + xml_escaped(methods) +
                 "</p>\n<p>The experiments of \xE2\x80\x9C"
                 "Fast and Realistic Approach to Virtual "
                 "Muscle Deformation\xE2\x80\x9D (HEALTHINF 2020), each with every method on the same scene, "
                 "motion, "
                 "attachments and metrics. Data: " +
                 xml_escaped(results_.data) + ".</p>\n";
        bool stands_in = false;
        for (const ExperimentResult& result : results_.experiments)
            stands_in = stands_in || (result.missing.empty() && !result.real);
        if (stands_in)
            html_ += "<p class=\"alarm\">Where a heading says \xE2\x80\x9C"
                     "stand-in\xE2\x80\x9D there was no real data: an "
                     "embedded scene of a like shape was run instead, and published numbers are not drawn "
                     "beside it.</p>\n";
        html_ += "<p>A verdict compares <code>" + xml_escaped(solver_methods().front().name) +
                 "</code> with <code>classic</code>, the published program step by step, in the same "
                 "experiment: " +
                 badge(Verdict::kept) + " as good to within a tenth, " + badge(Verdict::better) + " less, " +
                 badge(Verdict::worse) + " more of what should be small; " + badge(Verdict::shown) +
                 " is not judged. In the plots frames are counted as in the paper: 0 to 100 out, to 200 "
                 "back, to 300 at "
                 "rest. Methods with fewer frames go the same way in larger steps.</p>\n";
    }

    void findings() {
        const auto has_any = [](const ExperimentResult& result) { return !result.findings.empty(); };
        if (std::none_of(results_.experiments.begin(), results_.experiments.end(), has_any))
            return;
        html_ += "<h2>What is seen</h2>\n";
        table();
        row({"Figure", "Experiment", "", "From the data"}, "th");
        for (const ExperimentResult& result : results_.experiments)
            for (const Finding& finding : result.findings)
                row({finding.figure.empty() ? dash : xml_escaped(finding.figure),
                     xml_escaped(result.experiment->key), badge(finding.verdict), xml_escaped(finding.text)});
        end_table();
    }

    void pictures(const std::vector<Picture>& list, const std::string& who) {
        if (list.empty())
            return;
        html_ += "<div class=\"pictures small\">\n";
        for (const Picture& picture : list)
            html_ += "<figure><img width=\"" + std::to_string(picture.image.width) + "\" height=\"" +
                     std::to_string(picture.image.height) + "\" alt=\"" +
                     xml_escaped(who + ", " + picture.caption) + "\" src=\"data:image/png;base64," +
                     output::picture_base64(picture.image) + "\"/><figcaption>" +
                     xml_escaped(picture.caption) + "</figcaption></figure>\n";
        html_ += "</div>\n";
    }

    static const Finding* finding_of(const ExperimentResult& result, const std::string& about) {
        for (const Finding& finding : result.findings)
            if (!about.empty() && finding.about == about)
                return &finding;
        return nullptr;
    }

    void sentence(const ExperimentResult& result, const std::string& about) {
        if (const Finding* finding = finding_of(result, about))
            html_ += "<p>" +
                     (finding->figure.empty() ? "" : "<b>Fig. " + xml_escaped(finding->figure) + "</b> ") +
                     badge(finding->verdict) + " " + xml_escaped(finding->text) + "</p>\n";
    }

    void plots(const std::vector<Plot>& list, const ExperimentResult* result) {
        if (list.empty())
            return;
        html_ += "<div class=\"plots\">\n";
        for (const Plot& plot : list) {
            html_ += "<figure>" + view::chart_svg(plot.chart, 520, 280) + "<figcaption>";
            if (!plot.figures.empty())
                html_ += "<b>Fig. " + xml_escaped(plot.figures) + "</b> ";
            html_ += xml_escaped(plot.caption);
            if (const Finding* finding = result != nullptr ? finding_of(*result, plot.about) : nullptr)
                html_ += " " + badge(finding->verdict) + " " + xml_escaped(finding->text);
            html_ += "</figcaption></figure>\n";
        }
        html_ += "</div>\n";
    }

    void experiment(const ExperimentResult& result) {
        const Experiment& e = *result.experiment;
        html_ += "<h2>" + xml_escaped(e.title) + (result.real ? "" : " (stand-in)") +
                 "</h2>\n<p class=\"dim\">Figures " + xml_escaped(e.figures) + " of the paper.";
        for (const std::string& note : result.notes)
            if (note.starts_with("not in the data"))
                html_ += " " + xml_escaped(note) + ".";
        html_ += "</p>\n";
        sentence(result, "displacement_mean_mm");
        sentence(result, "fibre_rest_length");
        for (const MethodRun& run : result.runs) {
            if (!run.done()) {
                html_ += "<p class=\"alarm\">" + xml_escaped(run.method + ": " + run.failure) + "</p>\n";
                continue;
            }
            if (!run.pictures.empty())
                html_ += "<h3>" + xml_escaped(run.method) + "</h3>\n";
            pictures(run.pictures, e.key + " with " + run.method);
            if (!run.fibre_pictures.empty())
                html_ += "<h3>Fibres by " + xml_escaped(e.fibres) + "</h3>\n";
            pictures(run.fibre_pictures, e.key + ", fibres");
        }
        numbers(result);
        plots(experiment_plots(result), &result);
    }

    void numbers(const ExperimentResult& result) {
        table();
        row({"Method", "Frames", "Triangles", "Volume off by at most, %", "Mean edge at 100",
             "99th percentile at 100", "Mean edge at the end", "Dihedral change at 100, deg",
             "at the end, deg", "Displaced at the end, mm", "Most vertices in bone"},
            "th", 1);
        for (const MethodRun& run : result.runs) {
            if (!run.done())
                continue;
            const RunData& data = run.run;
            const std::size_t at = data.flexed(), end = data.frame.size() - 1;
            const double deg = 180 / std::numbers::pi;
            row({xml_escaped(run.method), std::to_string(data.last_frame), whole_number(data.triangles),
                 cell(100 * farthest(data.metric("volume_ratio"), 1)),
                 cell(data.metric("edge_extension_mean")[at], 4), cell(data.metric("edge_extension_p99")[at]),
                 cell(data.metric("edge_extension_mean")[end], 4),
                 cell(deg * data.metric("dihedral_change_mean_rad")[at]),
                 cell(deg * data.metric("dihedral_change_mean_rad")[end]),
                 cell(data.metric("displacement_mean_mm")[end]),
                 cell(span_of(data.metric("penetrating_vertices")).greatest)},
                "td", 1);
        }
        end_table();
    }

    void distances() {
        html_ += "<h2>Against finite elements</h2>\n";
        bool any = false;
        for (const ExperimentResult& result : results_.experiments)
            any = any || !result.reference.empty();
        if (!any) {
            html_ += "<p>There is no finite-element run to measure against: the method <code>fem</code> is "
                     "not in this "
                     "program, was not asked for, or failed.</p>\n";
            return;
        }
        html_ += "<p>Distance of the surface to that of <code>fem</code> on the same mesh at the end of "
                 "flexion (1 rad), "
                 "over the vertices of both.</p>\n";
        table();
        row({"Experiment", "Method", "Mean, mm", "Greatest, mm"}, "th", 2);
        for (const ExperimentResult& result : results_.experiments)
            for (const MethodRun& run : result.runs)
                if (run.to_reference)
                    row({xml_escaped(result.experiment->key), xml_escaped(run.method),
                         cell(run.to_reference->mean), cell(run.to_reference->max)},
                        "td", 2);
        end_table();
    }

    void arms() {
        bool any = false;
        for (const ExperimentResult& result : results_.experiments)
            any = any || !result.arms.empty();
        if (!any)
            return;
        html_ += "<h2>Moment arms</h2>\n<p>About flexion, positive for a flexor, over the poses of the way "
                 "out. Inside: within "
                 "the digitised bounds of the literature (Modenese &amp; Kohout 2020).</p>\n";
        table();
        row({"Experiment", "Who", "Poses inside, %", "Poses and fibres inside, %", "Least mean arm, mm",
             "Mean, mm", "Greatest, mm"},
            "th", 2);
        for (const ExperimentResult& result : results_.experiments) {
            for (const ArmShare& share : result.arms)
                row({xml_escaped(result.experiment->key) + (result.real ? "" : " (stand-in)"),
                     xml_escaped(share.who), cell(share.inside_percent), cell(share.fibres_inside_percent),
                     cell(share.arm_mm.least), cell(share.arm_mm.mean), cell(share.arm_mm.greatest)},
                    "td", 2);
            if (result.arms.empty() || !result.real)
                continue;
            for (const PublishedArm& arm : published_arms())
                if (result.experiment->muscle == arm.muscle &&
                    result.experiment->methods == MethodChoice::all)
                    row({xml_escaped(result.experiment->key),
                         xml_escaped(std::string("published: ") + arm.model), dash, dash, cell(arm.least),
                         cell(arm.mean), cell(arm.greatest)},
                        "td", 2);
        }
        end_table();
    }

    void sensitivity() {
        const SensitivityResult& s = results_.sensitivity;
        html_ += "<h2>Mesh and passes</h2>\n";
        if (!s.missing.empty()) {
            html_ += "<p>Left out: " + xml_escaped(s.missing) + ".</p>\n";
            return;
        }
        html_ +=
            "<p>" + xml_escaped(s.experiment) + (s.real ? "" : " (stand-in)") + " with <code>" +
            xml_escaped(s.method) +
            "</code> at the end of flexion; in brackets how far a number moves. Finer and coarser meshes are "
            "held against one of even triangles, as many as given; passes against the mesh as given.</p>\n";
        table();
        std::vector<std::string> heads{"Variant", "Triangles", "Passes"};
        for (const std::string& quantity : s.quantities)
            heads.push_back(xml_escaped(quantity));
        row(heads, "th", 1);
        for (const SensitivityVariant& v : s.variants) {
            std::vector<std::string> cells{xml_escaped(v.key), whole_number(v.triangles),
                                           std::to_string(v.passes)};
            if (!v.failure.empty())
                cells.push_back(xml_escaped(v.failure));
            for (std::size_t q = 0; q < v.values.size(); ++q) {
                const double moved = v.values[q] - s.variants[v.base].values[q];
                std::string text = cell(v.values[q], 5);
                if (&v != &s.variants.front() && !s.variants[v.base].values.empty())
                    text += " (" + std::string(moved >= 0 ? "+" : "") + cell(moved, 2) + ")";
                cells.push_back(std::move(text));
            }
            row(cells, "td", 1);
        }
        end_table();
        if (s.parameters.empty())
            return;
        std::string names;
        for (const std::string& key : s.parameters)
            names += (names.empty() ? "" : ", ") + key;
        html_ +=
            "<h3>Parameters whose effect depends on mesh or passes</h3>\n<p>Lowered by a fifth one by one: " +
            xml_escaped(names) +
            ". Named are effects that differ from those on the mesh that theirs is held against by more "
            "than a quarter and by more than noise.</p>\n";
        if (s.dependences.empty()) {
            html_ += "<p>None.</p>\n";
            return;
        }
        table();
        row({"Parameter", "Quantity", "Variant", "Effect there", "Effect at its base"}, "th", 3);
        for (const SensitivityResult::Dependence& d : s.dependences)
            row({"<code>" + xml_escaped(d.parameter) + "</code>", xml_escaped(d.quantity),
                 xml_escaped(d.variant), cell(d.effect), cell(d.effect_at_base)},
                "td", 3);
        end_table();
    }

    void speed() {
        const SpeedResult& s = results_.speed;
        if (s.rows.empty())
            return;
        html_ += "<h2>Speed</h2>\n<p>Frames a second of solving alone, the median over the first frames of "
                 "the motion. Table 1 "
                 "of the paper was measured on an i7-4930K with one thread.</p>\n";
        table();
        row({"Object", "Method", "Triangles", "Threads", "Passes", "Frames/s", "Paper"}, "th", 2);
        for (const SpeedRow& r : s.rows) {
            std::string published = dash;
            for (const PublishedSpeed& p : published_speeds())
                if (static_cast<std::size_t>(p.triangles) == r.triangles)
                    published = cell(p.frames_per_second, 4);
            row({xml_escaped(r.object) + (r.real ? "" : " (embedded)"), xml_escaped(r.method),
                 whole_number(r.triangles), std::to_string(r.threads), std::to_string(r.passes),
                 cell(r.frames_per_second), published},
                "td", 2);
        }
        end_table();
        // The paper's statement is the order alone: the more triangles, the fewer frames.
        const bool kept = std::all_of(s.correlations.begin(), s.correlations.end(),
                                      [](const SpeedResult::Correlation& c) { return c.rho <= -0.9; });
        html_ += "<p style=\"margin-top:10px\"><b>Table 1</b> " +
                 badge(kept ? Verdict::kept : Verdict::shown) +
                 " Rank correlation (Spearman) of frames a second with triangles, \xE2\x88\x92"
                 "1 in the paper (five objects):";
        for (const SpeedResult::Correlation& c : s.correlations)
            html_ += (&c == &s.correlations.front() ? " " : "; ") + xml_escaped(c.method) + " on " +
                     std::to_string(c.threads) + (c.threads == 1 ? " thread " : " threads ") + cell(c.rho) +
                     " (" + std::to_string(c.objects) + " objects)";
        html_ += ".</p>\n";
        plots(speed_plots(s), nullptr);
    }

    void left_out() {
        std::string rows;
        for (const ExperimentResult& result : results_.experiments)
            if (!result.missing.empty())
                rows += "<li>" +
                        xml_escaped(result.experiment->title + " (figures " + result.experiment->figures +
                                    "): " + result.missing) +
                        "</li>\n";
        if (!rows.empty())
            html_ += "<h2>Left out</h2>\n<ul>\n" + rows + "</ul>\n";
    }

    const Results& results_;
    const std::string& date_;
    std::string html_;
};

} // namespace

std::string report_page(const Results& results, const std::string& date) {
    return Page(results, date).write();
}

} // namespace fascicle::reproduce
