#include "app/cli/progress.hpp"

#include "fascicle/base/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace fascicle::app {

namespace {

const double redraw_seconds = 0.1;
const int bar_width = 24;
const int tenths = 10;

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string percent_text(double fraction) {
    return fixed(std::floor(100 * std::clamp(fraction, 0.0, 1.0)), 0) + " %";
}

} // namespace

ProgressDisplay::ProgressDisplay(std::ostream& out, Style style, int columns)
    : out_(out), style_(style), columns_(columns) {}

ProgressDisplay ProgressDisplay::for_user(bool quiet) {
    if (quiet)
        return {std::cout, Style::none};
    if (stderr_is_terminal())
        return {std::cerr, Style::bar, terminal_columns()};
    return {std::cout, Style::lines};
}

void ProgressDisplay::update(const Progress& progress, double now) {
    if (style_ == Style::none)
        return;
    const bool begins = progress.stage != stage_;
    if (begins) {
        stage_ = progress.stage;
        stage_start_ = now;
        stage_done_ = progress.done;
        next_tenth_ = progress.total > 0 ? progress.done * tenths / progress.total + 1 : tenths + 1;
    }
    if (style_ == Style::bar) {
        if (begins || now - last_drawn_ >= redraw_seconds)
            draw_bar(progress, now);
    } else if (begins && progress.total == 0) {
        out_ << progress.stage << std::endl;
    } else if (progress.total > 0 && progress.done * tenths >= next_tenth_ * progress.total) {
        next_tenth_ = progress.done * tenths / progress.total + 1;
        write_line(progress, now);
    }
}

void ProgressDisplay::finish() {
    if (drawn_)
        out_ << "\r\033[K" << std::flush;
    drawn_ = false;
}

void ProgressDisplay::draw_bar(const Progress& progress, double now) {
    const double share = std::clamp(progress.fraction, 0.0, 1.0);
    const int filled = static_cast<int>(share * bar_width);
    std::string text = progress.stage + " [" + std::string(static_cast<std::size_t>(filled), '#') +
                       std::string(static_cast<std::size_t>(bar_width - filled), '.') + "] " +
                       percent_text(share);
    if (progress.total > 0)
        text += "  " + std::to_string(progress.done) + "/" + std::to_string(progress.total);
    const std::string rate = rate_text(progress, now);
    if (!rate.empty())
        text += "  " + rate;
    // A full line would wrap and leave its beginning behind at the next redraw.
    text.resize(std::min(text.size(), static_cast<std::size_t>(std::max(columns_ - 1, 1))));
    out_ << '\r' << text << "\033[K" << std::flush;
    last_drawn_ = now;
    drawn_ = true;
}

void ProgressDisplay::write_line(const Progress& progress, double now) {
    const std::string rate = rate_text(progress, now);
    out_ << progress.stage << ' ' << percent_text(progress.fraction) << ", frame " << progress.done << " of "
         << progress.total << (rate.empty() ? "" : ", " + rate) << std::endl;
}

std::string ProgressDisplay::rate_text(const Progress& progress, double now) const {
    const double seconds = now - stage_start_;
    const int done = progress.done - stage_done_;
    if (progress.total == 0 || done <= 0 || seconds <= 0)
        return {};
    const double rate = done / seconds;
    return fixed(rate, 1) + " frames/s, " + duration_text((progress.total - progress.done) / rate) + " left";
}

std::string duration_text(double seconds) {
    const long whole = std::lround(std::clamp(seconds, 0.0, 1e9));
    const long hours = whole / 3600, minutes = whole / 60 % 60;
    char text[48];
    if (hours > 0)
        std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", hours, minutes, whole % 60);
    else
        std::snprintf(text, sizeof text, "%ld:%02ld", minutes, whole % 60);
    return text;
}

} // namespace fascicle::app
