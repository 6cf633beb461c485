#include "reproduce/findings.hpp"

#include "fascicle/solver/soft_body_solver.hpp"
#include "output/report_charts.hpp"
#include "reproduce/published.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>

namespace fascicle::reproduce {

namespace {

using output::short_number;

/// A quantity whose size over the run is compared between methods: less is better.
struct Measure {
    const char* about; ///< key of metric_table()
    int figure_group; ///< place in the paper's order of plots: 0 volume, 1 edges, 2 dihedrals; -1 none, -2 its pictures
    double from;   ///< what it is without deformation
    double factor; ///< to the unit that is told
    const char* unit;
    const char* what;  ///< "volume departs from rest by at most"
    double none_below; ///< in the told unit
    bool at_end;       ///< of the last frame, not of the worst
};

const Measure measures[] = {
    {"volume_ratio", 0, 1, 100, " %", "departs from its volume at rest by at most", 0.5, false},
    {"edge_extension_mean", 1, 1, 1, "", "ends with a mean edge extension that is off 1 by", 0.002, true},
    {"dihedral_change_mean_rad", 2, 0, 180 / std::numbers::pi, "\xC2\xB0",
     "ends with a mean dihedral change of", 0.5, true},
    {"penetrating_vertices", -1, 0, 1, "", "has at most this many vertices inside bones:", 0.5, false},
    {"displacement_mean_mm", -2, 0, 1, " mm", "ends away from its rest shape by, in the mean,", 0.1, true},
};

double size_of(const Measure& m, const RunData& run) {
    const std::vector<double> values = run.metric(m.about);
    if (values.empty())
        return std::nan("");
    return m.factor * (m.at_end ? std::abs(values.back() - m.from) : farthest(values, m.from));
}

/// The paper plots volume, edges and dihedrals of box, iliacus and gluteus maximus, in this order: figures 11 to 19; 1 to 8 are pictures.
std::string figure_of(const Experiment& e, int group) {
    if (group == -2)
        return picture_figures(e);
    const int muscle = e.key == "squish-box"        ? 0
                       : e.key == "iliacus"         ? 1
                       : e.key == "gluteus_maximus" ? 2
                                                    : -1;
    return muscle < 0 || group < 0 ? std::string() : std::to_string(11 + 3 * group + muscle);
}

std::string told(double value, const char* unit) {
    if (std::abs(value) >= 1e-4 || !std::isfinite(value))
        return short_number(value, 3) + unit;
    char text[32]; // six decimals: what is less is rounding
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 6);
    const std::string digits(text, end.ptr);
    return (digits.find_first_of("123456789") == std::string::npos ? "0" : digits) + unit;
}

/// ", classic 1.07 %; the worst rival, mass-spring, 12 %"
std::string others(const Measure& m, const ExperimentResult& result, const std::string& own) {
    std::string text;
    const MethodRun* worst = nullptr;
    double most = -1;
    for (const MethodRun& row : result.runs) {
        if (!row.done() || row.method == own)
            continue;
        const double size = size_of(m, row.run);
        if (row.method == "classic")
            text += ", classic " + told(size, m.unit);
        else if (size > most) {
            most = size;
            worst = &row;
        }
    }
    if (worst != nullptr)
        text += "; of the rivals at most " + told(most, m.unit) + " (" + worst->method + ")";
    return text;
}

void judge_measures(ExperimentResult& result, const MethodRun& own, const MethodRun* published) {
    const std::string name = result.experiment->muscle;
    for (const Measure& m : measures) {
        const double ours = size_of(m, own.run);
        if (!std::isfinite(ours))
            continue;
        Finding finding;
        finding.figure = figure_of(*result.experiment, m.figure_group);
        finding.about = m.about;
        if (published != nullptr && published != &own)
            finding.verdict = judge(ours, size_of(m, published->run), m.none_below);
        finding.text = "With " + own.method + " " + name + " " + m.what + " " + told(ours, m.unit) +
                       others(m, result, own.method) + ".";
        result.findings.push_back(std::move(finding));
    }
}

/// Mean fibre length at a frame over that at rest.
double length_ratio(const RunData& run, std::size_t k) {
    const std::vector<double> lengths = run.metric("fibre_length_mean_mm");
    return lengths.at(k) / lengths.at(0);
}

void judge_fibres(ExperimentResult& result, const MethodRun& own) {
    const Experiment& e = *result.experiment;
    if (own.run.fibres.count() == 0)
        return;
    const double flexed = length_ratio(own.run, own.run.flexed()),
                 end = length_ratio(own.run, own.run.frame.size() - 1);
    Finding finding;
    finding.figure = e.key == "iliacus" ? "20" : e.key.starts_with("gluteus_maximus") ? "21" : "";
    finding.about = "fibre_length_mean_mm";
    const bool hip = result.real || e.stand_in == "hip"; // only there it is known what the muscle does
    const bool right_way = !hip || (e.flexor ? flexed < 1 : flexed > 1);
    const bool returns = std::abs(end - 1) < 0.01;
    finding.verdict = right_way && returns ? Verdict::kept : Verdict::worse;
    std::string text = "The fibres are " + short_number(flexed, 3) +
                       " times as long at the end of the way out as at rest" +
                       (!hip       ? ""
                        : e.flexor ? " (a flexor must shorten)"
                                   : " (an extensor must lengthen)") +
                       "; at the end they are back to within " + told(100 * std::abs(end - 1), " %");
    if (result.real)
        for (const PublishedRatio& ratio : published_ratios())
            if (ratio.muscle == e.muscle && ratio.angle_deg > 50)
                text += "; published: " + short_number(ratio.mean) + " (" + short_number(ratio.least) +
                        " to " + short_number(ratio.greatest) + ") at " + short_number(ratio.angle_deg) +
                        "\xC2\xB0";
    finding.text = text + ".";
    result.findings.push_back(std::move(finding));
}

/// Figures 9 and 10: the decompositions at rest.
void tell_decomposition(ExperimentResult& result, const MethodRun& own) {
    const Experiment& e = *result.experiment;
    const LineNumbers& fibres = own.run.fibres;
    if (fibres.count() == 0)
        return;
    std::vector<double> lengths;
    for (std::size_t f = 0; f < fibres.count(); ++f)
        lengths.push_back(fibres.length(0, f));
    const double mean = span_of(lengths).mean;
    double squares = 0;
    for (const double length : lengths)
        squares += (length - mean) * (length - mean);
    Finding finding;
    finding.figure = e.fibres == "chmd" ? "10" : e.key == "gluteus_maximus" ? "9" : "";
    finding.about = "fibre_rest_length";
    finding.text = std::to_string(fibres.count()) + " fibres by " + e.fibres + ", at rest " +
                   short_number(mean) + " mm long in the mean (sd " +
                   short_number(std::sqrt(squares / static_cast<double>(lengths.size())), 2) + ")";
    if (const PublishedRest* rest = published_rest(e.muscle); rest != nullptr && result.real)
        finding.text += "; published, with outlines of their own: " + short_number(rest->mean_mm) + " (sd " +
                        short_number(rest->sd_mm, 2) + ")";
    finding.text += ".";
    result.findings.push_back(std::move(finding));
}

void judge_arms(ExperimentResult& result) {
    std::string text;
    double own = std::nan(""), least = std::nan("");
    for (const ArmShare& share : result.arms) {
        if (!std::isfinite(share.inside_percent))
            continue;
        text += (text.empty() ? "" : ", ") + share.who + " " + short_number(share.inside_percent, 3) + " %";
        if (share.who == solver_methods().front().name)
            own = share.inside_percent;
        else if (!(least <= share.inside_percent))
            least = share.inside_percent;
    }
    if (text.empty())
        return;
    Finding finding;
    finding.figure = "22";
    finding.about = "moment_arm_mm";
    finding.verdict = own >= 99.5 ? Verdict::kept : own < 50 ? Verdict::worse : Verdict::shown;
    finding.text = "Poses whose mean moment arm is inside the digitised literature's bounds: " + text + ".";
    result.findings.push_back(std::move(finding));
}

/// The literal repetition against the published program's own numbers.
void judge_literal(ExperimentResult& result, const MethodRun& run) {
    const std::vector<PublishedFrame>& marks = published_marks(result.experiment->published);
    if (marks.empty())
        return;
    struct Column {
        const char* key;
        double PublishedFrame::*mark;
        const char* label;
        double same_below;
    };
    const Column columns[] = {
        {"volume_ratio", &PublishedFrame::volume_ratio, "volume ratio", 0.01},
        {"edge_extension_mean", &PublishedFrame::edge_mean, "mean edge extension", 0.03},
        {"dihedral_change_unsigned_mean_deg", &PublishedFrame::dihedral_deg,
         "mean dihedral change in degrees", 1.5},
        {"displacement_mean_mm", &PublishedFrame::displacement_mm, "mean displacement in mm", 2}};
    for (const Column& c : columns) {
        const std::vector<double> values = run.run.metric(c.key);
        double most = 0;
        for (const PublishedFrame& mark : marks)
            if (std::isfinite(mark.*c.mark))
                most = std::max(most, std::abs(values.at(run.run.index_at(mark.frame)) - mark.*c.mark));
        const bool same = most <= c.same_below;
        result.findings.push_back({"", c.key, same ? Verdict::kept : Verdict::shown,
                                   "The " + std::string(c.label) +
                                       (same ? " is within " : " differs by up to ") + short_number(most) +
                                       (same ? " of" : " from") +
                                       " the published program's at frames 50, 100, 200 and 300."});
    }
}

} // namespace

