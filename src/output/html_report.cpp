#include "output/html_report.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/io/run_writer.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "output/html_parts.hpp"
#include "output/report_charts.hpp"
#include "view/build_draw_list.hpp"
#include "view/chart_svg.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::output {

namespace {

using view::xml_escaped;

class Page {
public:
    explicit Page(const ReportInput& input)
        : input_(input), recording_(*input.recording), scene_(recording_.scene()) {}

    std::string write() {
        head();
        facts();
        pictures();
        plots();
        numbers();
        parameters();
        notes();
        html_ += "<footer>Made by fascicle " + xml_escaped(program_version()) + " on " +
                 xml_escaped(input_.date) +
                 ". This page needs no other file.</footer>\n</main>\n</body>\n</html>\n";
        return std::move(html_);
    }

private:
    void head() {
        const std::string name = xml_escaped(scene_.name);
        html_ += "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                 "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                 "<meta name=\"generator\" content=\"fascicle " +
                 xml_escaped(program_version()) + "\">\n<title>" + name +
                 " \xE2\x80\x93 fascicle</title>\n<style>" + page_style() +
                 "</style>\n</head>\n<body>\n<main>\n<h1>" + name + "</h1>\n<p class=\"dim\">" +
                 xml_escaped(input_.date) + " \xC2\xB7 fascicle " + xml_escaped(program_version()) +
                 " \xC2\xB7 method " + xml_escaped(scene_.parameters.get_choice("solver.method")) + "</p>\n";
        const RunState state = recording_.state();
        const std::string last = std::to_string(recording_.last_frame()->index);
        if (state == RunState::failed)
            html_ += "<p class=\"alarm\">The run failed: " + xml_escaped(recording_.failure()) + "</p>\n";
        else if (state != RunState::finished)
            html_ += "<p class=\"alarm\">The run ended early, with frame " + last + ".</p>\n";
    }

    void row(std::initializer_list<std::string> cells, const char* tag = "td",
             std::size_t numbers_from = 1000) {
        html_ += "<tr>";
        std::size_t i = 0;
        for (const std::string& cell : cells) {
            html_ += std::string("<") + tag + (i++ >= numbers_from ? " class=\"n\">" : ">") + cell + "</" +
                     tag + ">";
        }
        html_ += "</tr>\n";
    }

    void facts() {
        html_ += "<h2>Scene</h2>\n<div class=\"wide\"><table>\n";
        row({"Part", "Name", "Vertices", "Triangles", "Attached vertices"}, "th", 2);
        const auto attachments = recording_.attachments();
        for (std::size_t m = 0; m < scene_.muscles.size(); ++m) {
            std::size_t origin = 0, insertion = 0, other = 0;
            if (m < attachments.size())
                for (const Attachment& a : attachments[m])
                    (a.kind == AttachmentKind::origin      ? origin
                     : a.kind == AttachmentKind::insertion ? insertion
                                                           : other) += a.vertices.size();
            std::string attached;
            const auto add = [&](std::size_t count, const char* what) {
                if (count > 0)
                    attached += (attached.empty() ? "" : ", ") + whole_number(count) + what;
            };
            add(origin, " origin");
            add(insertion, " insertion");
            add(other, attached.empty() ? "" : " other");
            body("Muscle", scene_.muscles[m].name, *scene_.muscles[m].mesh,
                 attached.empty() ? "none" : attached);
        }
        for (const Bone& bone : scene_.bones)
            body("Bone", bone.name, *bone.mesh, "");
        html_ += "</table></div>\n<p style=\"margin-top:12px\">" + motion() + "</p>\n";
    }

    void body(const char* part, const std::string& name, const TriMesh& mesh, const std::string& attached) {
        row({part, xml_escaped(name), whole_number(static_cast<std::size_t>(mesh.vertex_count())),
             whole_number(static_cast<std::size_t>(mesh.triangle_count())), attached},
            "td", 2);
    }

    std::string motion() const {
        const int last = recording_.last_frame()->index;
        std::string text = std::to_string(last + 1) +
                           (last == 0 ? " frame" : " frames, 0 to " + std::to_string(last)) + " of " +
                           short_number(1000 * scene_.parameters.get("solver.frame_time")) +
                           " ms; lengths in " + to_text(scene_.unit) + ".";
        double low = 0, high = 0;
        const int count = static_cast<int>(input_.rows.size());
        for (int k = 0; k < count; ++k) {
            const double angle = recording_.frame(k)->angle_rad * 180 / std::numbers::pi;
            low = std::min(low, angle);
            high = std::max(high, angle);
        }
        if (high - low > 1e-6)
            text += " The joint turns from " + short_number(low) + "\xC2\xB0 to " + short_number(high) +
                    "\xC2\xB0.";
        if (input_.furthest > 0)
            text += " The bones are furthest from rest in frame " +
                    std::to_string(recording_.frame(input_.furthest)->index) +
                    ", which a line marks in the plots.";
        return text;
    }

