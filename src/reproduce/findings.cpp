#include "reproduce/findings.hpp"

#include "fascicle/solver/soft_body_solver.hpp"
#include "reproduce/published.hpp"
#include "reproduce/words.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace fascicle::reproduce {

namespace {

/// A quantity whose size over the run is compared between methods: less is better.
struct Measure {
    const char* about; ///< key of metric_table()
    int figure_group; ///< place in the paper's order of plots: 0 volume, 1 edges, 2 dihedrals; -1 none, -2 its pictures
    double from;   ///< what it is without deformation
    double factor; ///< to the unit that is told
    const char* unit;
    const char* before; ///< "departs from its volume at rest by"
    const char* after;  ///< " vertices inside bones"
    double none_below;  ///< in the told unit
    bool at_end;        ///< of the last frame, not of the worst
};

const Measure measures[] = {
    {"volume_ratio", 0, 1, 100, " %", "departs from its volume at rest by", "", 0.5, false},
    {"edge_extension_mean", 1, 1, 1, "", "ends with a mean edge extension off 1 by", "", 0.002, true},
    {"edge_extension_p99", -1, 1, 100, " %", "has one edge in a hundred longer than at rest by more than",
     " in the last frame", 2, true},
    {"dihedral_change_mean_rad", 2, 0, 180 / std::numbers::pi, "\xC2\xB0",
     "ends with a mean dihedral change of", "", 0.5, true},
    {"dihedral_change_unsigned_mean_deg", 2, 0, 1, "\xC2\xB0",
     "ends with a mean change of unsigned dihedral angles of", "", 0.5, true},
    {"penetrating_vertices", -1, 0, 1, "", "has", " vertices inside bones", 0.5, false},
    {"displacement_mean_mm", -2, 0, 1, " mm", "ends away from its rest shape by a mean of", "", 0.1, true},
};

double size_of(const Measure& m, const RunData& run) {
    const std::vector<double> values = run.metric(m.about);
    if (values.empty())
        return std::nan("");
    return m.factor * (m.at_end ? std::abs(values.back() - m.from) : farthest(values, m.from));
}

/// "at most 1.07 %" of what is the worst of all frames, "less than 0.0001 %" of what is rounding, "0 %".
std::string amount(const Measure& m, double size) {
    if (size > 0 && size < 1e-4)
        return std::string("less than 0.0001") + m.unit;
    return (m.at_end || size == 0 ? "" : "at most ") + told_number(size) + m.unit;
}

/// "; with classic 1.07 %; with mass-spring, the worst of the rivals, 12 %"
std::string others(const Measure& m, const ExperimentResult& result, const std::string& own) {
    std::string text;
    const MethodRun* worst = nullptr;
    double most = -1;
    std::size_t rivals = 0;
    for (const MethodRun& row : result.runs) {
        if (!row.done() || row.method == own)
            continue;
        const double size = size_of(m, row.run);
        if (!std::isfinite(size))
            continue;
        if (row.method == "classic") {
            text += "; with classic " + amount(m, size);
            continue;
        }
        ++rivals;
        if (size > most) {
            most = size;
            worst = &row;
        }
    }
    if (worst != nullptr)
        text += rivals > 1 && most == 0
                    ? "; with every rival " + amount(m, most)
                    : "; with " + worst->method + (rivals > 1 ? ", the worst of the rivals, " : " ") +
                          amount(m, most);
    return text;
}

std::string sentence(const Measure& m, const ExperimentResult& result, const MethodRun& own) {
    return "With " + own.method + " " + told_name(result.experiment->muscle) + " " + m.before + " " +
           amount(m, size_of(m, own.run)) + m.after + others(m, result, own.method) + ".";
}

void judge_measures(ExperimentResult& result, const MethodRun& own, const MethodRun* published) {
    for (const Measure& m : measures) {
        const double ours = size_of(m, own.run);
        if (!std::isfinite(ours))
            continue;
        Finding finding;
        finding.figure = m.figure_group == -2 ? picture_figures(*result.experiment)
                                              : plot_figure(*result.experiment, m.figure_group);
        finding.about = m.about;
        if (published != nullptr && published != &own)
            finding.verdict = judge(ours, size_of(m, published->run), m.none_below);
        finding.text = sentence(m, result, own);
        result.findings.push_back(std::move(finding));
    }
}

/// Mean fibre length at a frame over that at rest.
double length_ratio(const RunData& run, std::size_t k) {
    const std::vector<double> lengths = run.metric("fibre_length_mean_mm");
    return lengths.at(k) / lengths.at(0);
}

/// Of the program's own method against the paper; of others as something to see.
void judge_fibres(ExperimentResult& result, const MethodRun& row, bool own) {
    const Experiment& e = *result.experiment;
    if (row.run.fibres.count() == 0)
        return;
    const double flexed = length_ratio(row.run, row.run.flexed()),
                 end = length_ratio(row.run, row.run.frame.size() - 1);
    Finding finding;
    finding.figure = fibre_figure(e);
    finding.about = fibre_lengths_about(row.method);
    const bool hip = result.real || e.stand_in == "hip"; // only there it is known what the muscle does
    const bool right_way = !hip || (e.flexor ? flexed < 1 : flexed > 1);
    const bool returns = std::abs(end - 1) < 0.01;
    if (own)
        finding.verdict = right_way && returns ? Verdict::kept : Verdict::worse;
    std::string text = "With " + row.method + " the fibres are " + told_number(flexed) +
                       " times as long at the end of the way out as at rest" +
                       (!hip       ? ""
                        : e.flexor ? " (a flexor must shorten)"
                                   : " (an extensor must lengthen)");
    const double off = 100 * std::abs(end - 1);
    if (returns)
        text += "; at the end they are back to within " + told_number(std::max(off, 0.01), 2) + " %";
    else
        text += "; at the end they are still " + told_number(off, 2) + " % off";
    if (own && result.real)
        for (const PublishedRatio& ratio : published_ratios())
            if (ratio.muscle == e.muscle && ratio.angle_deg > 50)
                text += "; published: " + told_number(ratio.mean) + " (" + told_number(ratio.least) + " to " +
                        told_number(ratio.greatest) + ") at " + told_number(ratio.angle_deg) + "\xC2\xB0";
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
    finding.text = std::to_string(fibres.count()) + " fibres by " + fibre_method(e) + ", at rest " +
                   told_number(mean) + " mm long in the mean (sd " +
                   told_number(std::sqrt(squares / static_cast<double>(lengths.size())), 2) + ")";
    if (const PublishedRest* rest = published_rest(e.muscle); rest != nullptr && result.real)
        finding.text += "; published, with outlines of their own: " + told_number(rest->mean_mm) + " (sd " +
                        told_number(rest->sd_mm, 2) + ")";
    finding.text += ".";
    result.findings.push_back(std::move(finding));
}

std::string range(const Span3& span) {
    return told_number(span.least) + " to " + told_number(span.greatest) + " mm, mean " +
           told_number(span.mean);
}

void judge_arms(ExperimentResult& result) {
    std::string text;
    double own = std::nan(""), least = std::nan("");
    for (const ArmShare& share : result.arms) {
        if (!std::isfinite(share.inside_percent))
            continue;
        text += (text.empty() ? "" : ", ") + share.who + " " + told_number(share.inside_percent, 3) + " %";
        if (share.who == solver_methods().front().name)
            own = share.inside_percent;
        else if (!(least <= share.inside_percent))
            least = share.inside_percent;
    }
    Finding finding;
    finding.figure = "22";
    finding.about = "moment_arm_mm";
    if (text.empty()) { // nothing is published of it: told as it is
        for (const ArmShare& share : result.arms)
            text += (text.empty() ? "" : "; ") + share.who + " " + range(share.arm_mm);
        finding.text = "Mean moment arms over the poses: " + text + ".";
        if (!text.empty())
            result.findings.push_back(std::move(finding));
        return;
    }
    finding.verdict = own >= 99.5 ? Verdict::kept : own < 50 ? Verdict::worse : Verdict::shown;
    finding.text =
        "Poses whose mean moment arm is inside the bounds of Blemker & Delp 2005, digitised: " + text + ".";
    result.findings.push_back(std::move(finding));
}

/// Adduction and rotation: against the ranges of Modenese & Kohout 2020, Table 2.
void judge_table(ExperimentResult& result) {
    const Experiment& e = *result.experiment;
    const ArmShare* own = nullptr;
    std::string lines;
    for (const ArmShare& share : result.arms)
        if (share.who == solver_methods().front().name)
            own = &share;
        else if (share.who.ends_with("(line)"))
            lines += (lines.empty() ? "; the lines of the model: " : ", ") + range(share.all_mm);
    if (own == nullptr)
        return;
    Finding finding;
    finding.about = "moment_arm_mm";
    finding.text = "In " + std::string(to_text(e.motion)) + " the fibres of " + told_name(e.muscle) +
                   " have moment arms of " + range(own->all_mm) + lines;
    for (const TableShare& share : own->table) {
        finding.text += (&share == &own->table.front() ? "; published: " : ", ") + share.model + " " +
                        range(share.arm_mm) + " (" + told_number(share.poses_percent) +
                        " % of poses with the mean inside)";
        if (&share == &own->table.front())
            finding.verdict = share.poses_percent >= 99.5 ? Verdict::kept
                              : share.poses_percent < 50  ? Verdict::worse
                                                          : Verdict::shown;
    }
    finding.text += ".";
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
        {"edge_extension_p99", &PublishedFrame::edge_p99, "99th percentile of edge extension", 0.2},
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
                                       (same ? " is within " : " differs by up to ") + told_number(most) +
                                       (same ? " of" : " from") +
                                       " the published program's at frames 50, 100, 200 and 300."});
    }
    // What was not published of it is told as it is.
    for (const Measure& m : measures)
        if (std::none_of(std::begin(columns), std::end(columns),
                         [&](const Column& c) { return std::string(c.key) == m.about; }) &&
            std::isfinite(size_of(m, run.run)))
            result.findings.push_back({"", m.about, Verdict::shown, sentence(m, result, run)});
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