std::string picture_figures(const Experiment& e) {
    std::string text;
    std::istringstream parts(e.figures);
    for (std::string part; std::getline(parts, part, ',');)
        if (const int figure = std::stoi(part); figure <= 8)
            text += (text.empty() ? "" : ", ") + std::to_string(figure);
    return text;
}

Verdict judge(double ours, double theirs, double none_below) {
    if (!std::isfinite(ours) || !std::isfinite(theirs))
        return Verdict::shown;
    if (ours <= none_below && theirs <= none_below)
        return Verdict::kept;
    if (ours <= 0.9 * theirs)
        return Verdict::better;
    return ours < 1.1 * theirs ? Verdict::kept : Verdict::worse;
}

void find_out(ExperimentResult& result) {
    result.findings.clear();
    const MethodRun* own = result.run_of(solver_methods().front().name);
    const MethodRun* published = result.run_of("classic");
    if (result.experiment->methods == MethodChoice::published) {
        if (published != nullptr && result.real)
            judge_literal(result, *published);
        return;
    }
    if (own == nullptr)
        return;
    if (published != nullptr || result.runs.size() > 1)
        judge_measures(result, *own, published);
    tell_decomposition(result, *own);
    judge_fibres(result, *own);
    judge_arms(result);
}

} // namespace fascicle::reproduce
