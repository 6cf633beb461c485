#include "editor/dialogs/plot_export_dialog.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/png.hpp"
#include "view/chart_image.hpp"
#include "view/chart_svg.hpp"

#include <cctype>
#include <cstdlib>
#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

constexpr const char* popup = "Export plots";
constexpr int least_width = 240, most_width = 2400, least_height = 160, most_height = 1600;

const char* extension(PlotFile format) {
    return format == PlotFile::csv ? ".csv" : format == PlotFile::svg ? ".svg" : ".png";
}

/// A name that every file system takes.
std::string plain(const std::string& text) {
    std::string name;
    for (const char c : text)
        name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ? c : '_';
    return name.empty() ? "scene" : name;
}

std::string short_id(const std::string& id) {
    const std::size_t slash = id.find('/');
    return slash == std::string::npos ? id : id.substr(slash + 1);
}

/// The path, or the first with a number behind its stem that is not there yet.
fs::path free_name(const fs::path& path) {
    std::error_code error;
    fs::path result = path;
    for (int k = 2; fs::exists(result, error) && k < 10000; ++k)
        result =
            path.parent_path() / (path.stem().string() + "_" + std::to_string(k) + path.extension().string());
    return result;
}

/// Where else a file might be written, when it could not be at `path`.
fs::path another_place(const fs::path& path) {
    const char* const home = std::getenv("HOME");
    std::error_code error;
    const fs::path folder =
        home != nullptr && fs::is_directory(home, error) && fs::path(home) != path.parent_path()
            ? fs::path(home)
            : fs::temp_directory_path(error);
    return free_name((folder.empty() ? fs::path(".") : folder) / path.filename());
}

} // namespace

void PlotExportDialog::open(const EditorContext& context, std::vector<std::string> plots, PlotFile format,
                            bool visible_only) {
    plots_ = std::move(plots);
    format_ = format;
    visible_only_ = visible_only;
    problem_.clear();
    open_ = appears_ = true;
    suggest(context);
}

void PlotExportDialog::suggest(const EditorContext& context) {
    const std::string what = plots_.size() == 1 ? short_id(plots_[0]) : "plots";
    const fs::path path = plain(context.document.scene().name) + "_" + what + extension(format_);
    name_ = free_name(browser_.folder() / path).filename().string();
}

fs::path PlotExportDialog::target() const {
    fs::path path = fs::path(name_).is_absolute() ? fs::path(name_) : browser_.folder() / name_;
    if (path.extension() != extension(format_))
        path += extension(format_);
    return path;
}