std::string plot_figure(const Experiment& e, int group) {
    const int muscle = e.key == "squish-box"        ? 0
                       : e.key == "iliacus"         ? 1
                       : e.key == "gluteus_maximus" ? 2
                                                    : -1;
    return muscle < 0 || group < 0 ? std::string() : std::to_string(11 + 3 * group + muscle);
}

std::string fibre_figure(const Experiment& e) {
    return e.key == "iliacus"                ? "20"
           : e.key == "gluteus_maximus"      ? "21"
           : e.key == "gluteus_maximus-chmd" ? "21"
                                             : "";
}

std::string fibre_lengths_about(const std::string& method) {
    return "fibre_length_mean_mm, " + method;
}

std::string fibre_method(const Experiment& e) {
    return e.fibres == "kukacka" ? "Kukacka's method" : e.fibres == "chmd" ? "CHMD" : e.fibres;
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

Finding judge_speed(const SpeedResult& speed) {
    const std::vector<PublishedSpeed>& paper = published_speeds();
    std::vector<double> triangles, frames;
    for (const PublishedSpeed& row : paper) {
        triangles.push_back(row.triangles);
        frames.push_back(row.frames_per_second);
    }
    Finding finding;
    finding.about = "speed";
    finding.verdict = std::all_of(speed.correlations.begin(), speed.correlations.end(),
                                  [](const SpeedResult::Correlation& c) { return c.rho <= -0.9; })
                          ? Verdict::kept
                          : Verdict::shown;
    finding.text = "Rank correlation (Spearman) of frames a second with triangles: paper " +
                   told_number(spearman(triangles, frames)) + " (" + std::to_string(paper.size()) +
                   " objects)";
    for (const SpeedResult::Correlation& c : speed.correlations)
        finding.text += "; " + c.method + " on " + std::to_string(c.threads) +
                        (c.threads == 1 ? " thread " : " threads ") +
                        (std::isfinite(c.rho) ? told_number(c.rho) : "not known") + " (" +
                        std::to_string(c.objects) + (c.objects == 1 ? " object)" : " objects)");
    finding.text += ".";
    return finding;
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
    if (is_sweep(result.experiment->motion)) {
        judge_table(result);
        return;
    }
    const MethodRun* told = own;
    for (const MethodRun& row : result.runs) // without the program's own: the first, not judged
        if (told == nullptr && row.done())
            told = &row;
    if (told == nullptr)
        return;
    if (result.experiment->methods == MethodChoice::all)
        judge_measures(result, *told, told == own ? published : nullptr);
    tell_decomposition(result, *told);
    if (own != nullptr)
        judge_fibres(result, *own, true);
    if (published != nullptr)
        judge_fibres(result, *published, false);
    judge_arms(result);
}

} // namespace fascicle::reproduce
