// The sections of the report that hold methods against others' numbers.

#include "output/html_parts.hpp"
#include "output/report_charts.hpp"
#include "reproduce/page_writer.hpp"
#include "reproduce/published.hpp"
#include "view/chart_svg.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::reproduce {

namespace {

using output::whole_number;
using view::xml_escaped;

const char* const dash = page_dash;

class Validation {
public:
    Validation(PageWriter& page, const Results& results) : page_(page), html_(page.html), results_(results) {}
    void write() {
        distances();
        arms();
        sensitivity();
        speed();
    }

private:
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
        page_.table();
        page_.row({"Experiment", "Method", "Mean, mm", "Greatest, mm"}, "th", 2);
        for (const ExperimentResult& result : results_.experiments)
            for (const MethodRun& run : result.runs)
                if (run.to_reference)
                    page_.row({xml_escaped(result.experiment->key), xml_escaped(run.method),
                               page_.cell(run.to_reference->mean), page_.cell(run.to_reference->max)},
                              "td", 2);
        page_.end_table();
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
        page_.table();
        page_.row({"Experiment", "Who", "Poses inside, %", "Poses and fibres inside, %", "Least mean arm, mm",
                   "Mean, mm", "Greatest, mm"},
                  "th", 2);
        for (const ExperimentResult& result : results_.experiments) {
            for (const ArmShare& share : result.arms)
                page_.row({xml_escaped(result.experiment->key) + (result.real ? "" : " (stand-in)"),
                           xml_escaped(share.who), page_.cell(share.inside_percent),
                           page_.cell(share.fibres_inside_percent), page_.cell(share.arm_mm.least),
                           page_.cell(share.arm_mm.mean), page_.cell(share.arm_mm.greatest)},
                          "td", 2);
            if (result.arms.empty() || !result.real)
                continue;
            for (const PublishedArm& arm : published_arms())
                if (result.experiment->muscle == arm.muscle &&
                    result.experiment->methods == MethodChoice::all)
                    page_.row({xml_escaped(result.experiment->key),
                               xml_escaped(std::string("published: ") + arm.model), dash, dash,
                               page_.cell(arm.least), page_.cell(arm.mean), page_.cell(arm.greatest)},
                              "td", 2);
        }
        page_.end_table();
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
        page_.table();
        std::vector<std::string> heads{"Variant", "Triangles", "Passes"};
        for (const std::string& quantity : s.quantities)
            heads.push_back(xml_escaped(quantity));
        page_.row(heads, "th", 1);
        for (const SensitivityVariant& v : s.variants) {
            std::vector<std::string> cells{xml_escaped(v.key), whole_number(v.triangles),
                                           std::to_string(v.passes)};
            if (!v.failure.empty())
                cells.push_back(xml_escaped(v.failure));
            for (std::size_t q = 0; q < v.values.size(); ++q) {
                const double moved = v.values[q] - s.variants[v.base].values[q];
                std::string text = page_.cell(v.values[q], 5);
                if (&v != &s.variants.front() && !s.variants[v.base].values.empty())
                    text += " (" + std::string(moved >= 0 ? "+" : "") + page_.cell(moved, 2) + ")";
                cells.push_back(std::move(text));
            }
            page_.row(cells, "td", 1);
        }
        page_.end_table();
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
        page_.table();
        page_.row({"Parameter", "Quantity", "Variant", "Effect there", "Effect at its base"}, "th", 3);
        for (const SensitivityResult::Dependence& d : s.dependences)
            page_.row({"<code>" + xml_escaped(d.parameter) + "</code>", xml_escaped(d.quantity),
                       xml_escaped(d.variant), page_.cell(d.effect), page_.cell(d.effect_at_base)},
                      "td", 3);
        page_.end_table();
    }

    void speed() {
        const SpeedResult& s = results_.speed;
        if (s.rows.empty())
            return;
        html_ += "<h2>Speed</h2>\n<p>Frames a second of solving alone, the median over the first frames of "
                 "the motion. Table 1 "
                 "of the paper was measured on an i7-4930K with one thread.</p>\n";
        page_.table();
        page_.row({"Object", "Method", "Triangles", "Threads", "Passes", "Frames/s", "Paper"}, "th", 2);
        for (const SpeedRow& r : s.rows) {
            std::string published = dash;
            for (const PublishedSpeed& p : published_speeds())
                if (static_cast<std::size_t>(p.triangles) == r.triangles)
                    published = page_.cell(p.frames_per_second, 4);
            page_.row({xml_escaped(r.object) + (r.real ? "" : " (embedded)"), xml_escaped(r.method),
                       whole_number(r.triangles), std::to_string(r.threads), std::to_string(r.passes),
                       page_.cell(r.frames_per_second), published},
                      "td", 2);
        }
        page_.end_table();
        // The paper's statement is the order alone: the more triangles, the fewer frames.
        const bool kept = std::all_of(s.correlations.begin(), s.correlations.end(),
                                      [](const SpeedResult::Correlation& c) { return c.rho <= -0.9; });
        html_ += "<p style=\"margin-top:10px\"><b>Table 1</b> " +
                 page_.badge(kept ? Verdict::kept : Verdict::shown) +
                 " Rank correlation (Spearman) of frames a second with triangles, \xE2\x88\x92"
                 "1 in the paper (five objects):";
        for (const SpeedResult::Correlation& c : s.correlations)
            html_ += (&c == &s.correlations.front() ? " " : "; ") + xml_escaped(c.method) + " on " +
                     std::to_string(c.threads) + (c.threads == 1 ? " thread " : " threads ") +
                     page_.cell(c.rho) + " (" + std::to_string(c.objects) + " objects)";
        html_ += ".</p>\n";
        page_.plots(speed_plots(s), nullptr);
    }

    PageWriter& page_;
    std::string& html_;
    const Results& results_;
};

} // namespace

void write_validation(PageWriter& page, const Results& results) {
    Validation(page, results).write();
}

} // namespace fascicle::reproduce
