#include "editor/panels/panels.hpp"

#include "editor/control_guard.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "editor/param_effect.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/param_row.hpp"
#include "editor/widgets/template_card.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/anatomy/fibre_methods.hpp"
#include "fascicle/document/actions/fibre_actions.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/io/fibre_template_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fascicle::editor {

namespace {

std::string number(const char* format, double value) {
    char text[40];
    std::snprintf(text, sizeof text, format, value);
    return std::isfinite(value) ? text : "-";
}

/// How muscles are made of fibres: the template from a gallery, the method, how many, and what comes of it.
class Fibres : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(6)});
        if (context.document.scene().muscles.empty()) {
            faint(context, "A muscle in the scene can have fibres here.");
        } else {
            caption(context, "Template");
            draw_gallery(context);
            caption(context, "Method");
            draw_methods(context);
            const float label = std::min(context.px(142), ImGui::GetContentRegionAvail().x * 0.42f);
            for (const char* key : {"fibres.count", "fibres.segments"}) {
                const ParamRow& row = *parameter_table().find(key);
                draw_param_row(context, row, label, no_effect_reason(context.document.scene(), row));
            }
            caption(context, "Architecture at rest");
            for (const MuscleFibres& muscle : context.features.fibres.muscles())
                draw_muscle(context, muscle);
            if (!context.features.fibres.current())
                faint(context, "Making fibres");
            draw_colouring(context);
        }
        ImGui::PopStyleVar();
    }