void PlotExportDialog::draw_what(EditorContext& context, float label) {
    const auto heading = [&](const char* text) {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(text);
        ImGui::SameLine(label);
    };
    heading("Plots");
    std::string what;
    for (const std::string& id : plots_)
        if (const PlotRow* row = find_plot_row(id))
            what += (what.empty() ? "" : ", ") + std::string(row->title);
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(what.empty() ? "none" : what.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();

    heading("As");
    const std::pair<PlotFile, const char*> formats[] = {
        {PlotFile::csv, "CSV"}, {PlotFile::svg, "SVG"}, {PlotFile::png, "PNG"}};
    for (const auto& [format, text] : formats) {
        if (ImGui::RadioButton(text, format_ == format) && format_ != format) {
            format_ = format;
            name_ = fs::path(name_).replace_extension(extension(format)).string();
        }
        record_item(std::string("plot_export/") + text);
        item_tooltip(format == PlotFile::csv
                         ? "A table: one row a frame, one column a curve, and a .json beside it that says "
                           "where the numbers come from."
                     : format == PlotFile::svg ? "A vector picture for papers and web pages."
                                               : "A picture of pixels.");
        ImGui::SameLine(0, context.px(14));
    }
    ImGui::NewLine();
    if (format_ == PlotFile::csv) {
        heading("Frames");
        ImGui::Checkbox("Only the visible range", &visible_only_);
        record_item("plot_export/visible");
        item_tooltip("Only the frames that the plots show now");
        return;
    }
    heading("Size");
    ImGui::SetNextItemWidth(context.px(90));
    ImGui::DragInt("##width", &width_, 4, least_width, most_width, "%d", ImGuiSliderFlags_AlwaysClamp);
    record_item("plot_export/width");
    item_tooltip("Width of a picture, pixels at 1x, 240 to 2400\nDefault 640");
    ImGui::SameLine(0, context.px(6));
    ImGui::TextUnformatted("x");
    ImGui::SameLine(0, context.px(6));
    ImGui::SetNextItemWidth(context.px(90));
    ImGui::DragInt("##height", &height_, 4, least_height, most_height, "%d px", ImGuiSliderFlags_AlwaysClamp);
    record_item("plot_export/height");
    item_tooltip("Height of a picture, pixels at 1x, 160 to 1600\nDefault 360");
    if (format_ == PlotFile::png) {
        ImGui::SameLine(0, context.px(14));
        ImGui::SetNextItemWidth(context.px(80));
        ImGui::SliderInt("##scale", &scale_, 1, 4, "%dx", ImGuiSliderFlags_AlwaysClamp);
        record_item("plot_export/scale");
        item_tooltip("Pixels for one, 1 to 4\nDefault 2");
    }
    ImGui::SameLine(0, context.px(14));
    ImGui::Checkbox("Dark", &dark_);
    record_item("plot_export/dark");
    item_tooltip("Light text on a dark ground\nDefault off");
}

void PlotExportDialog::draw_where(EditorContext& context, float width) {
    if (browser_.draw(context, {width, std::min(context.px(190), ImGui::GetIO().DisplaySize.y * 0.3f)}) &&
        !browser_.chosen().empty())
        name_ = browser_.chosen().filename().string();
    ImGui::SetNextItemWidth(width);
    ImGui::InputText("##name", &name_);
    record_item("plot_export/name");
    item_tooltip("Name of the file, in the folder above, or a whole path");
    std::error_code error;
    const fs::path path = target();
    const bool many = format_ != PlotFile::csv && plots_.size() > 1;
    const bool exists = !many && fs::exists(path, error);
    ImGui::PushStyleColor(ImGuiCol_Text, !problem_.empty() ? context.theme.bad
                                         : exists          ? context.theme.warning
                                                           : context.theme.text_faint);
    const std::string several = "One file a plot: " + path.stem().string() + "_" +
                                (plots_.empty() ? "" : short_id(plots_[0])) + extension(format_) + " ...";
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(!problem_.empty() ? problem_.c_str()
                           : exists          ? "This file exists and will be replaced."
                           : many            ? several.c_str()
                           : format_ == PlotFile::csv
                               ? "With a .json beside it that says where the numbers come from."
                               : " ");
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void PlotExportDialog::draw(EditorContext& context) {
    poll(context);
    if (std::exchange(appears_, false)) {
        browser_.go_to(browser_.folder()); // files may have come
        ImGui::OpenPopup(popup);
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize({std::min(window.x * 0.94f, context.px(560)), 0});
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(popup, &open_,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings))
        return;
    const float width = ImGui::GetContentRegionAvail().x;
    draw_what(context, context.px(76));
    ImGui::Dummy({1, context.px(2)});
    draw_where(context, width);
    const float button = context.px(110);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + width - 2 * button - context.px(8));
    if (ImGui::Button("Cancel", {button, 0}))
        open_ = false;
    record_item("plot_export/cancel");
    ImGui::SameLine(0, context.px(8));
    const bool ready = !busy() && !name_.empty() && !plots_.empty();
    ImGui::BeginDisabled(!ready);
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    const bool write = ImGui::Button(busy() ? "Writing" : "Write", {button, 0});
    ImGui::PopStyleColor();
    ImGui::EndDisabled();
    record_item("plot_export/write");
    if (write && ready)
        start(context);
    if (!open_)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

/// What is written is taken from the plots now; the files are made on a thread.
void PlotExportDialog::start(EditorContext& context) {
    problem_.clear();
    const fs::path path = target();
    PlotData& data = context.features.plots;
    std::vector<const PlotRow*> rows;
    for (const std::string& id : plots_)
        if (const PlotRow* row = find_plot_row(id))
            rows.push_back(row);
    if (format_ == PlotFile::csv) {
        PlotTable table = plot_table(context, data, rows, visible_only_);
        std::string origin = provenance_json(context, table, path.filename().string());
        writing_ =
            std::async(std::launch::async, [path, table = std::move(table), origin = std::move(origin)] {
                write_file(path, to_csv(table));
                write_file(fs::path(path).replace_extension(".json"), origin);
                return "Plots written to " + path.string();
            });
        return;
    }
    std::vector<std::pair<fs::path, view::Chart>> charts;
    for (const PlotRow* row : rows) {
        fs::path file = path;
        if (rows.size() > 1)
            file.replace_filename(path.stem().string() + "_" + short_id(row->id) + extension(format_));
        charts.emplace_back(file, plot_chart(context, data, *row, dark_));
    }
    writing_ =
        std::async(std::launch::async, [charts = std::move(charts), path, png = format_ == PlotFile::png,
                                        width = width_, height = height_, scale = scale_, dark = dark_] {
            for (const auto& [file, chart] : charts) {
                if (png) {
                    const render::Image image = view::chart_image(chart, width, height, scale, dark);
                    write_png(file, image.width, image.height, image.rgba.data());
                } else {
                    write_file(file, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
                                         view::chart_svg(chart, width, height, dark));
                }
            }
            return charts.size() == 1
                       ? "Plot written to " + path.string()
                       : std::to_string(charts.size()) + " plots written to " + path.parent_path().string();
        });
}

void PlotExportDialog::poll(EditorContext& context) {
    if (!writing_.valid() || writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    try {
        context.log.add(Severity::note, writing_.get());
        open_ = false;
    } catch (const std::exception& problem) {
        const fs::path other = another_place(target());
        problem_ = std::string(problem.what()) + "\nWrite it to " + other.string() + " instead?";
        name_ = other.string();
        if (!open_) // it was closed meanwhile
            context.log.add(Severity::error, problem.what());
    }
}

} // namespace fascicle::editor
