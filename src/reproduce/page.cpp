#include "reproduce/page.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "output/html_parts.hpp"
#include "output/report_charts.hpp"
#include "reproduce/charts.hpp"
#include "reproduce/findings.hpp"
#include "reproduce/page_writer.hpp"
#include "reproduce/words.hpp"
#include "view/chart_svg.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::reproduce {

namespace {

using output::short_number;
using output::whole_number;
using view::xml_escaped;

class Page {
public:
    Page(const Results& results, const std::string& date) : results_(results), date_(date) {}

    std::string write() {
        head();
        findings();
        for (const ExperimentResult& result : results_.experiments)
            if (result.missing.empty())
                experiment(result);
        write_validation(page_, results_);
        left_out();
        html_ +=
            "<footer>Made by fascicle " + xml_escaped(program_version()) + " on " + xml_escaped(date_) +
            " in " + short_number(results_.seconds) +
            " s. This page needs no other file. All numbers: results.json and the tables beside it; times: "
            "timings.json.</footer>\n</main>\n</body>\n</html>\n";
        return std::move(html_);
    }

private:
    void head() {
        std::string methods;
        for (const std::string& name : results_.methods)
            methods += (methods.empty() ? "" : ", ") + name;
        html_ += "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
                 "<meta charset=\"utf-8\"/>\n"
                 "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                 "<meta name=\"generator\" content=\"fascicle " +
                 xml_escaped(program_version()) +
                 "\"/>\n<title>Cervenka &amp; Kohout 2020, reproduced</title>\n<style>" + report_style() +
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
        if (results_.is_short)
            html_ += "<p class=\"alarm\">Short form: so few frames show that everything works; they are no "
                     "figures to keep.</p>\n";
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
                 page_.badge(Verdict::kept) + " as good to within a tenth, " + page_.badge(Verdict::better) +
                 " less, " + page_.badge(Verdict::worse) + " more of what should be small; " +
                 page_.badge(Verdict::shown) +
                 " is not judged. Where the published run is repeated literally, <code>classic</code> is "
                 "compared with "
                 "the published program\xE2\x80\x99s own numbers; moment arms are compared with published "
                 "ranges. In the plots frames are counted as in the paper: 0 to 100 out, to 200 "
                 "back, to 300 at "
                 "rest. Methods with fewer frames go the same way in larger steps.</p>\n";
    }

    void findings() {
        const auto has_any = [](const ExperimentResult& result) { return !result.findings.empty(); };
        if (std::none_of(results_.experiments.begin(), results_.experiments.end(), has_any))
            return;
        html_ += "<h2>What is seen</h2>\n";
        page_.table();
        page_.row({"Figure", "Experiment", "", "From the data"}, "th");
        for (const ExperimentResult& result : results_.experiments)
            for (const Finding& finding : result.findings)
                page_.row({finding.figure.empty() ? page_dash : xml_escaped(finding.figure),
                           xml_escaped(result.experiment->key), page_.badge(finding.verdict),
                           xml_escaped(finding.text)});
        page_.end_table();
    }

    void experiment(const ExperimentResult& result) {
        const Experiment& e = *result.experiment;
        html_ += "<h2>" + xml_escaped(e.title) + (result.real ? "" : " (stand-in)") +
                 "</h2>\n<p class=\"dim\">" +
                 (e.figures.empty() ? std::string("Not in the paper; after Modenese &amp; Kohout 2020.")
                                    : told_figures(e.figures) + " of the paper.");
        for (const std::string& note : result.notes)
            if (note.starts_with("not in the data"))
                html_ += " " + xml_escaped(note) + ".";
        html_ += "</p>\n";
        page_.sentence(result.findings, "displacement_mean_mm");
        page_.sentence(result.findings, "fibre_rest_length");
        std::vector<Picture> others;
        for (const MethodRun& run : result.runs) {
            if (!run.done()) {
                html_ += "<p class=\"alarm\">" + xml_escaped(run.method + ": " + run.failure) + "</p>\n";
                continue;
            }
            if (run.pictures.size() <= 2) { // of rivals, side by side
                for (Picture picture : run.pictures) {
                    picture.caption = run.method + ", " + picture.caption;
                    others.push_back(std::move(picture));
                }
                continue;
            }
            html_ += "<h3>" + xml_escaped(run.method) + "</h3>\n";
            page_.pictures(run.pictures, e.key + " with " + run.method);
        }
        if (!others.empty())
            html_ += std::string("<h3>") + (e.motion == MotionKind::squeeze ? "Squeezed" : "Flexed") +
                     " and at the end</h3>\n";
        page_.pictures(others, e.key);
        for (const MethodRun& run : result.runs) {
            if (!run.fibre_pictures.empty())
                html_ += "<h3>Fibres by " + xml_escaped(fibre_method(e)) + "</h3>\n";
            page_.pictures(run.fibre_pictures, e.key + ", fibres");
            if (!run.line_pictures.empty())
                html_ += "<h3>Line segments of the model, in blue</h3>\n<p><b>Fig. 22</b> The lines have via "
                         "points and wrap over surfaces of their own; their moment arms are below.</p>\n";
            page_.pictures(run.line_pictures, e.key + ", line segments");
        }
        numbers(result);
        page_.plots(experiment_plots(result), result.findings);
    }

    void numbers(const ExperimentResult& result) {
        page_.table();
        page_.row({"Method", "Frames", "Triangles", "Volume off by at most, %", "Mean edge at 100",
                   "99th percentile at 100", "Mean edge at the end", "Dihedral change at 100, deg",
                   "at the end, deg", "Displaced at the end, mm", "Most vertices in bone"},
                  "th", 1);
        for (const MethodRun& run : result.runs) {
            if (!run.done())
                continue;
            const RunData& data = run.run;
            const std::size_t at = data.flexed(), end = data.frame.size() - 1;
            const double deg = 180 / std::numbers::pi;
            page_.row({xml_escaped(run.method), std::to_string(data.last_frame), whole_number(data.triangles),
                       page_.cell(100 * farthest(data.metric("volume_ratio"), 1)),
                       page_.cell(data.metric("edge_extension_mean")[at], 4),
                       page_.cell(data.metric("edge_extension_p99")[at]),
                       page_.cell(data.metric("edge_extension_mean")[end], 4),
                       page_.cell(deg * data.metric("dihedral_change_mean_rad")[at]),
                       page_.cell(deg * data.metric("dihedral_change_mean_rad")[end]),
                       page_.cell(data.metric("displacement_mean_mm")[end]),
                       page_.cell(span_of(data.metric("penetrating_vertices")).greatest)},
                      "td", 1);
        }
        page_.end_table();
    }

    void left_out() {
        std::string rows;
        for (const ExperimentResult& result : results_.experiments)
            if (!result.missing.empty())
                rows += "<li>" +
                        xml_escaped(result.experiment->title +
                                    (result.experiment->figures.empty()
                                         ? ""
                                         : " (" + told_figures(result.experiment->figures) + ")") +
                                    ": " + result.missing) +
                        "</li>\n";
        if (!rows.empty())
            html_ += "<h2>Left out</h2>\n<ul>\n" + rows + "</ul>\n";
    }

    const Results& results_;
    const std::string& date_;
    PageWriter page_;
    std::string& html_ = page_.html;
};

} // namespace

std::string report_page(const Results& results, const std::string& date) {
    return Page(results, date).write();
}

} // namespace fascicle::reproduce