private:
    static void caption(const EditorContext& context, const char* text) {
        ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
        ImGui::TextUnformatted(text);
        ImGui::PopStyleColor();
    }

    static void faint(const EditorContext& context, const std::string& text, bool alarm = false) {
        ImGui::PushStyleColor(ImGuiCol_Text, alarm ? context.theme.warning : context.theme.text_faint);
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    }

    /// The template that is every muscle's own, when there is one.
    static std::shared_ptr<const FibreTemplate> own_template(const Scene& scene) {
        for (const Muscle& muscle : scene.muscles)
            if (muscle.fibre_template != nullptr)
                return muscle.fibre_template;
        return nullptr;
    }

    void draw_gallery(EditorContext& context) {
        const Scene& scene = context.document.scene();
        if (cards_.empty())
            for (const FibreTemplate& one : built_in_fibre_templates())
                cards_.emplace_back(one);
        const auto own = own_template(scene);
        if (own != own_) {
            own_ = own;
            own_card_.reset();
            if (own != nullptr)
                own_card_.emplace(*own);
        }
        const bool follows = scene.parameters.get_choice("fibres.method") == "kukacka";
        const float width = ImGui::GetContentRegionAvail().x, gap = context.px(8);
        const int columns = std::max(1, static_cast<int>((width + gap) / (context.px(118) + gap)));
        const float side = (width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
        const ImVec2 size{side, std::min(side, context.px(104)) + context.px(14)};
        int drawn = 0;
        const auto place = [&] {
            if (drawn++ % columns != 0)
                ImGui::SameLine(0, gap);
        };
        for (std::size_t i = 0; i < cards_.size(); ++i) {
            const std::string& key = built_in_fibre_templates()[i].key;
            place();
            const bool chosen =
                follows && own == nullptr && scene.parameters.get_choice("fibres.template") == key;
            if (cards_[i].draw(context, "fibres/template/" + key, size, chosen)) {
                actions::choose_fibre_template(context.document, key);
                context.state.colouring = view::Colouring::fibres; // muscles let them be seen
            }
        }
        if (own_card_) {
            place();
            if (own_card_->draw(context, "fibres/template/own", size, follows)) {
                actions::use_fibre_template(context.document, own,
                                            scene.muscles.front().fibre_template_source);
                context.state.colouring = view::Colouring::fibres;
            }
        }
        {
            const LockScope lock("fibres/template/file");
            if (ImGui::Button("Template from a file", {width, 0}))
                context.dialogs.pick.open("Open fibre template", {".json"}, "Use", use_file);
            record_item("fibres/template/file");
            item_tooltip(lock.tip(
                "Template from a file\nA template of your own as JSON; docs/formats.md describes it."));
        }
    }

    static void use_file(EditorContext& context, const std::filesystem::path& path) {
        auto own = std::make_shared<const FibreTemplate>(read_fibre_template(path));
        actions::use_fibre_template(context.document, std::move(own), {path.string(), {}});
        context.state.colouring = view::Colouring::fibres;
    }

    /// Why no muscle can have this method; empty when one can.
    static std::string refusal(const Scene& scene, const char* method) {
        std::string first;
        for (const Muscle& muscle : scene.muscles) {
            const std::string reason = why_not(scene, muscle, method);
            if (reason.empty())
                return {};
            if (first.empty())
                first = reason;
        }
        return first;
    }

    static void draw_methods(EditorContext& context) {
        const Scene& scene = context.document.scene();
        const std::string now = scene.parameters.get_choice("fibres.method");
        const std::string locked = lock_reason("parameter/fibres.method");
        struct Choice {
            std::string key, label, meaning;
        };
        std::vector<Choice> choices{{"none", "None", "Muscles without fibres."}};
        for (const FibreMethod& method : fibre_methods())
            choices.push_back({method.key, method.label, method.meaning});
        for (const Choice& choice : choices) {
            const std::string why = !locked.empty()     ? locked
                                    : choice.key == now ? std::string()
                                                        : refusal(scene, choice.key.c_str());
            ImGui::BeginDisabled(!why.empty());
            if (ImGui::RadioButton(choice.label.c_str(), now == choice.key) && now != choice.key) {
                ParamSet parameters = scene.parameters;
                parameters.set_text("fibres.method", choice.key);
                actions::set_parameters(context.document, std::move(parameters), "Fibres: " + choice.label);
            }
            ImGui::EndDisabled();
            record_item("fibres/method/" + choice.key);
            item_tooltip(choice.label + "\n" + choice.meaning +
                         (why.empty() ? "" : "\nNot now: " + why + "."));
        }
    }

    static void draw_muscle(EditorContext& context, const MuscleFibres& muscle) {
        const Theme& theme = context.theme;
        const bool there = muscle.fibres != nullptr;
        const std::string name = "fibres/muscle/" + muscle.muscle;
        const float width = ImGui::GetContentRegionAvail().x, line = context.px(20);
        ImVec2 at = ImGui::GetCursorScreenPos();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        draw_text_in(list, {at, {at.x + width, at.y + line}}, theme.text, muscle.muscle);
        draw_text_in(list, {at, {at.x + width, at.y + line}}, theme.text_faint,
                     there                    ? std::to_string(muscle.fibres->rest.count) + " fibres"
                     : muscle.problem.empty() ? "no fibres"
                                              : "",
                     Align::right);
        ImGui::Dummy({width, line});
        record_item(name);
        if (!muscle.problem.empty())
            faint(context, muscle.problem, true);
        if (!there)
            return;
        const MuscleArchitecture& a = muscle.architecture;
        struct Fact {
            const char* label;
            std::string value;
            const char* tip;
        };
        const Fact facts[] = {
            {"Length", number("%.1f mm", a.length_mean_mm), "Mean length of the fibres at rest."},
            {"Pennation", number("%.1f deg", a.pennation_mean_deg),
             "Mean angle of the fibres' ends to the line of action, over both ends (Lee et al. 2014)."},
            {"PCSA", number("%.1f cm2", a.pcsa_cm2),
             "Physiological cross-section: volume x cos(pennation) / mean length (Ravichandiran et al. "
             "2009)."},
            {"Cover", number("%.0f %%", a.cover_percent),
             "Volume of the fibres as cylinders against the muscle's; about 79 % on a square lattice."},
        };
        // Two columns of label and value.
        const float column = width / 2;
        for (std::size_t i = 0; i < std::size(facts); ++i) {
            if (i % 2 == 0)
                at = ImGui::GetCursorScreenPos();
            const float x = at.x + (i % 2 == 0 ? 0 : column);
            const Rect cell{{x, at.y}, {x + column - context.px(10), at.y + line}};
            draw_text_in(list, cell, theme.text_faint, facts[i].label);
            draw_text_in(list, cell, theme.text, facts[i].value, Align::right);
            if (i % 2 == 1)
                ImGui::SameLine(0, 0);
            ImGui::Dummy({column, line});
            item_tooltip(std::string(facts[i].label) + "\n" + facts[i].tip);
        }
    }

    /// Fibres are seen through muscles only in their own colouring: said where they are made.
    static void draw_colouring(EditorContext& context) {
        if (context.state.colouring == view::Colouring::fibres)
            return;
        const LockScope lock("fibres/show");
        if (ImGui::Button("Show the fibres in the view", {ImGui::GetContentRegionAvail().x, 0}))
            context.state.colouring = view::Colouring::fibres;
        record_item("fibres/show");
        item_tooltip(lock.tip("Colours muscles by their fibres and makes them translucent."));
    }

    std::vector<TemplateCard> cards_;
    std::shared_ptr<const FibreTemplate> own_;
    std::optional<TemplateCard> own_card_;
};

} // namespace

std::unique_ptr<Panel> make_fibres() {
    return std::make_unique<Fibres>();
}

} // namespace fascicle::editor