    void pictures() {
        if (input_.pictures.empty())
            return;
        html_ += "<h2>Pictures</h2>\n<div class=\"pictures\">\n";
        for (const ReportPicture& picture : input_.pictures) {
            const render::Image& image = picture.image;
            const double angle = angle_of(picture.frame);
            const std::string caption =
                "frame " + std::to_string(picture.frame) + ", " + short_number(angle) + "\xC2\xB0";
            html_ += "<figure><img width=\"" + std::to_string(image.width) + "\" height=\"" +
                     std::to_string(image.height) + "\" alt=\"" +
                     xml_escaped(picture.title + ", " + caption) + "\" src=\"data:image/png;base64," +
                     picture_base64(image) + "\">\n<figcaption><b>" + xml_escaped(picture.title) + "</b>, " +
                     caption;
            if (picture.title == strain_title)
                html_ += strain_bar();
            html_ += "</figcaption></figure>\n";
        }
        html_ += "</div>\n";
    }

    double angle_of(int frame) const {
        const int count = static_cast<int>(input_.rows.size());
        for (int k = 0; k < count; ++k)
            if (recording_.frame(k)->index == frame)
                return recording_.frame(k)->angle_rad * 180 / std::numbers::pi;
        return 0;
    }

    /// The scale of the strain's colours.
    static std::string strain_bar() {
        const view::ColourScale scale = view::colouring_row(view::Colouring::strain).scale;
        std::string stops;
        for (int i = 0; i <= 16; ++i) {
            const render::Rgba c = scale.colour(scale.low + (scale.high - scale.low) * i / 16);
            stops += i > 0 ? ", rgb(" : "rgb(";
            for (std::size_t k = 0; k < 3; ++k)
                stops += (k > 0 ? "," : "") + std::to_string(std::lround(c[k] * 255));
            stops += ")";
        }
        return ", mean length of the edges at a point over that at rest\n<span class=\"bar\">" +
               short_number(scale.low) + "<i style=\"background:linear-gradient(to right, " + stops +
               ")\"></i>" + short_number(scale.high) + "</span>";
    }

    void plots() {
        const std::vector<ReportChart> charts = report_charts(input_);
        if (charts.empty() || input_.rows.size() < 2)
            return;
        html_ += "<h2>Plots</h2>\n<div class=\"plots\">\n";
        for (const ReportChart& chart : charts)
            html_ += "<figure><div class=\"light\">" + view::chart_svg(chart.light, 520, 260) +
                     "</div><div class=\"dark\">" + view::chart_svg(chart.dark, 520, 260, true) +
                     "</div>\n<figcaption>" + xml_escaped(chart.sentence) + "</figcaption></figure>\n";
        html_ += "</div>\n";
    }

    /// Least and greatest of a metric, or a dash.
    std::string range(std::size_t m, const char* key, int digits = 4) const {
        const std::vector<double> y = metric_series(input_, m, key);
        const Extremes e = extremes(y);
        if (e.least < 0)
            return "\xE2\x80\x93";
        const std::string low = short_number(y[static_cast<std::size_t>(e.least)], digits),
                          high = short_number(y[static_cast<std::size_t>(e.greatest)], digits);
        return low == high ? low : low + " \xE2\x80\xA6 " + high;
    }
    std::string most(std::size_t m, const char* key) const {
        const std::vector<double> y = metric_series(input_, m, key);
        const Extremes e = extremes(y);
        return e.greatest < 0 ? "\xE2\x80\x93" : short_number(y[static_cast<std::size_t>(e.greatest)], 3);
    }

