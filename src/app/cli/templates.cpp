// fascicle templates: the fibre templates with a line each, a user's own checked, pictures of them.

#include "app/cli/command.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/io/fibre_template_file.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

namespace fascicle::app {

namespace {

struct TemplateOptions {
    std::vector<std::string> files;
    std::string thumbnails;
    int size = 96;
};

} // namespace

std::function<int()> add_templates(CLI::App& app) {
    auto options = std::make_shared<TemplateOptions>();
    app.add_option("files", options->files, "Template files to check; without any, the built-in templates");
    app.add_option("--thumbnails", options->thumbnails,
                   "Folder to draw a picture of each template in, KEY.png");
    app.add_option("--size", options->size, "Pixels of a side of a picture")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    return [options] {
        std::vector<FibreTemplate> templates;
        for (const std::string& file : options->files)
            templates.push_back(read_fibre_template(file));
        if (options->files.empty())
            templates = built_in_fibre_templates();
        std::size_t width = 0;
        for (const FibreTemplate& one : templates)
            width = std::max(width, one.key.size());
        const std::atomic<bool>& interrupted = watch_interrupts();
        for (const FibreTemplate& one : templates) {
            if (interrupted)
                throw Cancelled();
            std::cout << one_line(one.key) << std::string(width - one.key.size() + 2, ' ')
                      << one_line(one.meaning) << '\n';
            if (options->thumbnails.empty())
                continue;
            const PngImage image = draw_fibre_template(one, options->size);
            write_png(std::filesystem::path(options->thumbnails) / (file_name_for(one.key) + ".png"),
                      image.width, image.height, image.rgba.data());
        }
        return 0;
    };
}

} // namespace fascicle::app
