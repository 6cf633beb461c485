// The sections of the report that hold methods against others' numbers.

#include "output/html_parts.hpp"
#include "reproduce/findings.hpp"
#include "reproduce/page_writer.hpp"
#include "reproduce/published.hpp"
#include "reproduce/words.hpp"
#include "view/chart_svg.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace fascicle::reproduce {

namespace {

using output::whole_number;
using view::xml_escaped;

const char* const dash = page_dash;

/// "+0.0017", "-0.8"; what is rounding has no sign.
std::string told_move(double moved) {
    if (!std::isfinite(moved))
        return dash;
    if (std::abs(moved) < 1e-4)
        return moved == 0 ? "0" : xml_escaped(told_number(std::abs(moved)));
    return (moved > 0 ? "+" : "") + told_number(moved, 2);
}

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
        html_ +=
            "<h2>Moment arms</h2>\n<p>Positive for what moves the thigh in the direction of the motion. "
            "Flexion is measured on the way out, adduction and rotation from one side to the other.</p>\n"
            "<h3>Inside the bounds of Blemker &amp; Delp 2005 over the angle</h3>\n";
        page_.table();
        page_.row({"Experiment", "Who", "Poses with the mean inside, %", "Poses and fibres inside, %",
                   "Least mean arm, mm", "Mean, mm", "Greatest, mm"},
                  "th", 2);
        for (const ExperimentResult& result : results_.experiments)
            for (const ArmShare& share : result.arms)
                if (!is_sweep(result.experiment->motion))
                    page_.row({xml_escaped(result.experiment->key) + (result.real ? "" : " (stand-in)"),
                               xml_escaped(share.who), page_.cell(share.inside_percent),
                               page_.cell(share.fibres_inside_percent), page_.cell(share.arm_mm.least),
                               page_.cell(share.arm_mm.mean), page_.cell(share.arm_mm.greatest)},
                              "td", 2);
        page_.end_table();
        published_ranges();
    }

    /// Modenese & Kohout 2020, Table 2: least, mean and greatest over poses and fibres.
    void published_ranges() {
        bool any = false;
        for (const ExperimentResult& result : results_.experiments)
            for (const ArmShare& share : result.arms)
                any = any || !share.table.empty();
        if (!any)
            return;
        html_ +=
            "<h3>Beside Modenese &amp; Kohout 2020, Table 2</h3>\n<p>Least, mean and greatest over poses "
            "and fibres; and the percent of poses whose mean arm is inside each published range. Theirs "
            "are over flexion of \xE2\x88\x92"
            "10 to 60\xC2\xB0, ours over 0 to 57\xC2\xB0; over adduction of \xC2\xB1"
            "40\xC2\xB0 and rotation of \xC2\xB1"
            "30\xC2\xB0 both.</p>\n";
        page_.table();
        page_.row({"Experiment", "Motion", "Who", "Least, mm", "Mean, mm", "Greatest, mm",
                   "In 100 fibres\xE2\x80\x99, %", "In lines\xE2\x80\x99, %",
                   "In Blemker &amp; Delp\xE2\x80\x99s, %"},
                  "th", 3);
        for (const ExperimentResult& result : results_.experiments) {
            const std::string key = xml_escaped(result.experiment->key),
                              motion = to_text(result.experiment->motion);
            const ArmShare* last = nullptr;
            for (const ArmShare& share : result.arms) {
                if (share.table.empty())
                    continue;
                last = &share;
                std::vector<std::string> cells{key,
                                               motion,
                                               xml_escaped(share.who),
                                               page_.cell(share.all_mm.least),
                                               page_.cell(share.all_mm.mean),
                                               page_.cell(share.all_mm.greatest)};
                for (const TableShare& column : share.table)
                    cells.push_back(page_.cell(column.poses_percent));
                page_.row(cells, "td", 3);
            }
            if (last == nullptr || result.experiment->key.ends_with("-chmd"))
                continue;
            for (const TableShare& row : last->table)
                page_.row({key, motion, xml_escaped("published: " + row.model), page_.cell(row.arm_mm.least),
                           page_.cell(row.arm_mm.mean), page_.cell(row.arm_mm.greatest), dash, dash, dash},
                          "td", 3);
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
            // One that failed has no numbers, or not those of all its runs.
            const std::size_t quantities = v.failure.empty() ? v.values.size() : 0;
            if (!v.failure.empty())
                cells.push_back(xml_escaped(v.failure));
            const std::vector<double>& base = s.variants[v.base].values;
            for (std::size_t q = 0; q < quantities; ++q) {
                std::string text = page_.cell(v.values[q], 5);
                if (&v != &s.variants.front() && q < base.size())
                    text += " (" + told_move(v.values[q] - base[q]) + ")";
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
        if (s.rows.empty() && s.failures.empty())
            return;
        html_ += "<h2>Speed</h2>\n<p>Frames a second of solving alone, the median over the first frames of "
                 "the motion. Table 1 "
                 "of the paper was measured on an i7-4930K with one thread, the public program for these "
                 "notes on a "
                 "2-core Xeon with one thread. <code>classic</code> steps on one thread, as that program "
                 "does.</p>\n";
        page_.table();
        page_.row(
            {"Object", "Method", "Triangles", "Threads", "Passes", "Frames/s", "Paper", "Public program"},
            "th", 2);
        std::set<int> measured;
        for (const SpeedRow& r : s.rows) {
            std::string paper = dash, program = dash;
            for (const PublishedSpeed& p : published_speeds())
                if (static_cast<std::size_t>(p.triangles) == r.triangles) {
                    paper = page_.cell(p.frames_per_second, 4);
                    program = page_.cell(p.program_frames_per_second);
                    measured.insert(p.triangles);
                }
            page_.row({xml_escaped(r.object) + (r.real ? "" : " (embedded)"), xml_escaped(r.method),
                       whole_number(r.triangles), std::to_string(r.threads), std::to_string(r.passes),
                       page_.cell(r.frames_per_second), paper, program},
                      "td", 2);
        }
        for (const PublishedSpeed& p : published_speeds())
            if (!measured.contains(p.triangles))
                page_.row({std::string(p.object) + " (not here)", dash,
                           whole_number(static_cast<std::size_t>(p.triangles)), dash, dash, dash,
                           page_.cell(p.frames_per_second, 4), page_.cell(p.program_frames_per_second)},
                          "td", 2);
        page_.end_table();
        for (const std::string& failure : s.failures)
            html_ += "<p>Not measured: " + xml_escaped(failure) + "</p>\n";
        if (s.rows.empty())
            return;
        const Finding finding = judge_speed(s);
        page_.plots(speed_plots(s), {finding});
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
