#include "app/item_file.hpp"

#include "fascicle/io/files.hpp"

#include <cstdio>

namespace fascicle::app {

ItemFile::ItemFile(std::filesystem::path path) : path_(std::move(path)) {
    if (!path_.empty())
        editor::set_item_recorder(&recorder_);
}

ItemFile::~ItemFile() {
    if (!path_.empty())
        editor::set_item_recorder(nullptr);
}

void ItemFile::write() {
    if (path_.empty())
        return;
    std::string text;
    for (const auto& [name, rect] : recorder_.items()) {
        char place[120];
        std::snprintf(place, sizeof place, "\t%.1f\t%.1f\t%.1f\t%.1f\n", double(rect.min.x),
                      double(rect.min.y), double(rect.max.x), double(rect.max.y));
        text += name + place;
    }
    if (text == written_)
        return;
    written_ = text;
    write_file(path_, text);
}

} // namespace fascicle::app
