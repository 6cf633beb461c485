#include "editor/widgets/file_browser.hpp"

#include "editor/widgets/icons.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(c < 128 ? std::tolower(c) : c); });
    return text;
}

std::string size_text(std::uintmax_t bytes) {
    if (bytes < 1000)
        return std::to_string(bytes) + " B";
    if (bytes < 1000 * 1000)
        return std::to_string(bytes / 1000) + " kB";
    return std::to_string(bytes / (1000 * 1000)) + " MB";
}

} // namespace

FileBrowser::FileBrowser(std::vector<std::string> extensions, std::string empty_text)
    : extensions_(std::move(extensions)), empty_text_(std::move(empty_text)) {
    std::error_code error;
    folder_ = fs::current_path(error);
    refresh();
}

void FileBrowser::go_to(const fs::path& path) {
    std::error_code error;
    const fs::path full = fs::absolute(path, error).lexically_normal();
    if (fs::is_directory(full, error)) {
        folder_ = full;
        chosen_.clear();
    } else {
        folder_ = full.parent_path();
        chosen_ = full;
    }
    refresh();
}

void FileBrowser::refresh() {
    entries_.clear();
    problem_.clear();
    typed_ = chosen_.empty() ? folder_.string() : chosen_.string();
    std::error_code error;
    // Never by range-for: an unreadable entry would throw.
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (name.empty() || name[0] == '.')
            continue;
        std::error_code ignored;
        const bool folder = it->is_directory(ignored);
        const std::string extension = lower(it->path().extension().string());
        if (!folder && std::find(extensions_.begin(), extensions_.end(), extension) == extensions_.end())
            continue;
        const std::uintmax_t bytes = folder ? 0 : it->file_size(ignored);
        entries_.push_back({name, folder, ignored ? 0 : bytes});
    }
    if (error)
        problem_ = error.message();
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder : lower(a.name) < lower(b.name);
    });
}

bool FileBrowser::accept_typed_path() {
    std::error_code error;
    const fs::path path = fs::absolute(typed_, error).lexically_normal();
    if (fs::exists(path, error)) {
        go_to(path);
        return !chosen_.empty();
    }
    problem_ = "no such file or folder";
    return false;
}

bool FileBrowser::draw(const EditorContext& context, ImVec2 size) {
    const fs::path before = chosen_;
    confirmed_ = false;
    bool typed = false;
    const float up = ImGui::GetFrameHeight();
    if (icon_button(context, "browser/up", icons::up, false, folder_.has_parent_path(), "To the folder above",
                    up / context.scale()))
        go_to(folder_.parent_path());
    ImGui::SameLine(0, context.px(4));
    ImGui::SetNextItemWidth(std::max(40.0f, size.x - up - context.px(4)));
    if (ImGui::InputText("##path", &typed_,
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll))
        typed = accept_typed_path();
    record_item("browser/path");
    item_tooltip("Folder or file\nType a path and press Enter.");

    const float height = std::max(40.0f, size.y - ImGui::GetFrameHeightWithSpacing());
    ImGui::PushStyleColor(ImGuiCol_ChildBg, context.theme.plot);
    if (ImGui::BeginChild("files", {size.x, height}, false)) {
        if (!problem_.empty() || entries_.empty()) {
            ImGui::PushStyleColor(ImGuiCol_Text,
                                  problem_.empty() ? context.theme.text_faint : context.theme.bad);
            ImGui::SetCursorPos({context.px(10), context.px(8)});
            ImGui::TextUnformatted(problem_.empty() ? empty_text_.c_str() : problem_.c_str());
            ImGui::PopStyleColor();
        }
        for (const Entry& entry : entries_) {
            const fs::path full = folder_ / entry.name;
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float width = ImGui::GetContentRegionAvail().x, line = context.px(24);
            ImGui::PushID(entry.name.c_str());
            const bool clicked = ImGui::Selectable("##entry", full == chosen_,
                                                   ImGuiSelectableFlags_AllowDoubleClick, {width, line});
            record_item("browser/" + entry.name);
            const bool twice = ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0);
            ImGui::PopID();
            ImDrawList& list = *ImGui::GetWindowDrawList();
            const float x = at.x + context.px(10);
            draw_text_in(list, {{x, at.y}, {x + context.px(20), at.y + line}},
                         entry.folder ? context.theme.accent : context.theme.text_faint,
                         icons_available() ? (entry.folder ? icons::folder.glyph : icons::file.glyph)
                                           : (entry.folder ? "/" : ""));
            draw_text_in(list, {{x + context.px(24), at.y}, {at.x + width - context.px(70), at.y + line}},
                         context.theme.text, entry.name);
            if (!entry.folder)
                draw_text_in(
                    list,
                    {{at.x + width - context.px(70), at.y}, {at.x + width - context.px(10), at.y + line}},
                    context.theme.text_faint, size_text(entry.bytes), Align::right);
            if (clicked && entry.folder && twice) {
                go_to(full);
                break; // the list is another one now
            }
            if (clicked && !entry.folder) {
                chosen_ = full;
                typed_ = full.string();
                confirmed_ = twice;
            }
        }
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
    return typed || chosen_ != before;
}

} // namespace fascicle::editor