    void numbers() {
        struct Line {
            const char* label;
            const char* unit;
            const char* key;
            bool range;
            int digits = 4;
        };
        static const Line lines[] = {
            {"Volume", "cm\xC2\xB3", "volume_cm3", true},
            {"Volume ratio", "", "volume_ratio", true, 5},
            {"Mean edge extension", "", "edge_extension_mean", true},
            {"Edge extension, 99th percentile, greatest", "", "edge_extension_p99", false},
            {"Mean dihedral change, greatest", "rad", "dihedral_change_mean_rad", false},
            {"Vertices deeper than 0.1 mm in a bone, most", "", "penetrating_vertices", false},
            {"Greatest depth in a bone", "mm", "penetration_max_mm", false},
            {"Overlap with other muscles, greatest", "mm", "muscle_overlap_mm", false},
            {"Displacement from rest, greatest", "mm", "displacement_max_mm", false},
            {"Mean fibre length", "mm", "fibre_length_mean_mm", true},
            {"Mean fibre strain", "", "fibre_strain_mean", true},
            {"Mean moment arm", "mm", "moment_arm_mean_mm", true},
            {"Physiological cross-section", "cm\xC2\xB2", "pcsa_cm2", true},
        };
        html_ += "<h2>Numbers</h2>\n<p class=\"dim\">Over all frames: least \xE2\x80\xA6 greatest, or the "
                 "greatest alone.</p>\n"
                 "<div class=\"wide\"><table>\n<tr><th>Quantity</th>";
        for (const Muscle& muscle : scene_.muscles)
            html_ += "<th class=\"n\">" + xml_escaped(muscle.name) + "</th>";
        html_ += "</tr>\n";
        for (const Line& line : lines) {
            std::string cells;
            bool any = false;
            for (std::size_t m = 0; m < scene_.muscles.size(); ++m) {
                const std::string value = line.range ? range(m, line.key, line.digits) : most(m, line.key);
                any = any || value != "\xE2\x80\x93";
                cells += "<td class=\"n\">" + value + "</td>";
            }
            if (any)
                html_ += "<tr><td>" + std::string(line.label) +
                         (*line.unit != 0 ? " [" + std::string(line.unit) + "]" : "") + "</td>" + cells +
                         "</tr>\n";
        }
        html_ += "</table></div>\n";
        const RunSpeed speed = run_speed(recording_);
        if (speed.solve_seconds > 0)
            html_ += "<p style=\"margin-top:12px\">Solved in " + short_number(speed.solve_seconds) + " s, " +
                     short_number(speed.fps_median) + " frames a second in the median" +
                     (recording_.prepare_seconds() > 0
                          ? "; prepared in " + short_number(recording_.prepare_seconds()) + " s"
                          : std::string()) +
                     ". Hash of the last positions: " + state_hash(*recording_.last_frame()) + ".</p>\n";
    }

    void parameters() {
        const ParamSet& set = scene_.parameters;
        ParamSet defaults = default_parameters();
        set_method(defaults, set.get_choice("solver.method"));
        std::string rows;
        std::swap(rows, html_);
        for (const ParamRow& p : set.table().rows())
            if (p.key != "solver.method" && set.get(p.key) != defaults.get(p.key))
                row({xml_escaped(p.label), "<code>" + xml_escaped(p.key) + "</code>", value_text(set, p),
                     value_text(defaults, p), p.unit == "1" ? "" : xml_escaped(p.unit)},
                    "td", 2);
        std::swap(rows, html_);
        html_ += "<h2>Parameters</h2>\n";
        if (rows.empty()) {
            html_ += "<p>All parameters have the defaults of the method " +
                     xml_escaped(set.get_choice("solver.method")) + ".</p>\n";
            return;
        }
        html_ += "<p class=\"dim\">Those that differ from the defaults of the method " +
                 xml_escaped(set.get_choice("solver.method")) + ".</p>\n<div class=\"wide\"><table>\n";
        row({"Parameter", "Key", "Value", "Default", "Unit"}, "th", 2);
        html_ += rows + "</table></div>\n";
    }
    static std::string value_text(const ParamSet& set, const ParamRow& row) {
        return xml_escaped(row.kind == ParamKind::choice ? set.get_choice(row.key) : set.text(row.key));
    }

    void notes() {
        const std::vector<std::string> notes = recording_.notes();
        html_ += "<h2>Notes</h2>\n";
        if (notes.empty()) {
            html_ += "<p>Nothing had to be mended, attached or assumed.</p>\n";
            return;
        }
        html_ += "<ul>\n";
        for (const std::string& note : notes)
            html_ += "<li>" + xml_escaped(note) + "</li>\n";
        html_ += "</ul>\n";
    }

    const ReportInput& input_;
    const Recording& recording_;
    const Scene& scene_;
    std::string html_;
};

} // namespace

std::string html_report(const ReportInput& input) {
    return Page(input).write();
}

} // namespace fascicle::output
